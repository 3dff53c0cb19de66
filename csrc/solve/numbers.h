/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A list of numbers as work space, which passes from one matrix to the next. A bundle of wires gets
 * another pattern in every third iteration; new memory for each would cost a fifth of its time. */
#ifndef SW_SOLVE_NUMBERS_H
#define SW_SOLVE_NUMBERS_H

#include "base/alloc.h"
#include "base/status.h"

typedef struct sw_numbers {
  double *at;
  size_t room; /* [-] */
} sw_numbers;

/* Makes room for `need` numbers: takes old's list over if it is large enough, else frees it. They
 * are not zeroed then. old: NULL if nothing came before, and nothing will follow. SW_ENOMEM. */
static inline sw_status sw_numbers_make(sw_numbers *n, sw_numbers *old, size_t need) {
  if (old && old->at && old->room >= need) {
    *n = *old;
  } else {
    if (old) sw_free(old->at);                        /* else both would be in use at once */
    const size_t room = old ? need + need / 4 : need; /* further patterns will come */
    n->at = sw_alloc(room, sizeof *n->at);
    n->room = n->at ? room : 0;
  }
  if (old) *old = (sw_numbers){NULL, 0};
  return n->at ? SW_OK : SW_ENOMEM;
}

#endif
