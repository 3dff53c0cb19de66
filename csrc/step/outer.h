/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces from outside that change with time within a step, and their work in poses. Private to this
 * room. */
#ifndef SW_STEP_OUTER_H
#define SW_STEP_OUTER_H

#include "scene/ledger.h"
#include "scene/scene.h"
#include "step/ladder.h"

/* What a trial misses of forces that functions of scripts give. */
typedef struct sw_outer_look {
  double missed[SW_OUTER_SUMS], all[SW_OUTER_SUMS]; /* see sw_outer_sum [N s] */
  double speed; /* largest missed change of the velocity of a wire as a whole [m/s] */
} sw_outer_look;

/* Looks at the last trial, of size h. After an error it is undone. SW_ECALLBACK, SW_ENOMEM. */
sw_status sw_outer_look_at(sw_ladder *ladder, double h, sw_outer_look *out, sw_error *err);
/* Call when that trial is taken: books it, and logs an event if a force's known period is too short
 * for the step. */
void sw_outer_taken(sw_scene *scene, double h, const sw_outer_look *look);
/* Returns the longest step that follows forces of a known period [s]. */
double sw_outer_longest(const sw_scene *scene);
/* Call at the end of a run: logs an event if steps missed too much. */
void sw_outer_end_run(sw_scene *scene);

/* Places of the nodes and forces from outside at the start of a pose; NULL: there are none. */
typedef struct sw_outer_start {
  double *x, *force; /* (3 x nodes) [m], [N] */
} sw_outer_start;

sw_status sw_outer_begin_pose(sw_scene *scene, sw_outer_start *start, sw_error *err);
/* Fills the work of these forces from the start to the present pose [J]. */
sw_status sw_outer_work(sw_scene *scene, const sw_outer_start *start, double *work, sw_error *err);
void sw_outer_drop(sw_outer_start *start);

#endif
