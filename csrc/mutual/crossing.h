/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether two rods cross while they move. */
#ifndef SW_MUTUAL_CROSSING_H
#define SW_MUTUAL_CROSSING_H

#include "mutual/pairs_sweep.h"

/* Rods whose axes stay farther apart than this share of the sum of radii do not cross [-]. */
#define SW_CROSSING_NEAR 0.25

/* Side of one rod's line on which the other one is: 1 or -1; 0: they are in a plane. */
int sw_rods_side(const sw_rods *rods, double reach);
/* What is known of two rods in a plane from the path before: the side on which one was of the other
 * before it came there, or 0; and the last way between them in the plane [m]. */
typedef struct sw_rods_past {
  int side;
  sw_vec way;
} sw_rods_past;

/* 1 if the axes of two rods cross on the straight path from one position to another; fills the
 * place. *past follows the path; zeros: nothing is known. reach: sum of the radii [m]. */
int sw_rods_cross(const sw_rods *from, const sw_rods *to, double reach, sw_rods_past *past,
                  double at[2]);

#endif
