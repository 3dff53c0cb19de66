/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A curve in space by its arc length: a straight line, or the cubic spline through points, closed
 * or from the first to the last. Immutable and counted. */
#ifndef SW_LINK_CURVE_H
#define SW_LINK_CURVE_H

#include "base/status.h"
#include "base/tape.h"
#include "base/vec.h"
#include "system/rail.h"

typedef struct sw_curve sw_curve;

/* Through points (count x 3) [m], 3 at least, none on the one before. SW_EINVAL, SW_ENOMEM. */
sw_status sw_curve_spline(const double *points, size_t count, int closed, sw_curve **out);
/* A line through the origin, without ends. SW_ENOMEM. */
sw_status sw_curve_line(sw_vec direction, sw_curve **out);
void sw_curve_release(sw_curve *curve); /* NULL is allowed */

/* Of a closed one p is taken modulo its length; beyond the ends of an open one it goes on straight.
 * curve: a sw_curve. */
void sw_curve_at(const void *curve, double p, sw_rail_point *out);
/* Place nearest to a point [m]. */
double sw_curve_nearest(const sw_curve *curve, sw_vec point);
/* Its length; infinite: a line, or closed [m]. */
double sw_curve_end(const sw_curve *curve);
/* A curve or NULL; reading makes it anew from its points, which gives the same bits. */
void sw_tape_curve(sw_tape *tape, sw_curve **curve);

/* What a hold that lets the wire slide along a curve remembers. */
typedef struct sw_slider {
  sw_curve *curve; /* in the hold's frame, or NULL: it does not */
  double from, to; /* ends that stop it; infinite: none [m] */
  double friction; /* [-] */
  double p, v, a;  /* place along the curve of the accepted state, and its rates [m], [m/s] */
  double force;    /* of friction and ends on the wire, along the curve [N] */
  double rubs;     /* friction alone [N] */
} sw_slider;

#endif
