/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The first of a step's two stages, of methods that find forces which only hold against turning too
 * large in one and too small in the other (integrate/turning.h). */
#ifndef SW_STATE_FIRST_STAGE_H
#define SW_STATE_FIRST_STAGE_H

#include "base/vec.h"

typedef struct sw_first_stage {
  const double *x; /* where nodes were, NULL: forces are as the last stage has them [m] */
  double share; /* what holds is so much of the last stage's force, the rest of the first's [-] */
  double time;  /* of the first stage, of the step [-] */
} sw_first_stage;

/* A force of the state that a step leads to, of both stages' and that before the step, NULL: which
 * is not known. What grows or falls evenly, or was zero, is as it is found [N]. */
sw_vec sw_even_force(const sw_first_stage *at, const sw_vec *before, sw_vec first, sw_vec now);

#endif
