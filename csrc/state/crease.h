/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The angle of a crease: how far the strip from b to c is turned from that from a to b, about the
 * edge they share. */
#ifndef SW_STATE_CREASE_H
#define SW_STATE_CREASE_H

#include <math.h>

#include "base/vec.h"

/* Strips narrower than the square root of this share of the edge are taken as that wide [-]. */
static const double SW_CREASE_LEAST = 1e-12;

/* q0 and q1 from b to a and to c, e along the edge: in (-pi, pi], above 0 when e has it turn
 * anticlockwise [rad]. */
static inline double sw_crease_angle(sw_vec q0, sw_vec q1, sw_vec e) {
  const sw_vec u = sw_unit_or(e, sw_v(0, 0, 0));
  const sw_vec p0 = sw_neg(sw_madd(q0, u, -sw_dot(q0, u))), p1 = sw_madd(q1, u, -sw_dot(q1, u));
  return atan2(sw_dot(u, sw_cross(p0, p1)), sw_dot(p0, p1));
}

#endif
