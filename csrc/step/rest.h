/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria of the scene, and poses of slow handling. Private to this room. */
#ifndef SW_STEP_REST_H
#define SW_STEP_REST_H

#include "step/step.h"

/* Finds the equilibrium of the built scene at its time; obstacles have moved since the time
 * `since`. Nothing is recorded. If it fails, the state is as before. too_far (may be NULL): 1 if
 * the solve failed because obstacles drag wires too far, and a shorter path may succeed. */
sw_status sw_scene_rest(sw_scene *scene, double since, int *too_far, const sw_settle_args *args,
                        int (*interrupted)(void), sw_settle_report *report, sw_error *why);
/* As sw_scene_rest; also finds the openings at which jaws that have begun a step have the wanted
 * forces. If it fails, contact's memory is as before too. */
sw_status sw_scene_squeezed_rest(sw_scene *scene, double since, int *too_far,
                                 const sw_settle_args *args, int (*interrupted)(void),
                                 sw_settle_report *report, sw_error *why);
/* Finds the equilibrium at the scene's time; jaws that hold with a force keep this force. */
sw_status sw_scene_held_rest(sw_scene *scene, const sw_settle_args *args, int (*interrupted)(void),
                             sw_settle_report *report, sw_error *err);
/* As sw_scene_held_rest; feeds that obey a force pay out or draw in wire until they have it, and
 * nodes may come and go. *lost: 1 if there is no such equilibrium; the state of the scene is then
 * undefined. */
sw_status sw_scene_yielded_rest(sw_scene *scene, const sw_settle_args *args,
                                int (*interrupted)(void), int *lost, sw_settle_report *report,
                                sw_error *err);
/* As sw_scene_yielded_rest, with all feeds locked like clamps. */
sw_status sw_scene_clamped_rest(sw_scene *scene, const sw_settle_args *args,
                                int (*interrupted)(void), sw_settle_report *report, sw_error *err);
/* Updates forces that lag one step to the state at rest (guesses = 1: only their first guesses).
 * Returns 1 if they changed and the wires must come to rest once more. */
int sw_rest_catch_up(sw_scene *scene, int guesses);
/* Logs an event for each feed whose force at rest is not the one it obeys. */
void sw_yield_tell(sw_scene *scene);
/* Makes t1 earlier (cut: 1) if wires between pads could not follow the pads to it. */
sw_status sw_scene_cut_pose(sw_scene *scene, double *t1, int *cut, sw_error *err);
/* Shortens a pose step h so that no hold goes further than wires with friction are followed at
 * once: what they rub off is booked pose by pose, and obstacles that move go with them [s]. */
sw_status sw_scene_cut_rubbing(sw_scene *scene, double *h, sw_error *err);
typedef struct sw_pose_args {
  int (*interrupted)(void);
  double shortest; /* shortest pose for locating the break of a tie [s] */
  double passing;  /* shortest pose for following a wire past a clip's lips [s] */
  int between;     /* 1: see sw_settle_args.passing */
  int *lost;       /* becomes 1 if a frozen grip would bear too much: the pose ends before */
  int unsettled;   /* 1: wires move if no equilibrium is found: the state is then as before */
  int *falls;      /* becomes 1 if no equilibrium was found because a wire falls without limit */
} sw_pose_args;
/* Finds the equilibrium at time t1, which becomes the scene's time, in smaller parts where needed.
 * If a tie may break, the pose may end earlier, so that the break is recorded there. Nothing is
 * recorded here. If it fails, the scene is at the last pose that converged. */
sw_status sw_scene_pose(sw_scene *scene, double t1, const sw_pose_args *how, sw_run_report *report,
                        sw_error *err);

#endif
