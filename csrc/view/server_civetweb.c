/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The server, by CivetWeb: a thread of its own reads from each page, another one of ours writes to
 * it, so that a page that stops reading holds up nobody else. */
#include <arpa/inet.h>
#include <civetweb.h>
#include <errno.h>
#include <netinet/in.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/each.h"
#include "view/server.h"

enum { INBOX = 1 << 19, HEAD = 2 * sizeof(unsigned), ADDRESS = 40, POLICY = 512 };

/* Bytes on their way; freed by the thread of sw_server_put, which alone allocates. */
typedef struct parcel {
  struct parcel *next; /* of those that are out of date */
  size_t size;
  int readers; /* threads that send it */
  char bytes[];
} parcel;

typedef struct page {
  sw_server *server;
  struct mg_connection *connection; /* NULL: this place is free */
  pthread_t writer;
  int number, ready, closing, broken;
  unsigned long sent[SW_SERVER_SLOTS]; /* number of the bytes that it has got */
} page;

struct sw_server {
  struct mg_context *context;
  int port;
  char token[SW_SERVER_TOKEN], path[ADDRESS], socket[ADDRESS];
  char policy[POLICY];
  pthread_mutex_t lock; /* of all below */
  pthread_cond_t news;  /* for writers, and for who waits */
  page pages[SW_SERVER_PAGES];
  parcel *html, *slots[SW_SERVER_SLOTS], *old;
  unsigned long numbers[SW_SERVER_SLOTS];
  int stopping, stopped, count, stirred;
  size_t filled; /* of the inbox: page, size, bytes; again and again [B] */
  char inbox[INBOX];
};

/* --- who may come ------------------------------------------------------------- */

/* In a time that does not depend on where they differ. */
static int same_text(const char *a, const char *b) {
  const size_t n = strlen(b);
  unsigned char differs = strlen(a) != n;
  for (size_t i = 0; i < n && a[i]; i++) differs |= (unsigned char)(a[i] ^ b[i]);
  return !differs;
}

/* Is it this machine's name, with our port, after a scheme? */
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
  parcel *html = s->html;
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

/* What the page has not got yet, and may get now; texts come first. */
static int next_slot(const sw_server *s, const page *p) {
  for (int k = SW_SERVER_TEXT; k < SW_SERVER_SLOTS; k++)
    if (s->slots[k] && p->sent[k] != s->numbers[k]) return k;
  const int frame = s->slots[SW_SERVER_FRAME] && p->ready &&
                    p->sent[SW_SERVER_FRAME] != s->numbers[SW_SERVER_FRAME];
  return frame ? SW_SERVER_FRAME : -1;
}

static void *write_to(void *user) {
  page *p = user;
  sw_server *s = p->server;
  pthread_mutex_lock(&s->lock);
  while (!p->closing && !s->stopping) {
    const int k = p->broken ? -1 : next_slot(s, p);
    if (k < 0) {
      pthread_cond_wait(&s->news, &s->lock);
      continue;
    }
    parcel *bytes = s->slots[k];
    bytes->readers++;
    p->sent[k] = s->numbers[k];
    if (k == SW_SERVER_FRAME) p->ready = 0;
    pthread_mutex_unlock(&s->lock);
    const int type = k == SW_SERVER_FRAME ? MG_WEBSOCKET_OPCODE_BINARY : MG_WEBSOCKET_OPCODE_TEXT;
    const int written = mg_websocket_write(p->connection, type, bytes->bytes, bytes->size);
    pthread_mutex_lock(&s->lock);
    bytes->readers--;
    if (written <= 0 || (size_t)written < bytes->size) p->broken = 1; /* it stopped reading */
  }
  pthread_mutex_unlock(&s->lock);
  return NULL;
}

/* --- reading from it ---------------------------------------------------------------- */

static int open_pages(const sw_server *s) {
  int count = 0;
  for (int k = 0; k < SW_SERVER_PAGES; k++) count += s->pages[k].connection != NULL;
  return count;
}

static void stir(sw_server *s) {
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
  page *p = NULL;
  pthread_mutex_lock(&s->lock);
  for (int k = 0; k < SW_SERVER_PAGES && !p; k++)
    if (!s->pages[k].connection) p = &s->pages[k];
  if (p) {
    *p = (page){.server = s, .connection = c, .number = ++s->count, .ready = 1};
    if (pthread_create(&p->writer, NULL, write_to, p) != 0) p->connection = NULL, p = NULL;
  }
  mg_set_user_connection_data(c, p);
  stir(s);
  pthread_mutex_unlock(&s->lock);
}

/* 0: there is no room, the page says more than anybody can do. */
static int keep_message(sw_server *s, const page *p, const char *data, size_t size) {
  const unsigned head[2] = {(unsigned)p->number, (unsigned)size};
  if (s->filled + HEAD + size > INBOX) return 0;
  memcpy(s->inbox + s->filled, head, HEAD);
  memcpy(s->inbox + s->filled + HEAD, data, size);
  s->filled += HEAD + size;
  return 1;
}

/* 0 closes the connection. */
static int hear(struct mg_connection *c, int bits, char *data, size_t size, void *user) {
  sw_server *s = user;
  page *p = mg_get_user_connection_data(c);
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
  stir(s);
  pthread_mutex_unlock(&s->lock);
  return stays;
}

static void leave(const struct mg_connection *c, void *user) {
  sw_server *s = user;
  page *p = mg_get_user_connection_data(c);
  if (!p) return;
  pthread_mutex_lock(&s->lock);
  p->closing = 1;
  stir(s);
  pthread_mutex_unlock(&s->lock);
  pthread_join(p->writer, NULL); /* a write ends by its time-out */
  pthread_mutex_lock(&s->lock);
  p->connection = NULL;
  stir(s);
  pthread_mutex_unlock(&s->lock);
}

static int say_nothing(const struct mg_connection *c, const char *message) {
  (void)c, (void)message;
  return 1;
}

/* --- starting and stopping ------------------------------------------------------------ */

/* Is the port free? Sets it when any will do. */
static sw_status find_port(int *port, sw_error *err) {
  struct sockaddr_in at = {.sin_family = AF_INET, .sin_port = htons((unsigned short)*port)};
  socklen_t size = sizeof at;
  const int on = 1, fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  int fine = fd >= 0 && setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
             bind(fd, (struct sockaddr *)&at, sizeof at) == 0 && listen(fd, 1) == 0 &&
             getsockname(fd, (struct sockaddr *)&at, &size) == 0;
  const int why = errno;
  if (fd >= 0) close(fd);
  if (fine) *port = ntohs(at.sin_port);
  if (fine) return SW_OK;
  if (why == EADDRINUSE)
    return sw_fail(err, SW_EINVAL,
                   "port %d is taken by another program; give another one, or port = 0 for any "
                   "that is free",
                   *port);
  return sw_fail(err, SW_EINVAL, "port %d cannot be listened on: %s", *port, strerror(why));
}

static sw_status draw_token(sw_server *s, sw_error *err) {
  unsigned char bits[16];
  if (getrandom(bits, sizeof bits, 0) != (ssize_t)sizeof bits)
    return sw_fail(err, SW_EINVAL, "no random numbers: %s", strerror(errno));
  for (size_t i = 0; i < sizeof bits; i++) snprintf(s->token + 2 * i, 3, "%02x", bits[i]);
  snprintf(s->path, ADDRESS, "/%s/", s->token);
  snprintf(s->socket, ADDRESS, "/%s/s", s->token);
  return SW_OK;
}

/* Signals stay with the thread of Lua: its threads are born with all of them blocked. */
static struct mg_context *start_quietly(sw_server *s, const char **options) {
  static const struct mg_callbacks callbacks = {.log_message = say_nothing,
                                                .log_access = say_nothing};
  struct sigaction pipe;
  sigset_t all, before;
  sigfillset(&all);
  sigaction(SIGPIPE, NULL, &pipe);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  struct mg_context *context = mg_start(&callbacks, s, options);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  sigaction(SIGPIPE, &pipe, NULL);
  return context;
}

sw_status sw_server_start(int port, sw_server **out, sw_error *err) {
  static int libraries;
  char address[32];
  const char *options[] = {"listening_ports",
                           address,
                           "num_threads",
                           "12",
                           "request_timeout_ms",
                           "700",
                           "websocket_timeout_ms",
                           "400",
                           "enable_websocket_ping_pong",
                           "yes",
                           "enable_keep_alive",
                           "no",
                           "tcp_nodelay",
                           "1",
                           NULL};
  SW_TRY(find_port(&port, err));
  sw_server *s = sw_alloc(1, sizeof *s);
  if (!s) return sw_fail(err, SW_ENOMEM, "out of memory for the server of pages");
  s->port = port;
  sw_status status = draw_token(s, err);
  if (status != SW_OK) {
    sw_free(s);
    return status;
  }
  snprintf(address, sizeof address, "127.0.0.1:%d", port);
  pthread_mutex_init(&s->lock, NULL);
  pthread_condattr_t clock;
  pthread_condattr_init(&clock);
  pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
  pthread_cond_init(&s->news, &clock);
  pthread_condattr_destroy(&clock);
  if (!libraries++) mg_init_library(MG_FEATURES_DEFAULT);
  s->context = start_quietly(s, options);
  if (!s->context) {
    sw_server_stop(s);
    return sw_fail(err, SW_EINVAL, "the server of pages does not start on port %d", port);
  }
  mg_set_request_handler(s->context, "**", give_page, s);
  mg_set_websocket_handler(s->context, "**", knock, enter, hear, leave, s);
  *out = s;
  return SW_OK;
}

static void free_old(sw_server *s) {
  parcel **at = &s->old;
  while (*at) {
    parcel *p = *at;
    if (p->readers) {
      at = &p->next;
      continue;
    }
    *at = p->next;
    sw_free(p);
  }
}

static void retire(sw_server *s, parcel *p) {
  if (p) p->next = s->old, s->old = p;
}

/* Its listening thread looks at the wish to stop every two seconds, or when somebody comes: so
 * somebody comes, until it has stopped. */
static void *wake(void *user) {
  sw_server *s = user;
  struct sockaddr_in at = {.sin_family = AF_INET, .sin_port = htons((unsigned short)s->port)};
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (int stopped = 0; !stopped;) {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd >= 0) (void)connect(fd, (struct sockaddr *)&at, sizeof at);
    nanosleep(&(struct timespec){0, 20000000}, NULL);
    if (fd >= 0) close(fd);
    pthread_mutex_lock(&s->lock);
    stopped = s->stopped;
    pthread_mutex_unlock(&s->lock);
  }
  return NULL;
}

static void stop_context(sw_server *s) {
  pthread_t waker;
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const int helped = pthread_create(&waker, NULL, wake, s) == 0;
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  mg_stop(s->context);
  pthread_mutex_lock(&s->lock);
  s->stopped = 1;
  pthread_mutex_unlock(&s->lock);
  if (helped) pthread_join(waker, NULL);
}

void sw_server_stop(sw_server *s) {
  if (!s) return;
  pthread_mutex_lock(&s->lock);
  s->stopping = 1;
  stir(s);
  pthread_mutex_unlock(&s->lock);
  if (s->context) stop_context(s);
  for (int k = 0; k < SW_SERVER_SLOTS; k++) retire(s, s->slots[k]);
  retire(s, s->html);
  free_old(s);
  pthread_cond_destroy(&s->news);
  pthread_mutex_destroy(&s->lock);
  sw_free(s);
}

int sw_server_port(const sw_server *s) { return s->port; }
const char *sw_server_token(const sw_server *s) { return s->token; }

/* --- the side of Lua's thread ---------------------------------------------------------- */

/* Put a copy of the bytes in the place of others. */
static sw_status replace(sw_server *s, parcel **place, const void *bytes, size_t size) {
  parcel *p = sw_alloc_bytes(sizeof *p + size);
  if (!p) return SW_ENOMEM;
  *p = (parcel){.size = size};
  memcpy(p->bytes, bytes, size);
  retire(s, *place);
  *place = p;
  free_old(s);
  return SW_OK;
}

sw_status sw_server_set_page(sw_server *s, const void *bytes, size_t size, const char *policy) {
  pthread_mutex_lock(&s->lock);
  snprintf(s->policy, POLICY, "%s", policy);
  const sw_status status = replace(s, &s->html, bytes, size);
  pthread_mutex_unlock(&s->lock);
  return status;
}

sw_status sw_server_put(sw_server *s, int slot, const void *bytes, size_t size) {
  pthread_mutex_lock(&s->lock);
  const sw_status status = replace(s, &s->slots[slot], bytes, size);
  if (status == SW_OK) s->numbers[slot]++;
  pthread_cond_broadcast(&s->news);
  pthread_mutex_unlock(&s->lock);
  return status;
}

size_t sw_server_pages(sw_server *s, size_t *waiting) {
  size_t count = 0;
  *waiting = 0;
  pthread_mutex_lock(&s->lock);
  SW_ITEMS(const page, p, s->pages, SW_SERVER_PAGES) {
    if (!p->connection || p->broken || p->closing) continue;
    count++;
    *waiting += (size_t)p->ready;
  }
  pthread_mutex_unlock(&s->lock);
  return count;
}

size_t sw_server_take(sw_server *s, char *out, size_t room, int *page_number) {
  unsigned head[2] = {0, 0};
  pthread_mutex_lock(&s->lock);
  if (s->filled) {
    memcpy(head, s->inbox, HEAD);
    memcpy(out, s->inbox + HEAD, head[1] < room ? head[1] : room);
    s->filled -= HEAD + head[1];
    memmove(s->inbox, s->inbox + HEAD + head[1], s->filled);
  }
  pthread_mutex_unlock(&s->lock);
  *page_number = (int)head[0];
  return head[1];
}

void sw_server_wait(sw_server *s, double seconds) {
  struct timespec end;
  clock_gettime(CLOCK_MONOTONIC, &end);
  const double due = (double)end.tv_nsec * 1e-9 + seconds;
  end.tv_sec += (time_t)due;
  end.tv_nsec = (long)(1e9 * (due - (double)(time_t)due));
  pthread_mutex_lock(&s->lock);
  while (!s->stirred && !s->filled)
    if (pthread_cond_timedwait(&s->news, &s->lock, &end) != 0) break;
  s->stirred = 0;
  pthread_mutex_unlock(&s->lock);
}
