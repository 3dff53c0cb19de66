/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run takes, and whether a scene can be run with it. Shared by the files of this room only.
 */
#ifndef SW_STEP_RUN_CHECK_H
#define SW_STEP_RUN_CHECK_H

#include "step/step.h"

/* A shorter time counts as zero: its steps would underflow [s]. */
static const double SW_SHORTEST_STEP = 1e-20;

/* SW_EINVAL: the scene has what the run's method or way cannot do. */
sw_status sw_run_check(const sw_scene *scene, const sw_run_args *args, sw_error *err);
/* SW_EINVAL when steps do not add up to the time that they are to cover [s]. */
sw_status sw_run_check_clock(const sw_scene *scene, const sw_run_args *args, double until,
                             sw_error *err);
/* SW_EINVAL when an explicit method would take steps above its limit on the way to a time. */
sw_status sw_scene_check_step(const sw_scene *scene, const sw_run_args *args, double until,
                              sw_error *err);

#endif
