/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A place where one body touches another, and its derivatives along the body. The place lies on a
 * segment or a curve of a wire, on an edge between particles, or at a node. */
#ifndef SW_TOUCH_BOW_H
#define SW_TOUCH_BOW_H

#include "touch/mean.h"

typedef struct sw_bow {
  sw_mean spot;
  double
      slope[SW_MEAN_MOST]; /* derivatives of the shares by the place in edges; their sum is 0 [-] */
} sw_bow;

/* A place on the chord between two nodes, or at one node (end = node). */
static inline sw_bow sw_bow_between(size_t node, size_t end, double at) {
  return (sw_bow){sw_mean_chord(node, end, at), {-1, 1, 0}};
}

static inline sw_bow sw_bow_chord(size_t node, double at) {
  return sw_bow_between(node, node + 1, at);
}

static inline sw_bow sw_bow_around(size_t before, double v) {
  return (sw_bow){sw_mean_around(before, v), {v - 1.0, 1.0 - 2.0 * v, v}};
}

/* Vector from the place's node k to its next node, in an array of nodes (n x 3) [m]. */
static inline sw_vec sw_bow_edge(const double *x, const sw_bow *b, int k) {
  return sw_sub(sw_vec_at(x, b->spot.node[k + 1]), sw_vec_at(x, b->spot.node[k]));
}

/* First derivative of the position by the place, which counts edges [m]. */
static inline sw_vec sw_bow_along(const double *x, const sw_bow *b) {
  const sw_vec before = sw_bow_edge(x, b, 0);
  if (b->spot.count < 3) return before;
  return sw_madd(sw_scale(before, -b->slope[0]), sw_bow_edge(x, b, 1), b->slope[2]);
}

/* Second derivative of the position by the place. Second derivatives of the shares are 1, -2, 1
 * [m]. */
static inline sw_vec sw_bow_bend(const double *x, const sw_bow *b) {
  if (b->spot.count < 3) return sw_v(0, 0, 0);
  return sw_sub(sw_bow_edge(x, b, 1), sw_bow_edge(x, b, 0));
}

/* Vector from the second place to the first one, in an array of nodes (n x 3) [m]. */
static inline sw_vec sw_bows_apart(const double *x, const sw_bow bow[2]) {
  return sw_sub(sw_mean_of(x, 0, &bow[0].spot), sw_mean_of(x, 0, &bow[1].spot));
}

#endif
