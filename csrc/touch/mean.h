/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A place on a body as a weighted mean of nodes: on a wire's chord or smooth curve, on an edge
 * between particles, or at a node. */
#ifndef SW_TOUCH_MEAN_H
#define SW_TOUCH_MEAN_H

#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

enum { SW_MEAN_MOST = 3 };

typedef struct sw_mean {
  uint32_t count;
  uint32_t node[SW_MEAN_MOST]; /* in the system's arrays */
  double w[SW_MEAN_MOST];      /* their shares; the sum is 1 [-] */
} sw_mean;

static inline sw_mean sw_mean_chord(size_t node, size_t other, double at) {
  const uint32_t a = (uint32_t)node, b = (uint32_t)other;
  if (a == b) return (sw_mean){1, {a, a, a}, {1.0, 0, 0}};
  return (sw_mean){2, {a, b, b}, {1.0 - at, at, 0}};
}

/* A place on the smooth curve's piece around the node after `before`. The curve is a quadratic
 * B-spline; the nodes are its control points, and it touches the edges in their middles, where v is
 * 0 and 1. */
static inline sw_mean sw_mean_around(size_t before, double v) {
  const double a = 0.5 * (1.0 - v) * (1.0 - v), e = 0.5 * v * v;
  const uint32_t n = (uint32_t)before;
  return (sw_mean){3, {n, n + 1, n + 2}, {a, 1.0 - a - e, e}};
}

/* A place on the curve of a wire with nodes from first to last, s edges from the first one. The
 * curve's first and last half edge are straight. */
static inline sw_mean sw_mean_curve(size_t first, size_t last, double s) {
  const double edges = (double)(last - first);
  if (s <= 0.5 || edges < 2) return sw_mean_chord(first, first + 1, fmin(fmax(s, 0), 1));
  if (s >= edges - 0.5) return sw_mean_chord(last - 1, last, fmin(s - edges + 1.0, 1));
  const double centre = floor(s + 0.5);
  return sw_mean_around(first + (size_t)centre - 1, s - centre + 0.5);
}

/* The place's position in an array of nodes (n x 3) that begins with node number first. */
static inline sw_vec sw_mean_of(const double *x, size_t first, const sw_mean *spot) {
  const sw_vec one = sw_vec_at(x, spot->node[0] - first);
  if (spot->count == 1) return one;
  if (spot->count == 2) return sw_lerp(one, sw_vec_at(x, spot->node[1] - first), spot->w[1]);
  return sw_madd(
      sw_madd(sw_scale(one, spot->w[0]), sw_vec_at(x, spot->node[1] - first), spot->w[1]),
      sw_vec_at(x, spot->node[2] - first), spot->w[2]);
}

#endif
