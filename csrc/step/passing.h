/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps that would take a wire past a force of short reach are taken in parts. Shared by the files
 * of this room only. */
#ifndef SW_STEP_PASSING_H
#define SW_STEP_PASSING_H

#include "scene/scene.h"

/* How far a step to places x goes over what forces on the way allow: 1 and less is well [-]. */
double sw_passing_of(const sw_scene *scene, const double *x);
/* The part that is to be taken instead of one of size h that goes so far [s]. */
double sw_passing_part(double h, double over);

#endif
