/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nearest places of two segments. */
#ifndef SW_BASE_SEGMENTS_H
#define SW_BASE_SEGMENTS_H

#include "base/vec.h"

/* Places s and t, both in [0, 1], where the segments a + s u and p + t v are
 * nearest; of parallel ones a pair near the middle of what overlaps is not
 * promised, only a nearest one. Zero lengths are allowed. */
static inline void sw_pair_segments(sw_vec a, sw_vec u, sw_vec p, sw_vec v, double *s, double *t) {
  const double parallel = 1e-14; /* squared sine of the angle below which it is taken as 0 [-] */
  const sw_vec w = sw_sub(a, p);
  const double uu = sw_norm2(u), uv = sw_dot(u, v), vv = sw_norm2(v);
  const double uw = sw_dot(u, w), vw = sw_dot(v, w);
  const double det = uu * vv - uv * uv;
  double first = 0;
  if (det > parallel * uu * vv) first = sw_limit((uv * vw - vv * uw) / det, 0, 1);
  const double second = vv > 0 ? sw_limit((uv * first + vw) / vv, 0, 1) : 0;
  *s = uu > 0 ? sw_limit((uv * second - uw) / uu, 0, 1) : 0;
  *t = vv > 0 ? sw_limit((uv * *s + vw) / vv, 0, 1) : 0;
}

#endif
