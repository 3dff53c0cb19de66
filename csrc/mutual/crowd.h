/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles of an object that push each other apart if they are nearer than a distance d, unless a
 * link, fold or element joins them: E = 1/2 k (d - r)^2 for r < d. The pairs that may push in a
 * step are found at its start, and the matrix is planned for these. The force keeps folds of fabric
 * apart if d is at least half the distance between neighbours. It is not a surface: a particle
 * pushed harder than k d passes through, and a particle that approaches by more than four distances
 * in one step is missed. */
#ifndef SW_MUTUAL_CROWD_H
#define SW_MUTUAL_CROWD_H

#include "system/system.h"

typedef struct sw_crowd sw_crowd;

/* Makes the crowd for the system's bodies that have such a force; *out = NULL if there is none.
 * SW_ENOMEM. */
sw_status sw_crowd_new(const sw_system *system, sw_crowd **out);
void sw_crowd_free(sw_crowd *crowd); /* NULL is allowed */

/* Begins a step of size h at the system's state; h = 0 in statics. SW_ENOMEM. */
sw_status sw_crowd_begin_step(sw_crowd *crowd, sw_system *system, double h);

/* Adds forces and stiffness at positions y to the bodies' fields. */
void sw_crowd_eval(const sw_crowd *crowd, sw_system *system, const double *y, unsigned want);

/* 1 if the same pairs push before and after the update delta, which reached y. Small pushes are
 * ignored. */
int sw_crowd_settled(const sw_crowd *crowd, const sw_system *system, const double *y,
                     const double *delta);

double sw_crowd_energy(const sw_crowd *crowd, const sw_system *system); /* of the state [J] */

#endif
