/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Jaws of tools in a step, or from one pose to the next. Shared by the files of this room only. */
#ifndef SW_STEP_JAW_H
#define SW_STEP_JAW_H

#include "scene/scene.h"

/* Their jaws at the start of a step of size h; 1: a trial may have to be corrected. After a
 * trial: 1 = the forces are as wanted, or cannot be. After an accepted one, or one given up. */
int sw_jaw_begin(sw_scene *scene, double h);
int sw_jaw_correct(sw_scene *scene, int rests); /* rests: trials are equilibria */
/* How far the forces of a trial are off, the worst over what is wanted [-]. */
double sw_jaw_off(sw_scene *scene);
/* After an equilibrium that is taken: 1 = its force is not as wanted, for that jumped, and the jaws
 * have begun to look for it from there on. */
int sw_jaw_again(sw_scene *scene);
void sw_jaw_follow(sw_scene *scene);
/* The same of an equilibrium at the scene's time: jaws that hold with a force open or close at
 * once, by a small part of the wires' thickness. After it: 1 = they have to go further. */
int sw_jaw_begin_rest(sw_scene *scene);
int sw_jaw_end_rest(sw_scene *scene, int went_well);
/* The largest pose step up to h in which jaws that close with a force go no further than a small
 * part of the wires' thickness [s]. */
double sw_jaw_step(const sw_scene *scene, double h);

#endif
