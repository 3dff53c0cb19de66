/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks whether a trial of a step is believable. Private to this room. */
#ifndef SW_STEP_BELIEVE_H
#define SW_STEP_BELIEVE_H

#include "scene/scene.h"

/* SW_EDIVERGED when the stepper's trial is not a believable state; SW_ENOCONV when a smaller step
 * may help. */
sw_status sw_scene_check_trial(const sw_scene *scene, sw_error *err);
/* Logs an event, once per run, if the run's method is not meant for contact and something
 * touches. */
void sw_scene_remark_contact(sw_scene *scene);

#endif
