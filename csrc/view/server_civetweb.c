/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The server, with the library CivetWeb. For each page a thread of CivetWeb reads from it and a
 * thread of this program writes to it. So a page that stops reading delays no other page. */
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
#include "view/server_inner.h"

static int say_nothing(const struct mg_connection *c SW_UNUSED, const char *message SW_UNUSED) {
  return 1;
}

/* --- starting and stopping ------------------------------------------------------------ */

/* Checks that the port is free; port 0: finds a free one and sets it. */
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
    return sw_fail(
        err, SW_EINVAL,
        "port %d is used by another program; give another port, or port = 0 for any that is free",
        *port);
  return sw_fail(err, SW_EINVAL, "cannot listen on port %d: %s", *port, strerror(why));
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

/* Starts CivetWeb. Its threads start with all signals blocked, so that the thread of Lua gets
 * them. */
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

/* Makes the lock and its condition, which waits by the monotonic clock. */
static void init_lock(sw_server *s) {
  pthread_mutex_init(&s->lock, NULL);
  pthread_condattr_t clock;
  pthread_condattr_init(&clock);
  pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
  pthread_cond_init(&s->news, &clock);
  pthread_condattr_destroy(&clock);
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
                           NULL}; /* name, value, name, value, ... */
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
  init_lock(s);
  if (!libraries++) mg_init_library(MG_FEATURES_DEFAULT);
  s->context = start_quietly(s, options);
  if (!s->context) {
    sw_server_stop(s);
    return sw_fail(err, SW_EINVAL, "the server of pages does not start on port %d", port);
  }
  sw_server_receive(s);
  *out = s;
  return SW_OK;
}

static void free_old(sw_server *s) {
  sw_parcel **at = &s->old;
  while (*at) {
    sw_parcel *p = *at;
    if (p->readers) {
      at = &p->next;
      continue;
    }
    *at = p->next;
    sw_free(p);
  }
}

static void retire(sw_server *s, sw_parcel *p) {
  if (p) p->next = s->old, s->old = p;
}

/* Connects to the server again and again until it has stopped. CivetWeb's listening thread checks
 * for the stop every two seconds, or at a connection; this makes it check at once. */
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
  sw_server_stir(s);
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

/* --- functions for Lua's thread -------------------------------------------------------- */

/* Replaces the parcel at *place by a copy of bytes. */
static sw_status replace(sw_server *s, sw_parcel **place, const void *bytes, size_t size) {
  sw_parcel *p = sw_alloc_bytes(sizeof *p + size);
  if (!p) return SW_ENOMEM;
  *p = (sw_parcel){.size = size};
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
  SW_ITEMS(const sw_page, p, s->pages, SW_SERVER_PAGES) {
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
