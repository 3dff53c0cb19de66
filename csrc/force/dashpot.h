/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Viscous hinges, shared by viscous_bend and damping: the moment eta d(kappa)/dt. */
#ifndef SW_FORCE_DASHPOT_H
#define SW_FORCE_DASHPOT_H

#include "force/force.h"

/* The rate of a hinge of length w is rho / w with rho the rotation of its second edge less that
 * of its first, both without spin about themselves: rho = t2 x t2' - t1 x t1'. In a plane that is
 * the rate of the angle whatever the wire's rotation; where a bent wire is spun about its own
 * axis, it counts as bending. eta [N m2 s] */
void sw_dashpot_hinges(double eta, sw_field *field);

/* The same between a held director and an edge. */
void sw_dashpot_clamp(double eta, sw_field *field, const sw_clamp_hinge *hinge);

/* Moment of that hinge on its edge [N m]. */
sw_vec sw_dashpot_clamp_moment(double eta, const sw_field *field, const sw_clamp_hinge *hinge);

#endif
