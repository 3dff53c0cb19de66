/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How two segments come near each other on the way of a step. */
#ifndef SW_CONTACT_PAIRS_SWEEP_H
#define SW_CONTACT_PAIRS_SWEEP_H

#include "contact/pair.h"

/* Ends of two straight parts. */
typedef struct sw_rods {
  sw_vec a[2], b[2];
} sw_rods;
/* Do they pass each other on the straight way from one place to another? Advances by safe steps, so
 * that nothing is missed; pairs that start too near are skipped. 1 with the place, the direction
 * from b to a just before, and the time [-]. reach: sum of the radii [m]. */
int sw_rods_sweep(const sw_rods *from, const sw_rods *to, double reach, double at[2],
                  sw_vec *normal, double *when);

/* Distance of the axes with the nodes at x; HUGE_VAL: their curves cross elsewhere [m]. */
double sw_pair_distance(const sw_system *s, const sw_pair *k, const double *x);
/* Its largest change from positions x0 to x1 [m]. */
double sw_pair_approach(const sw_system *s, const sw_pair *k, const double *x0, const double *x1);
/* Do axes that were further apart come too near on the straight way from x0 to x1? 1 with the place
 * and the direction from segment two to one just before. */
int sw_pair_sweep(const sw_system *s, const sw_pair *k, const double *x0, const double *x1,
                  double at[2], sw_vec *normal);

#endif
