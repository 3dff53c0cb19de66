/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The centre line of a wire of any model, for forces that act on it: its places are nodes, or the
 * middles of a mesh's rings. Loose particles have none. */
#ifndef SW_FORCE_AXIS_H
#define SW_FORCE_AXIS_H

#include <stddef.h>

#include "base/vec.h"
#include "state/field.h"

size_t sw_axis_points(const sw_plan *plan);
double sw_axis_s(const sw_plan *plan, size_t i);          /* arc length of place i [m] */
sw_vec sw_axis_at(const sw_field *field, size_t i);       /* [m] */
sw_vec sw_axis_velocity(const sw_field *field, size_t i); /* [m/s] */

/* Largest stable step of leapfrog, 2 / omega, of a spring that ends at half an edge of the wire at
 * least [N/m], [s]. */
double sw_axis_stable_dt(const sw_plan *plan, double stiffness);

/* Add a force on place i, and its stiffness (whole, or NULL); of a ring each particle has its
 * share, and only the stiffness against moves of the whole ring counts. */
void sw_axis_put(sw_field *field, size_t i, sw_vec force, const double *K);
/* The same with stiffness k along a unit vector. */
void sw_axis_push(sw_field *field, size_t i, sw_vec force, sw_vec along, double k);

#endif
