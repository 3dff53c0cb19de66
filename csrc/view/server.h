/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A server for pages in browsers of this machine. It serves one page, and sends the latest data to
 * it through websockets. It handles bytes only. Its threads never touch a scene or Lua: the
 * program puts data to show into slots, and takes the messages of pages from a queue.
 *
 * A slot holds only the latest bytes, so a page that does not read costs nothing. A frame is sent
 * once the page has reported that it has drawn the previous one. The page's address contains a
 * token of 128 random bits, without which nobody gets it. Host names and origins of other sites
 * are refused. */
#ifndef SW_VIEW_SERVER_H
#define SW_VIEW_SERVER_H

#include <stddef.h>

#include "base/status.h"

enum {
  SW_SERVER_FRAME,      /* slot of frames (bytes); a page gets the next one after its message "a" */
  SW_SERVER_TEXT,       /* this slot and the following ones: texts in UTF-8 */
  SW_SERVER_SLOTS = 8,  /* [-] */
  SW_SERVER_PAGES = 8,  /* most open pages [-] */
  SW_SERVER_TOKEN = 33, /* 32 hexadecimal digits and a terminating zero [B] */
  SW_SERVER_MESSAGE = 1 << 16 /* longest message of a page [B] */
};

typedef struct sw_server sw_server;

/* Starts a server that listens on 127.0.0.1 only. port 0: any free one. SW_EINVAL: the port is
 * taken, or not allowed; SW_ENOMEM. */
sw_status sw_server_start(int port, sw_server **out, sw_error *err);
/* Stops the server within 2 s, whatever pages do; NULL is allowed. */
void sw_server_stop(sw_server *server);

int sw_server_port(const sw_server *server);
const char *sw_server_token(const sw_server *server);

/* Sets the page to a copy of bytes; policy: its Content-Security-Policy. SW_ENOMEM. */
sw_status sw_server_set_page(sw_server *server, const void *bytes, size_t size, const char *policy);
/* Sets the slot to a copy of bytes. SW_ENOMEM. */
sw_status sw_server_put(sw_server *server, int slot, const void *bytes, size_t size);

/* Returns the number of open pages; *waiting: number of these that wait for a frame. */
size_t sw_server_pages(sw_server *server, size_t *waiting);
/* Takes the oldest message: returns its size, or 0 if there is none; copies up to room bytes of it,
 * and sets the number of its page. */
size_t sw_server_take(sw_server *server, char *out, size_t room, int *page);
/* Waits until there is a message, or a page opens, closes or can take a frame; at most this long
 * [s]. */
void sw_server_wait(sw_server *server, double seconds);

#endif
