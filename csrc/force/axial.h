/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The axial spring of one edge, shared by stretch and repel. */
#ifndef SW_FORCE_AXIAL_H
#define SW_FORCE_AXIAL_H

#include "force/force.h"

/* Which strains the spring answers to. */
enum { SW_AXIAL_TENSION = 1, SW_AXIAL_COMPRESSION = 2 };

/* Adds the energy 1/2 (EA/l0)(l - l0)^2 for the strains in signs. The geometric part of the
 * stiffness uses the field's stored axial force ("mixed" Newton); in dynamics only tension counts
 * there. */
sw_status sw_axial_eval(double EA, int signs, sw_field *field);

/* Returns 2 / omega_max of the chain of axial springs with lumped masses [s]. */
double sw_axial_stable_dt(double EA, const sw_plan *plan);

#endif
