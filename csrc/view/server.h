/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A server for pages in browsers of this machine: it hands out one page, and the latest of what
 * there is to show through websockets. It knows bytes only. Its threads never touch a scene or
 * Lua: what is to be shown is put into slots, what pages say waits to be taken.
 *
 * A slot has the latest bytes only, so that a page that does not read costs nothing. That of
 * frames is sent once the page has said that it has drawn the one before. Whoever wants the page
 * needs the token, 128 random bits in its address; names and origins of other sites are refused. */
#ifndef SW_VIEW_SERVER_H
#define SW_VIEW_SERVER_H

#include <stddef.h>

#include "base/status.h"

enum {
  SW_SERVER_FRAME,     /* bytes; a page gets the next one once it has said "a" */
  SW_SERVER_TEXT,      /* this one and those after it: texts in UTF-8 */
  SW_SERVER_SLOTS = 8, /* [-] */
  SW_SERVER_PAGES = 8, /* at one time [-] */
  SW_SERVER_TOKEN = 33,
  SW_SERVER_MESSAGE = 1 << 16 /* longest message of a page [B] */
};

typedef struct sw_server sw_server;

/* Listen on 127.0.0.1 only. port 0: any that is free. SW_EINVAL: the port is taken, or not
 * allowed; SW_ENOMEM. */
sw_status sw_server_start(int port, sw_server **out, sw_error *err);
/* Ends within 2 s, whatever pages do; NULL is allowed. */
void sw_server_stop(sw_server *server);

int sw_server_port(const sw_server *server);
const char *sw_server_token(const sw_server *server);

/* The page, a copy; policy: its Content-Security-Policy. SW_ENOMEM. */
sw_status sw_server_set_page(sw_server *server, const void *bytes, size_t size, const char *policy);
/* Show these bytes, a copy, from now on. SW_ENOMEM. */
sw_status sw_server_put(sw_server *server, int slot, const void *bytes, size_t size);

/* Pages that are open; those of them that wait for a frame. */
size_t sw_server_pages(sw_server *server, size_t *waiting);
/* Takes the oldest message: returns its size, or 0 if there is none; copies up to room bytes of it,
 * and sets the number of its page. */
size_t sw_server_take(sw_server *server, char *out, size_t room, int *page);
/* Wait until there is a message, or a page came, went or can take a frame, for so long at most
 * [s]. */
void sw_server_wait(sw_server *server, double seconds);

#endif
