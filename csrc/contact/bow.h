/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A place along a wire that meets another one: nodes in a row, their shares, and how these change
 * with the place. */
#ifndef SW_CONTACT_BOW_H
#define SW_CONTACT_BOW_H

#include <stdint.h>

#include "base/vec.h"

enum { SW_BOW_MOST = 3 };

typedef struct sw_bow {
  uint32_t first, count;     /* of the nodes, in the system's arrays; 2 of a chord, 3 of a curve */
  double w[SW_BOW_MOST];     /* their shares; the sum is 1 [-] */
  double slope[SW_BOW_MOST]; /* derivatives of these by the place, in edges; the sum is 0 [-] */
} sw_bow;

/* On the chord from a node to the next one. */
static inline sw_bow sw_bow_chord(uint32_t node, double at) {
  return (sw_bow){node, 2, {1.0 - at, at, 0}, {-1, 1, 0}};
}

/* The same mean of what nodes have (n x 3). */
static inline sw_vec sw_bow_place(const double *x, const sw_bow *b) {
  if (b->count == 2) return sw_lerp(sw_vec_at(x, b->first), sw_vec_at(x, b->first + 1u), b->w[1]);
  return sw_madd(
      sw_madd(sw_scale(sw_vec_at(x, b->first), b->w[0]), sw_vec_at(x, b->first + 1u), b->w[1]),
      sw_vec_at(x, b->first + 2u), b->w[2]);
}

/* Derivative of the place by itself, in edges [m]. */
static inline sw_vec sw_bow_along(const double *x, const sw_bow *b) {
  const sw_vec before = sw_sub(sw_vec_at(x, b->first + 1u), sw_vec_at(x, b->first));
  if (b->count == 2) return before;
  const sw_vec after = sw_sub(sw_vec_at(x, b->first + 2u), sw_vec_at(x, b->first + 1u));
  return sw_madd(sw_scale(before, -b->slope[0]), after, b->slope[2]);
}

/* The second one; of the shares, 1, -2, 1 [m]. */
static inline sw_vec sw_bow_bend(const double *x, const sw_bow *b) {
  if (b->count == 2) return sw_v(0, 0, 0);
  const sw_vec before = sw_sub(sw_vec_at(x, b->first + 1u), sw_vec_at(x, b->first));
  const sw_vec after = sw_sub(sw_vec_at(x, b->first + 2u), sw_vec_at(x, b->first + 1u));
  return sw_sub(after, before);
}

#endif
