/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria of the scene, and poses of slow handling. Shared by the files of this room only. */
#ifndef SW_STEP_REST_H
#define SW_STEP_REST_H

#include "step/step.h"

/* Equilibrium of the built scene at its time, obstacles having moved since a time before;
 * nothing is observed. On failure the state is as before. too_far (may be NULL) is set when
 * it failed because obstacles drag wires along that a shorter way might show how. */
sw_status sw_scene_rest(sw_scene *scene, double since, int *too_far, const sw_settle_args *args,
                        int (*interrupted)(void), sw_settle_report *report, sw_error *why);
/* The same with the jaws that have begun a step as open as their forces want. On failure contact's
 * memory is as before too. */
sw_status sw_scene_squeezed_rest(sw_scene *scene, double since, int *too_far,
                                 const sw_settle_args *args, int (*interrupted)(void),
                                 sw_settle_report *report, sw_error *why);
/* Make a pose at t1 an earlier one (cut: 1) where wires between pads could not follow these. */
sw_status sw_scene_cut_pose(sw_scene *scene, double *t1, int *cut, sw_error *err);
typedef struct sw_pose_args {
  int (*interrupted)(void);
  double shortest; /* poses are not made shorter to find where a tie breaks [s] */
  double passing;  /* and not shorter than this to follow a wire past a clip's lips [s] */
} sw_pose_args;
/* Equilibrium at time t1, which becomes the scene's, in smaller parts where needed; or earlier, to
 * be observed there, where a tie may break. Nothing is observed. On failure the scene is at the
 * last pose that went well. */
sw_status sw_scene_pose(sw_scene *scene, double t1, const sw_pose_args *how, sw_run_report *report,
                        sw_error *err);

#endif
