/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The series of wires and forces as a scene keeps them. */
#ifndef SW_RECORD_WATCHES_H
#define SW_RECORD_WATCHES_H

#include <stddef.h>

typedef struct sw_watch sw_watch; /* the rows of one object */

typedef struct sw_watches {
  sw_watch *list;
  size_t count, capacity;
  size_t next; /* where the object that is noted next is likely to be [-] */
} sw_watches;

#endif
