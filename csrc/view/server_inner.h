/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of the server. Of its files only. */
#ifndef SW_VIEW_SERVER_INNER_H
#define SW_VIEW_SERVER_INNER_H

#include <pthread.h>
#include <stddef.h>

#include "view/server.h"

struct mg_connection;
struct mg_context;

enum { INBOX = 1 << 19, HEAD = 2 * sizeof(unsigned), ADDRESS = 40, POLICY = 512 };

/* Bytes on their way; freed by the thread of sw_server_put, which alone allocates. */
typedef struct sw_parcel {
  struct sw_parcel *next; /* of those that are out of date */
  size_t size;
  int readers; /* threads that send it */
  char bytes[];
} sw_parcel;

typedef struct sw_page {
  sw_server *server;
  struct mg_connection *connection; /* NULL: this place is free */
  pthread_t writer;
  int number, ready, closing, broken;
  unsigned long sent[SW_SERVER_SLOTS]; /* number of the bytes that it has got */
} sw_page;

struct sw_server {
  struct mg_context *context;
  int port;
  char token[SW_SERVER_TOKEN], path[ADDRESS], socket[ADDRESS];
  char policy[POLICY];
  pthread_mutex_t lock; /* of all below */
  pthread_cond_t news;  /* for writers, and for who waits */
  sw_page pages[SW_SERVER_PAGES];
  sw_parcel *html, *slots[SW_SERVER_SLOTS], *old;
  unsigned long numbers[SW_SERVER_SLOTS];
  int stopping, stopped, count, stirred;
  size_t filled; /* of the inbox: page, size, bytes; again and again [B] */
  char inbox[INBOX];
};

/* The server has changed: wakes writers, and who waits. Its lock is held. */
void sw_server_stir(sw_server *server);
/* Its context gives the page and takes connections from now on. */
void sw_server_receive(sw_server *server);

#endif
