/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Viscous hinges, shared by viscous_bend and damping: the moment eta d(kappa)/dt. */
#ifndef SW_FORCE_DASHPOT_H
#define SW_FORCE_DASHPOT_H

#include "force/force.h"

/* Adds the viscous moments of all hinges. The curvature rate of a hinge of length w is rho / w. rho
 * is the rotation of its second edge minus that of its first, both without spin about their own
 * axes: rho = t2 x t2' - t1 x t1'. For bending in a plane this is the rate of the angle, whatever
 * the rotation of the whole wire. Spinning a bent wire about its own axis counts as bending.
 * eta [N m2 s] */
void sw_dashpot_hinges(double eta, sw_field *field);

/* Adds the same between a held director and an edge. */
void sw_dashpot_clamp(double eta, sw_field *field, const sw_clamp_hinge *hinge);

/* Returns the moment of that hinge on its edge [N m]. */
sw_vec sw_dashpot_clamp_moment(double eta, const sw_field *field, const sw_clamp_hinge *hinge);

#endif
