/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The angle of a crease: how far the strip from b to c is turned against the strip from a to b,
 * about their common edge. */
#ifndef SW_STATE_CREASE_H
#define SW_STATE_CREASE_H

#include <math.h>

#include "base/vec.h"

/* Narrower strips are taken as wide as the square root of this share of the edge [-]. */
static const double SW_CREASE_LEAST = 1e-12;

/* Returns the angle in (-pi, pi], positive for an anticlockwise turn about e. q0 and q1: from b to
 * a and to c, e: along the edge [rad]. */
static inline double sw_crease_angle(sw_vec q0, sw_vec q1, sw_vec e) {
  const sw_vec u = sw_unit_or(e, sw_v(0, 0, 0));
  const sw_vec p0 = sw_neg(sw_madd(q0, u, -sw_dot(q0, u))), p1 = sw_madd(q1, u, -sw_dot(q1, u));
  return atan2(sw_dot(u, sw_cross(p0, p1)), sw_dot(p0, p1));
}

#endif
