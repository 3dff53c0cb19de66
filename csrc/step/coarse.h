/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of fixed size that are too coarse for how a wire moves in them are taken in parts. Shared
 * by the files of this room only. */
#ifndef SW_STEP_COARSE_H
#define SW_STEP_COARSE_H

#include "scene/scene.h"

/* Are steps of the scene judged, as it is now? */
int sw_coarse_applies(const sw_scene *scene);
/* Do so many wires touch each other that their steps are taken whole? */
int sw_coarse_is_bundle(const sw_scene *scene);
/* Error of the last trial, by the method's estimate, as a share of what a wire is allowed: up to 1
 * is fine; 0: the method has no estimate. No more than the tolerance is allowed [-], [m]. */
double sw_coarse_of(const sw_scene *scene, double tolerance);
/* A trial of size h is taken. If it is coarse, and of a bundle, of many wires or by a method without
 * an estimate, which are not taken in parts, the run says so. */
void sw_coarse_tell(sw_scene *scene, double h);
/* The part that is to be taken instead of one of size h with such an error, in a run of steps
 * dt [s]. */
double sw_coarse_part(const sw_scene *scene, double h, double dt, double over);
/* No part is taken shorter than this for what is coarse [s]. */
double sw_coarse_shortest(double dt);
/* The same of a part in which a tie goes taut: halves are coarse only where it does [s]. */
double sw_coarse_half(double h, double dt);
/* Was it right to take a shorter part, with an error over, instead of one with an error before? */
int sw_coarse_helps(double before, double over);
/* 1: a part of twice the size would be fine too. */
int sw_coarse_may_grow(const sw_scene *scene, double over);

#endif
