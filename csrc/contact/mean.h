/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A place of a wire as a mean of nodes. */
#ifndef SW_CONTACT_MEAN_H
#define SW_CONTACT_MEAN_H

#include <stddef.h>

#include "base/vec.h"

enum { SW_MEAN_MOST = 3 };

typedef struct sw_mean {
  size_t count;
  size_t node[SW_MEAN_MOST];
  double w[SW_MEAN_MOST]; /* their shares; the sum is 1 [-] */
} sw_mean;

static inline sw_mean sw_mean_chord(size_t node, size_t other, double at) {
  if (node == other) return (sw_mean){1, {node, node, node}, {1.0, 0, 0}};
  return (sw_mean){2, {node, other, other}, {1.0 - at, at, 0}};
}

/* On the smooth curve of a wire of nodes from first to last, s edges from the first: a quadratic
 * B-spline that they control, touching the edges in their middles. Its first and last half edge are
 * straight. */
static inline sw_mean sw_mean_curve(size_t first, size_t last, double s) {
  const double edges = (double)(last - first);
  if (s <= 0.5 || edges < 2) return sw_mean_chord(first, first + 1, fmin(fmax(s, 0), 1));
  if (s >= edges - 0.5) return sw_mean_chord(last - 1, last, fmin(s - edges + 1.0, 1));
  const double centre = floor(s + 0.5), v = s - centre + 0.5;
  const double a = 0.5 * (1.0 - v) * (1.0 - v), e = 0.5 * v * v;
  const size_t p = first + (size_t)centre;
  return (sw_mean){3, {p - 1, p, p + 1}, {a, 1.0 - a - e, e}};
}

/* The same mean of what nodes have (n x 3), the first of which has this number. */
static inline sw_vec sw_mean_of(const double *x, size_t first, const sw_mean *spot) {
  const sw_vec one = sw_vec_at(x, spot->node[0] - first);
  if (spot->count == 1) return one;
  if (spot->count == 2) return sw_lerp(one, sw_vec_at(x, spot->node[1] - first), spot->w[1]);
  return sw_madd(
      sw_madd(sw_scale(one, spot->w[0]), sw_vec_at(x, spot->node[1] - first), spot->w[1]),
      sw_vec_at(x, spot->node[2] - first), spot->w[2]);
}

#endif
