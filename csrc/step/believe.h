/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is a trial of a step believable? Shared by the files of this room only. */
#ifndef SW_STEP_BELIEVE_H
#define SW_STEP_BELIEVE_H

#include "scene/scene.h"

/* SW_EDIVERGED when the stepper's trial is no believable state, SW_ENOCONV when a smaller step may
 * mend it. */
sw_status sw_scene_check_trial(const sw_scene *scene, sw_error *err);
/* Tells that the run's method is not meant for contact, once, when there is some. */
void sw_scene_remark_contact(sw_scene *scene);

#endif
