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

#endif
