/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tension that wires lose because they are sunk into each other where they touch. */
#ifndef SW_MUTUAL_RELIEF_H
#define SW_MUTUAL_RELIEF_H

#include "mutual/mutual.h"

typedef struct sw_relief {
  double tension;  /* mean of the stretch between its holds [N] */
  double taken;    /* what the depth takes from it [N] */
  double depth;    /* of the touch that takes most [m] */
  size_t node;     /* where this is, in the system's arrays */
  size_t from, to; /* the stretch, in the system's arrays */
  size_t with;     /* the other body there */
} sw_relief;

/* Estimates, from the touches of the accepted state, what the stretch of a line between holds that
 * loses most would have without their depth. 0: it loses nothing. The touches of a step must have
 * begun. */
int sw_mutual_relief(const sw_mutual *mutual, const sw_system *system, size_t body, sw_relief *out);

/* Forces on the body's nodes by which the touches of this stretch would part it from its depth
 * (nodes x 3) [N]. */
void sw_mutual_part(const sw_mutual *mutual, const sw_system *system, size_t body,
                    const sw_relief *relief, double *out);
/* 1 if the depth takes more than this share of the tension of a wire that is drawn taut [-]. */
int sw_mutual_is_sunk(const sw_mutual *mutual, const sw_system *system, double share);

#endif
