/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arguments of a run, and checks whether a scene can be run with them. Shared by the files of this
 * room only. */
#ifndef SW_STEP_RUN_CHECK_H
#define SW_STEP_RUN_CHECK_H

#include "step/step.h"

/* Shorter times count as zero, because their steps would underflow [s]. */
static const double SW_SHORTEST_STEP = 1e-20;

/* SW_EINVAL: the scene has a part that the run's method or kind cannot treat. */
sw_status sw_run_check(const sw_scene *scene, const sw_run_args *args, sw_error *err);
/* SW_EINVAL if dt is so small that the clock would not advance, or not reach `until` [s]. */
sw_status sw_run_check_clock(const sw_scene *scene, const sw_run_args *args, double until,
                             sw_error *err);
/* SW_EINVAL if an explicit method would take steps above its stable step before `until`. */
sw_status sw_scene_check_step(const sw_scene *scene, const sw_run_args *args, double until,
                              sw_error *err);

#endif
