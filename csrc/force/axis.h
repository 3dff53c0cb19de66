/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The centre line of a wire of any model, for forces that act on it. Its places are the nodes, or
 * the centres of a mesh's rings. Loose particles have no places. */
#ifndef SW_FORCE_AXIS_H
#define SW_FORCE_AXIS_H

#include <stddef.h>

#include "base/vec.h"
#include "state/field.h"

size_t sw_axis_points(const sw_plan *plan);
double sw_axis_s(const sw_plan *plan, size_t i); /* arc length of place i [m] */
/* Returns the middle of ring i of these values, three for each particle of a mesh. */
sw_vec sw_axis_middle(const sw_field *field, const double *values, size_t i);

/* Returns place i [m]. */
static inline sw_vec sw_axis_at(const sw_field *f, size_t i) {
  return f->plan->web ? sw_axis_middle(f, f->x, i) : sw_load(f->x + 3 * i);
}

/* Returns its velocity [m/s]. */
static inline sw_vec sw_axis_velocity(const sw_field *f, size_t i) {
  return f->plan->web ? sw_axis_middle(f, f->v, i) : sw_load(f->v + 3 * i);
}

/* Returns the lumped mass of place i: that of its node or ring; infinite for a held node [kg]. */
double sw_axis_mass(const sw_plan *plan, size_t i);

/* Returns leapfrog's largest stable step 2 / omega [s] for a spring of this stiffness [N/m]. The
 * spring moves at least the mass of half the shortest edge. */
double sw_axis_stable_dt(const sw_plan *plan, double stiffness);

/* Adds a force and its stiffness K (3 x 3, or NULL) to place i. Each particle of a ring gets its
 * share of the force, and the stiffness acts on the ring's middle. Pairs of particles without a
 * block in the matrix get the stiffness on each of both instead, which is exact for moves of the
 * whole ring, and too stiff for its turns. */
void sw_axis_put(sw_field *field, size_t i, sw_vec force, const double *K);
/* The same for a point between places i and i + 1, of which each has its part [-]. */
void sw_axis_put_between(sw_field *field, size_t i, const double part[2], sw_vec force,
                         const double *K);
/* Does the same with stiffness k along a unit vector. */
void sw_axis_push(sw_field *field, size_t i, sw_vec force, sw_vec along, double k);

#endif
