/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Visits of pages: checks requests, serves the page, and handles its connection. CivetWeb's thread
 * reads from the connection; a thread of this program writes to it. */
#include <civetweb.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "view/server_inner.h"

/* --- checks of requests --------------------------------------------------------- */

/* 1 if both texts are equal. The time does not depend on where they differ. */
static int same_text(const char *a, const char *b) {
  const size_t n = strlen(b);
  unsigned char differs = strlen(a) != n;
  for (size_t i = 0; i < n && a[i]; i++) differs |= (unsigned char)(a[i] ^ b[i]);
  return !differs;
}

/* 1 if given is the scheme and this machine's name with the server's port. */
static int is_ours(const sw_server *s, const char *given, const char *scheme) {
  static const char *const names[] = {"127.0.0.1", "localhost"};
  char own[64];
  for (size_t i = 0; given && i < 2; i++) {
    snprintf(own, sizeof own, "%s%s:%d", scheme, names[i], s->port);
    if (strcmp(given, own) == 0) return 1;
  }
  return 0;
}

static int may_come(const struct mg_connection *c, const sw_server *s, const char *path) {
  const struct mg_request_info *r = mg_get_request_info(c);
  return r->local_uri && is_ours(s, mg_get_header(c, "Host"), "") && same_text(r->local_uri, path);
}

/* --- the page itself ------------------------------------------------------------ */

static int refuse(struct mg_connection *c, int status, const char *words) {
  mg_printf(c,
            "HTTP/1.1 %d %s\r\nContent-Type: text/plain\r\nContent-Length: %zu\r\n"
            "X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n%s\n",
            status, words, strlen(words) + 1, words);
  return status;
}

static int give_page(struct mg_connection *c, void *user) {
  sw_server *s = user;
  if (!may_come(c, s, s->path)) return refuse(c, 403, "Forbidden");
  if (strcmp(mg_get_request_info(c)->request_method, "GET") != 0)
    return refuse(c, 405, "Method Not Allowed");
  pthread_mutex_lock(&s->lock);
  sw_parcel *html = s->html;
  if (html) html->readers++;
  pthread_mutex_unlock(&s->lock);
  if (!html) return refuse(c, 503, "Service Unavailable");
  mg_printf(
      c,
      "HTTP/1.1 200 OK\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: %zu\r\n"
      "Content-Security-Policy: %s\r\nX-Content-Type-Options: nosniff\r\n"
      "X-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\nCache-Control: no-store\r\n"
      "Cross-Origin-Opener-Policy: same-origin\r\nCross-Origin-Resource-Policy: same-origin\r\n"
      "Connection: close\r\n\r\n",
      html->size, s->policy);
  mg_write(c, html->bytes, html->size);
  pthread_mutex_lock(&s->lock);
  html->readers--;
  pthread_mutex_unlock(&s->lock);
  return 200;
}

/* --- writing to a page ------------------------------------------------------------ */

/* Returns the next slot that the page needs and may get now, texts first; -1: none. */
static int next_slot(const sw_server *s, const sw_page *p) {
  for (int k = SW_SERVER_TEXT; k < SW_SERVER_SLOTS; k++)
    if (s->slots[k] && p->sent[k] != s->numbers[k]) return k;
  const int frame = s->slots[SW_SERVER_FRAME] && p->ready &&
                    p->sent[SW_SERVER_FRAME] != s->numbers[SW_SERVER_FRAME];
  return frame ? SW_SERVER_FRAME : -1;
}

static void *write_to(void *user) {
  sw_page *p = user;
  sw_server *s = p->server;
  pthread_mutex_lock(&s->lock);
  while (!p->closing && !s->stopping) {
    const int k = p->broken ? -1 : next_slot(s, p);
    if (k < 0) {
      pthread_cond_wait(&s->news, &s->lock);
      continue;
    }
    sw_parcel *bytes = s->slots[k];
    bytes->readers++;
    p->sent[k] = s->numbers[k];
    if (k == SW_SERVER_FRAME) p->ready = 0;
    pthread_mutex_unlock(&s->lock);
    const int type = k == SW_SERVER_FRAME ? MG_WEBSOCKET_OPCODE_BINARY : MG_WEBSOCKET_OPCODE_TEXT;
    const int written = mg_websocket_write(p->connection, type, bytes->bytes, bytes->size);
    pthread_mutex_lock(&s->lock);
    bytes->readers--;
    if (written <= 0 || (size_t)written < bytes->size) p->broken = 1; /* page stopped reading */
  }
  pthread_mutex_unlock(&s->lock);
  return NULL;
}

/* --- reading from a page ------------------------------------------------------------- */

static int open_pages(const sw_server *s) {
  int count = 0;
  for (int k = 0; k < SW_SERVER_PAGES; k++) count += s->pages[k].connection != NULL;
  return count;
}

void sw_server_stir(sw_server *s) {
  s->stirred = 1;
  pthread_cond_broadcast(&s->news);
}

static int knock(const struct mg_connection *c, void *user) {
  sw_server *s = user;
  if (!may_come(c, s, s->socket) || !is_ours(s, mg_get_header(c, "Origin"), "http://")) return 1;
  pthread_mutex_lock(&s->lock);
  const int full = s->stopping || open_pages(s) >= SW_SERVER_PAGES;
  pthread_mutex_unlock(&s->lock);
  return full;
}

static void enter(struct mg_connection *c, void *user) {
  sw_server *s = user;
  sw_page *p = NULL;
  pthread_mutex_lock(&s->lock);
  for (int k = 0; k < SW_SERVER_PAGES && !p; k++)
    if (!s->pages[k].connection) p = &s->pages[k];
  if (p) {
    *p = (sw_page){.server = s, .connection = c, .number = ++s->count, .ready = 1};
    if (pthread_create(&p->writer, NULL, write_to, p) != 0) p->connection = NULL, p = NULL;
  }
  mg_set_user_connection_data(c, p);
  sw_server_stir(s);
  pthread_mutex_unlock(&s->lock);
}

/* Adds a message to the inbox; 0 if it is full, because the page sends faster than messages are
 * taken. */
static int keep_message(sw_server *s, const sw_page *p, const char *data, size_t size) {
  const unsigned head[2] = {(unsigned)p->number, (unsigned)size};
  if (s->filled + HEAD + size > INBOX) return 0;
  memcpy(s->inbox + s->filled, head, HEAD);
  memcpy(s->inbox + s->filled + HEAD, data, size);
  s->filled += HEAD + size;
  return 1;
}

/* Handles a message of a page; returning 0 closes the connection. */
static int hear(struct mg_connection *c, int bits, char *data, size_t size, void *user) {
  sw_server *s = user;
  sw_page *p = mg_get_user_connection_data(c);
  const int type = bits & 15, whole = bits & 128;
  if (!p) return 0;
  if (type == MG_WEBSOCKET_OPCODE_PING || type == MG_WEBSOCKET_OPCODE_PONG) return 1;
  if (type != MG_WEBSOCKET_OPCODE_TEXT || !whole || size >= SW_SERVER_MESSAGE) return 0;
  pthread_mutex_lock(&s->lock);
  int stays = !p->broken;
  if (size == 1 && data[0] == 'a')
    p->ready = 1;
  else
    stays = stays && keep_message(s, p, data, size);
  sw_server_stir(s);
  pthread_mutex_unlock(&s->lock);
  return stays;
}

static void leave(const struct mg_connection *c, void *user) {
  sw_server *s = user;
  sw_page *p = mg_get_user_connection_data(c);
  if (!p) return;
  pthread_mutex_lock(&s->lock);
  p->closing = 1;
  sw_server_stir(s);
  pthread_mutex_unlock(&s->lock);
  pthread_join(p->writer, NULL); /* a pending write ends at its time-out */
  pthread_mutex_lock(&s->lock);
  p->connection = NULL;
  sw_server_stir(s);
  pthread_mutex_unlock(&s->lock);
}

void sw_server_receive(sw_server *s) {
  mg_set_request_handler(s->context, "**", give_page, s);
  mg_set_websocket_handler(s->context, "**", knock, enter, hear, leave, s);
}
