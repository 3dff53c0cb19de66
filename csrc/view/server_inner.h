/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inner structs of the server, for its files only. */
#ifndef SW_VIEW_SERVER_INNER_H
#define SW_VIEW_SERVER_INNER_H

#include <pthread.h>
#include <stddef.h>

#include "view/server.h"

struct mg_connection;
struct mg_context;

enum { INBOX = 1 << 19, HEAD = 2 * sizeof(unsigned), ADDRESS = 40, POLICY = 512 };

/* Bytes to be sent. Only the thread of sw_server_put allocates and frees them. */
typedef struct sw_parcel {
  struct sw_parcel *next; /* in the list of old parcels */
  size_t size;
  int readers; /* number of threads that send it now */
  char bytes[];
} sw_parcel;

typedef struct sw_page {
  sw_server *server;
  struct mg_connection *connection; /* NULL: this entry is free */
  pthread_t writer;
  int number, ready, closing, broken;
  unsigned long sent[SW_SERVER_SLOTS]; /* for each slot: version last sent to this page */
} sw_page;

struct sw_server {
  struct mg_context *context;
  int port;
  char token[SW_SERVER_TOKEN], path[ADDRESS], socket[ADDRESS];
  char policy[POLICY];
  pthread_mutex_t lock; /* protects everything below */
  pthread_cond_t news;  /* wakes writers and sw_server_wait */
  sw_page pages[SW_SERVER_PAGES];
  sw_parcel *html, *slots[SW_SERVER_SLOTS], *old;
  unsigned long numbers[SW_SERVER_SLOTS];
  int stopping, stopped, count, stirred;
  size_t filled; /* bytes in the inbox; each message: page, size, bytes [B] */
  char inbox[INBOX];
};

/* Wakes writers and sw_server_wait after a change. The caller holds the lock. */
void sw_server_stir(sw_server *server);
/* Makes the server's context serve the page and accept connections. */
void sw_server_receive(sw_server *server);

#endif
