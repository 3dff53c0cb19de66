/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nearest points of two segments. */
#ifndef SW_BASE_SEGMENTS_H
#define SW_BASE_SEGMENTS_H

#include "base/vec.h"

/* Finds s and t, both in [0, 1], where the segments a + s u and p + t v are nearest. For
 * parallel segments it finds one of the nearest pairs, not always one near the middle of
 * the overlap. Zero lengths are allowed. */
static inline void sw_pair_segments(sw_vec a, sw_vec u, sw_vec p, sw_vec v, double *s, double *t) {
  const double parallel = 1e-14; /* squared sine of the largest angle of parallel segments [-] */
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
