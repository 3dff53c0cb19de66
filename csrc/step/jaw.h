/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Jaws of tools in a step, or from one pose to the next. Shared by the files of this room only. */
#ifndef SW_STEP_JAW_H
#define SW_STEP_JAW_H

#include "scene/scene.h"

/* Begins a step of size h for all jaws. Returns 1 if a trial may have to be corrected. */
int sw_jaw_begin(sw_scene *scene, double h);
/* After a trial: returns 1 if the jaws' forces are as wanted or cannot be; 0 if speeds were changed
 * for another trial. */
/* rests: 0, or trials are equilibria: of a pose, or of scene:settle. */
enum { SW_JAW_POSES = 1, SW_JAW_SETTLES = 2 };
int sw_jaw_correct(sw_scene *scene, int rests);
/* Returns the largest deviation of a trial's forces from the wanted ones, over the wanted force
 * [-]. */
double sw_jaw_off(sw_scene *scene);
/* After an accepted equilibrium: returns 1 if a force is off because it jumped; the jaws then have
 * begun a search that starts from this equilibrium. */
int sw_jaw_again(sw_scene *scene);
/* After an accepted state, or a step that was given up: openings and status follow. */
void sw_jaw_follow(sw_scene *scene);
/* Returns the number of tools whose jaws are on their way to what they were told [-]. */
size_t sw_jaw_moving(const sw_scene *scene);
/* As sw_jaw_begin, for an equilibrium at the scene's time: jaws that hold with a force open or
 * close at once, by a small part of the wires' thickness. */
int sw_jaw_begin_rest(sw_scene *scene);
/* After that equilibrium: returns 1 if the jaws have to go further. */
int sw_jaw_end_rest(sw_scene *scene, int went_well);
/* Returns the pose step, at most h. In it jaws that close to a force go no further than a small
 * part of the wires' thickness [s]. */
double sw_jaw_step(const sw_scene *scene, double h);
/* After a pose of size h: returns a shorter one if pads press a mesh's section by too much at once;
 * else h [s]. */
double sw_jaw_part(sw_scene *scene, double h);
/* 1 if pads may press a mesh's section. */
int sw_jaw_presses_sections(const sw_scene *scene);
/* After a trial of size h: returns how far jaws closed on wires, as a share of what is allowed in
 * one part; at most 1 is allowed [-]. */
double sw_jaw_closes(sw_scene *scene, double h);

#endif
