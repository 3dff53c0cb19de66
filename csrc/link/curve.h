/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A curve in space, given by arc length: a straight line or the cubic spline through points. A
 * spline is closed or runs from the first point to the last. Immutable, with a reference count. */
#ifndef SW_LINK_CURVE_H
#define SW_LINK_CURVE_H

#include "base/status.h"
#include "base/tape.h"
#include "base/vec.h"
#include "system/rail.h"

typedef struct sw_curve sw_curve;

/* Makes the spline through points (count x 3) [m]: at least 3, none equal to the one before.
 * SW_EINVAL, SW_ENOMEM. */
sw_status sw_curve_spline(const double *points, size_t count, int closed, sw_curve **out);
/* Makes an endless line through the origin. SW_ENOMEM. */
sw_status sw_curve_line(sw_vec direction, sw_curve **out);
void sw_curve_release(sw_curve *curve); /* NULL is allowed */

/* Fills in the curve at arc length p. On a closed curve p is taken modulo the length; beyond the
 * ends of an open one the curve goes on straight. curve: a sw_curve. */
void sw_curve_at(const void *curve, double p, sw_rail_point *out);
/* Returns the arc length of the curve's point nearest to a given point [m]. */
double sw_curve_nearest(const sw_curve *curve, sw_vec point);
/* Returns the curve's length; infinite for a line or a closed curve [m]. */
double sw_curve_end(const sw_curve *curve);
/* Writes or reads a curve or NULL. Reading rebuilds the curve from its points, which gives the same
 * bits. */
void sw_tape_curve(sw_tape *tape, sw_curve **curve);

/* State of a hold that lets the wire slide along a curve. */
typedef struct sw_slider {
  sw_curve *curve; /* in the hold's frame; NULL: the hold has none */
  double from, to; /* ends that stop the wire; infinite: none [m] */
  double friction; /* [-] */
  double p, v, a;  /* place along the curve and its rates, accepted state [m], [m/s], [m/s2] */
  double force;    /* on the wire along the curve, from friction and ends [N] */
  double rubs;     /* the part of friction alone [N] */
} sw_slider;

#endif
