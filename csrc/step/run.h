/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a run. Private to this room. */
#ifndef SW_STEP_RUN_H
#define SW_STEP_RUN_H

#include "step/step.h"

/* Calls the observer if it is due; slack: times that differ by less are equal [s]. */
sw_status sw_scene_look(sw_scene *scene, sw_observer *observer, double slack, sw_error *err);
/* Call with an accepted state: objects follow it, and it is recorded. */
sw_status sw_step_observe(sw_scene *scene, sw_error *err);

#endif
