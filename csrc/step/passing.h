/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divides steps that would take a wire past a force of short reach into parts (substeps). Private
 * to this room. */
#ifndef SW_STEP_PASSING_H
#define SW_STEP_PASSING_H

#include "scene/scene.h"

/* 1 if there is a force that a wire may move past in the coming step. */
int sw_passing_any(const sw_scene *scene);
/* Returns the largest path of a wire in a step over the path that forces allow, from their state at
 * its start; up to 1 is fine [-]. The second function is for a step from the scene's present
 * state. */
double sw_passing_between(const sw_scene *scene, const double *from, const double *to);
double sw_passing_of(const sw_scene *scene, const double *x);
int sw_passing_too_far(const sw_scene *scene, const double *x);
/* Returns the part to take instead of one of size h [s]. over: its path over the allowed one
 * [-]. */
double sw_passing_part(double h, double over);

#endif
