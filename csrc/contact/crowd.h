/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles of an object that push each other apart where they come nearer than a distance d,
 * unless a link, fold or element joins them: E = 1/2 k (d - r)^2 for r < d. Which pairs may do so
 * in a step is found at its start, and the matrix is made for these. It keeps folds of fabric
 * apart, as long as d is not below half of what is between neighbours; it is no surface: a
 * particle that is pushed harder than k d passes through, and one that comes nearer by more than
 * four distances in a step does so unnoticed. */
#ifndef SW_CONTACT_CROWD_H
#define SW_CONTACT_CROWD_H

#include "system/system.h"

typedef struct sw_crowd sw_crowd;

/* For the system's bodies that have such a force; *out = NULL: there is none. SW_ENOMEM. */
sw_status sw_crowd_new(const sw_system *system, sw_crowd **out);
void sw_crowd_free(sw_crowd *crowd); /* NULL is allowed */

/* A step of size h begins at the system's state; h = 0 in statics. SW_ENOMEM. */
sw_status sw_crowd_begin_step(sw_crowd *crowd, sw_system *system, double h);

/* Add forces and stiffness at positions y to the bodies' fields. */
void sw_crowd_eval(const sw_crowd *crowd, sw_system *system, const double *y, unsigned want);

/* 1: after an update that reached y by delta the same pairs push as before it, but for small
 * pushes. */
int sw_crowd_settled(const sw_crowd *crowd, const sw_system *system, const double *y,
                     const double *delta);

double sw_crowd_energy(const sw_crowd *crowd, const sw_system *system); /* of the state [J] */

#endif
