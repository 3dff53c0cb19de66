/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads one number for each of four nodes, repeated for the three components of each node. */
#ifndef SW_BASE_SPREAD_H
#define SW_BASE_SPREAD_H

#include <string.h>

#pragma GCC diagnostic ignored "-Wpsabi" /* vectors stay inside the files that use them */

typedef double sw_quad __attribute__((vector_size(32), aligned(8)));

typedef struct sw_spread {
  sw_quad part[3];
} sw_spread;

static inline __attribute__((always_inline)) sw_quad sw_quad_load(const double *p) {
  sw_quad q;
  memcpy(&q, p, sizeof q);
  return q;
}

/* Loads twelve successive numbers: the components of four nodes. */
static inline __attribute__((always_inline)) sw_spread sw_spread_load(const double *p) {
  return (sw_spread){{sw_quad_load(p), sw_quad_load(p + 4), sw_quad_load(p + 8)}};
}

/* Loads the numbers of four nodes, each three times. */
static inline __attribute__((always_inline)) sw_spread sw_spread_of(const double *p) {
  const sw_quad q = sw_quad_load(p);
  return (sw_spread){{__builtin_shufflevector(q, q, 0, 0, 0, 1),
                      __builtin_shufflevector(q, q, 1, 1, 2, 2),
                      __builtin_shufflevector(q, q, 2, 3, 3, 3)}};
}

#endif
