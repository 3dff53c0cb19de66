/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divides steps of fixed size into parts (substeps) where they are too coarse for the motion of a
 * wire. Private to this room. */
#ifndef SW_STEP_COARSE_H
#define SW_STEP_COARSE_H

#include "scene/scene.h"

/* Steps are not divided while more wires than this move: some wire would always be too fast, and
 * all would take its parts [-]. */
#define SW_MOST_MOVING 32
/* Largest bundle (wires that touch or nearly touch) whose steps are divided. Larger bundles take
 * whole steps and log the event "coarse"; dividing their steps would triple the time of 10 or 20
 * falling wires [-]. */
#define SW_MOST_NEAR 6

/* 1 if errors of steps are judged in the scene's present state. */
int sw_coarse_applies(const sw_scene *scene);
/* 1 if steps are not divided because too many wires move. */
int sw_coarse_is_crowd(const sw_scene *scene);
/* 1 if steps are not divided because too many wires touch each other. */
int sw_coarse_is_bundle(const sw_scene *scene);
/* 1 if steps are not divided because a mesh may be between jaws that close, hold or open. */
int sw_coarse_has_mesh_in_jaws(const sw_scene *scene);
/* Returns the error of the last trial over the allowed error, which is at most the tolerance [-].
 * Up to 1 is fine; 0: the method has no estimate, or the wires are a bundle, which is not
 * judged. */
double sw_coarse_of(const sw_scene *scene, double tolerance);
/* Call when a trial of size h is taken. Logs the event "coarse" if the trial is too coarse and
 * belongs to a case whose steps are not divided: a bundle, many wires, a mesh between jaws, or a
 * method without an estimate. */
void sw_coarse_tell(sw_scene *scene, double h);
/* The same for a part with the error `left` over the allowed one, taken because no part of a step
 * dt is shorter. */
void sw_coarse_tell_left(sw_scene *scene, double h, double dt, double left);
/* 1 if an error over the allowed one is that of a shock or jump. */
int sw_coarse_is_shock(double over);
/* Tells of a shock in a part that is taken because shorter parts were as coarse or failed. */
void sw_coarse_tell_rough(sw_scene *scene, double h);
/* Returns the part to take instead of one of size h, in a run of steps dt [s]. over: its error over
 * the allowed one [-]. */
double sw_coarse_part(const sw_scene *scene, double h, double dt, double over);
/* Returns the shortest part that coarse motion may ask for [s]. */
double sw_coarse_shortest(double dt);
/* As sw_coarse_part, for a part in which a tie goes taut: half of h, because only the half with the
 * snap is coarse; h if half is too short [s]. */
double sw_coarse_half(double h, double dt);
/* 1 if a shorter part helped. over: its error; before: that of the longer part. */
int sw_coarse_helps(double before, double over);
/* 1 if a part of twice the size would be fine too. */
int sw_coarse_may_grow(const sw_scene *scene, double over);

#endif
