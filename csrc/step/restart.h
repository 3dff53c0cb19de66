/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps whose method starts anew: it takes nothing of the state's accelerations and rates, which
 * are stale or those of something that is over. All reasons to do so are here. What the scene asks
 * for (see scene/course.h) holds for every try until a step is taken; what a try brings to light,
 * for those that follow it. Shared by the files of this room only. */
#ifndef SW_STEP_RESTART_H
#define SW_STEP_RESTART_H

#include "step/ladder.h"

/* 1: the scene was changed or its state jumped; energy is not judged across that. */
int sw_restart_changed(const sw_scene *scene);
/* A part begins: does something that holds a wire start, stop or turn a corner at once now? */
void sw_restart_at_jerk(sw_scene *scene);
/* A part is tried: the scene was changed, or the referee wants it tried in another way. */
void sw_restart_try(sw_ladder *p);
/* The trial struck something: velocities at the step's start are others now. dull: it does not
 * bounce, what is tried next is of implicit Euler. */
void sw_restart_struck(sw_scene *scene, int dull);
/* The trial was taken: what shook there is over. */
void sw_restart_taken(sw_scene *scene);
/* The part was refused. cut: it only was to end sooner. */
void sw_restart_refused(sw_ladder *p, int cut);

/* The stepper is a new one: it starts anew, unless the scene goes on as if it were not. */
void sw_restart_stepper(sw_scene *scene);
/* Nodes came or went, which alone is no jump: 1, there was one before. Afterwards. */
int sw_restart_pending(const sw_scene *scene);
void sw_restart_resume(sw_scene *scene, int pending);

#endif
