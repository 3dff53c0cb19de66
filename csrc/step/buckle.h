/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divides steps in which a wire buckles into parts (substeps). Private to this room. */
#ifndef SW_STEP_BUCKLE_H
#define SW_STEP_BUCKLE_H

#include "scene/scene.h"

/* Returns the growth of a small bend of pushed wires in the last trial, over the growth that a part
 * may have [-]. Up to 1 is fine. h: size of the trial [s]. */
double sw_buckle_of(const sw_scene *scene, double h);
/* Returns the part to take instead of one of size h [s]. over: its growth over the allowed one
 * [-]. */
double sw_buckle_part(double h, double over);
/* Call for a part h that was taken. Logs the event "coarse" if a bend grows much faster than the
 * part follows: parts are not shorter, or steps are not divided. */
void sw_buckle_taken(sw_scene *scene, double h);

#endif
