/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Jaws of tools in a step, or from one pose to the next. Private to this room. */
#ifndef SW_STEP_JAW_H
#define SW_STEP_JAW_H

#include "scene/gripper.h"
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
/* Call after an accepted equilibrium. Returns 1 if a force is off because it jumped; a new search
 * from this equilibrium has then begun. */
int sw_jaw_again(sw_scene *scene);
/* Updates openings and status. Call after an accepted state, or after a step that was given up. */
void sw_jaw_follow(sw_scene *scene);
/* Returns the number of tools whose jaws still move to their target [-]. */
size_t sw_jaw_moving(const sw_scene *scene);
/* As sw_jaw_begin, for an equilibrium at the scene's time: jaws that hold with a force open or
 * close at once, by a small share of the wires' thickness. */
int sw_jaw_begin_rest(sw_scene *scene);
/* Call after that equilibrium. Returns 1 if the jaws have to move further. */
int sw_jaw_end_rest(sw_scene *scene, int went_well);
/* Returns the pose step, at most h [s]. It is shorter if jaws that close to a force would close by
 * more than a small share of the wires' thickness. */
double sw_jaw_step(const sw_scene *scene, double h);
/* Call after a pose of size h; before: the jaws at its start, one per slot. A search may have begun
 * anew within it. Returns a shorter one if pads gain too much force in it to follow their way; else
 * h [s]. */
double sw_jaw_part(sw_scene *scene, const sw_jaw *before, double h);
/* 1 if pads close whose way matters: on a mesh's section, or three and more on a wire. */
int sw_jaw_ways_matter(const sw_scene *scene);
/* Call after a trial of size h. Returns the closing of jaws on wires over the allowed closing per
 * part; up to 1 is fine [-]. */
double sw_jaw_closes(sw_scene *scene, double h);

#endif
