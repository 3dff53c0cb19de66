/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria of the scene, and poses of slow handling. Shared by the files of this room only. */
#ifndef SW_STEP_REST_H
#define SW_STEP_REST_H

#include "step/step.h"

/* Finds the equilibrium of the built scene at its time; obstacles have moved since the time
 * `since`. Nothing is observed. On failure the state is as before. too_far (may be NULL) is set to
 * 1 when the solve failed because obstacles drag wires too far, and a shorter way may succeed. */
sw_status sw_scene_rest(sw_scene *scene, double since, int *too_far, const sw_settle_args *args,
                        int (*interrupted)(void), sw_settle_report *report, sw_error *why);
/* The same, and finds the openings of the jaws that have begun a step, at which their forces are
 * those wanted. On failure contact's memory is as before too. */
sw_status sw_scene_squeezed_rest(sw_scene *scene, double since, int *too_far,
                                 const sw_settle_args *args, int (*interrupted)(void),
                                 sw_settle_report *report, sw_error *why);
/* Finds the equilibrium at the scene's time; jaws that hold with a force go on holding with it. */
sw_status sw_scene_held_rest(sw_scene *scene, const sw_settle_args *args, int (*interrupted)(void),
                             sw_settle_report *report, sw_error *err);
/* The same, and feeds that obey a force pay out or draw in wire until they have that force; nodes
 * may come and go. *lost: 1 if this leads nowhere; the scene is then anywhere. */
sw_status sw_scene_yielded_rest(sw_scene *scene, const sw_settle_args *args,
                                int (*interrupted)(void), int *lost, sw_settle_report *report,
                                sw_error *err);
/* The same with feeds that are held, like clamps. */
sw_status sw_scene_clamped_rest(sw_scene *scene, const sw_settle_args *args,
                                int (*interrupted)(void), sw_settle_report *report, sw_error *err);
/* Brings forces that lag a step behind (guesses = 1: first guesses of them only) up to the state at
 * rest. 1: they changed, and the wires must come to rest once more. */
int sw_rest_catch_up(sw_scene *scene, int guesses);
/* Tells of all feeds whose observed force at rest is not the asked one. */
void sw_yield_tell(sw_scene *scene);
/* Makes t1 earlier (cut: 1) where wires between pads could not follow the pads to it. */
sw_status sw_scene_cut_pose(sw_scene *scene, double *t1, int *cut, sw_error *err);
typedef struct sw_pose_args {
  int (*interrupted)(void);
  double shortest; /* shortest pose for locating the break of a tie [s] */
  double passing;  /* shortest pose for following a wire past a clip's lips [s] */
} sw_pose_args;
/* Finds the equilibrium at time t1, which becomes the scene's time, in smaller parts where needed.
 * Where a tie may break, the pose may end earlier, to be observed there. Nothing is observed here.
 * On failure the scene is at the last pose that converged. */
sw_status sw_scene_pose(sw_scene *scene, double t1, const sw_pose_args *how, sw_run_report *report,
                        sw_error *err);

#endif
