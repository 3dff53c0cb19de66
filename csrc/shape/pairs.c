/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nearest points of a segment and a triangle: crossing, corners, sides. */
#include "shape/pairs.h"

/* Finds where the segment goes through the triangle; 0: it does not. */
static int pierced(const sw_triangle *tri, sw_vec a, sw_vec b, sw_closest *out) {
  const double above = sw_dot(tri->n, sw_sub(a, tri->v[0]));
  const double below = sw_dot(tri->n, sw_sub(b, tri->v[0]));
  if ((above > 0) == (below > 0) || above == below) return 0;
  const double at = sw_limit(above / (above - below), 0, 1);
  const sw_vec p = sw_lerp(a, b, at);
  for (int k = 0; k < 3; k++) {
    const sw_vec side = sw_sub(tri->v[(k + 1) % 3], tri->v[k]);
    if (sw_dot(tri->n, sw_cross(side, sw_sub(p, tri->v[k]))) < 0) return 0;
  }
  *out = (sw_closest){0, at, tri->n, p, 0};
  return 1;
}

typedef struct best {
  double d2; /* [m2] */
  double at;
  sw_vec q;
  int part;
} best;

static void offer(best *so_far, sw_vec p, sw_vec q, double at, int part) {
  const double d2 = sw_norm2(sw_sub(p, q));
  if (d2 < so_far->d2) *so_far = (best){d2, at, q, part};
}

void sw_triangle_nearest(const void *triangle, sw_vec a, sw_vec b, sw_closest *out) {
  const sw_triangle *tri = triangle;
  const sw_vec d = sw_sub(b, a);
  best found = {HUGE_VAL, 0, tri->v[0], SW_ON_FACE};
  if (pierced(tri, a, b, out)) return;
  for (int end = 0; end < 2; end++) {
    int part = SW_ON_FACE;
    const sw_vec p = end ? b : a;
    const sw_vec q = sw_pair_triangle(tri, p, &part);
    offer(&found, p, q, end, part);
  }
  for (int k = 0; k < 3; k++) {
    const sw_vec side = sw_sub(tri->v[(k + 1) % 3], tri->v[k]);
    double s, t;
    sw_pair_segments(a, d, tri->v[k], side, &s, &t);
    offer(&found, sw_madd(a, d, s), sw_madd(tri->v[k], side, t), s, SW_ON_SIDE + k);
  }
  const sw_vec w = sw_sub(sw_madd(a, d, found.at), found.q);
  const double gap = sqrt(found.d2);
  sw_vec n = sw_unit_or(w, tri->n);
  if (found.part == SW_ON_FACE) n = sw_dot(w, tri->n) < 0 ? sw_neg(tri->n) : tri->n;
  *out = (sw_closest){gap, found.at, n, found.q, 0};
}
