/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How two segments come near each other during a step. */
#ifndef SW_MUTUAL_PAIRS_SWEEP_H
#define SW_MUTUAL_PAIRS_SWEEP_H

#include "mutual/pair.h"

/* Ends of two straight rods. */
typedef struct sw_rods {
  sw_vec a[2], b[2];
} sw_rods;
/* 1 if two rods pass each other on the straight path from one position to another. Advances in safe
 * steps, so that no pass is missed; rods that start too near are skipped. Fills the place, the
 * direction from b to a just before, and the time [-]. reach: sum of the radii [m]. */
int sw_rods_sweep(const sw_rods *from, const sw_rods *to, double reach, double at[2],
                  sw_vec *normal, double *when);

/* Distance of the axes with nodes at x; HUGE_VAL: the curves cross elsewhere [m]. */
double sw_pair_distance(const sw_system *s, const sw_pair *k, const double *x);
/* Largest change of the axes' distance from positions x0 to x1 [m]. */
double sw_pair_approach(const sw_system *s, const sw_pair *k, const double *x0, const double *x1);
/* 1 if axes that were further apart come too near on the straight path from x0 to x1. Fills the
 * place and the direction from segment two to one just before. */
int sw_pair_sweep(const sw_system *s, const sw_pair *k, const double *x0, const double *x1,
                  double at[2], sw_vec *normal);

/* 1 if two segments that are apart at x1 overlap on the straight path from x0. */
int sw_pair_brushes(const sw_pair *k, const double *x0, const double *x1);

#endif
