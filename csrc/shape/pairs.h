/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nearest places between points, segments and triangles. */
#ifndef SW_SHAPE_PAIRS_H
#define SW_SHAPE_PAIRS_H

#include "base/segments.h"
#include "shape/shape_class.h"

/* Part of a triangle: inside, side k (corner k to k + 1), corner k. */
enum { SW_ON_FACE = 0, SW_ON_SIDE = 1, SW_ON_CORNER = 4 };

typedef struct sw_triangle {
  sw_vec v[3]; /* corners [m] */
  sw_vec n;    /* unit normal [-] */
} sw_triangle;

/* Returns the nearest place of the triangle to p, and its part of the triangle. */
static inline sw_vec sw_pair_triangle(const sw_triangle *tri, sw_vec p, int *part) {
  sw_vec best = tri->v[0];
  double best2 = INFINITY;
  int outside = 0;
  for (int k = 0; k < 3; k++) {
    const sw_vec from = tri->v[k], side = sw_sub(tri->v[(k + 1) % 3], from);
    const sw_vec w = sw_sub(p, from);
    if (sw_dot(tri->n, sw_cross(side, w)) >= 0) continue;
    outside = 1;
    const double t = sw_limit(sw_dot(w, side) / sw_norm2(side), 0, 1);
    const sw_vec q = t < 1 ? sw_madd(from, side, t) : tri->v[(k + 1) % 3];
    const double d2 = sw_norm2(sw_sub(p, q));
    if (d2 >= best2) continue;
    best = q, best2 = d2;
    *part = t <= 0 ? SW_ON_CORNER + k : t >= 1 ? SW_ON_CORNER + (k + 1) % 3 : SW_ON_SIDE + k;
  }
  if (outside) return best;
  *part = SW_ON_FACE;
  return sw_madd(p, tri->n, -sw_dot(tri->n, sw_sub(p, tri->v[0])));
}

/* Finds the nearest place of the segment a-b to the triangle (an sw_triangle). The gap is unsigned
 * and the normal points to the segment. A segment that pierces the triangle has gap 0 and the
 * triangle's normal. */
void sw_triangle_nearest(const void *triangle, sw_vec a, sw_vec b, sw_closest *out);

#endif
