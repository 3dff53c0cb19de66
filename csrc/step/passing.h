/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps that would take a wire past a force of short reach are taken in parts. Shared by the files
 * of this room only. */
#ifndef SW_STEP_PASSING_H
#define SW_STEP_PASSING_H

#include "scene/scene.h"

/* Is there a force that wires may pass in the coming step? */
int sw_passing_any(const sw_scene *scene);
/* The way of a step as a share of the way that forces allow, judged by their state at its start: up
 * to 1 is allowed [-]. The second function is for a step from the scene's present state. */
double sw_passing_between(const sw_scene *scene, const double *from, const double *to);
double sw_passing_of(const sw_scene *scene, const double *x);
int sw_passing_too_far(const sw_scene *scene, const double *x);
/* The part that is to be taken instead of one of size h that goes so far [s]. */
double sw_passing_part(double h, double over);

#endif
