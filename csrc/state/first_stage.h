/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The first of a step's two stages. Some methods overestimate forces that only hold against turning
 * in one stage and underestimate them in the other (integrate/turning.h). */
#ifndef SW_STATE_FIRST_STAGE_H
#define SW_STATE_FIRST_STAGE_H

#include "base/vec.h"

typedef struct sw_first_stage {
  const double *x; /* nodes at that stage; NULL: the last stage's forces are right [m] */
  double share;    /* weight of the last stage's force; the first stage's has the rest [-] */
  double time;     /* of the first stage, over the step [-] */
} sw_first_stage;

/* Returns a force at the end of a step, from its values at both stages and before the step (NULL:
 * not known). If it changes linearly, was zero or comes from a blow, this is the last stage's
 * value, else the mix of both stages [N]. */
sw_vec sw_even_force(const sw_first_stage *at, const sw_vec *before, sw_vec first, sw_vec now);

/* Returns the force that a drive compares with its target, from its value before the step, the one
 * that is read out at the end and the last stage's. It is the read-out, or the last stage's value
 * in a blow, after which the mix of both stages would let the drive's speed swing. It has no jumps:
 * across a jump there would be no speed at which the force is as wanted [N]. */
double sw_obeyed_force(double before, double read, double now);

#endif
