/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reasons for which a method starts anew, without the accelerations and rates of the state. These
 * are stale, or belong to a motion that has ended. All reasons are here. A request by the scene
 * (see scene/course.h) holds for every try until a step is taken; a reason found in a try holds for
 * the tries after it. Private to this room. */
#ifndef SW_STEP_RESTART_H
#define SW_STEP_RESTART_H

#include "step/ladder.h"

/* 1 if the scene was changed or its state jumped; the energy of such a step is not judged. */
int sw_restart_changed(const sw_scene *scene);
/* *jerks: 1 if a drive of a hold, tool or obstacle starts, stops or turns a corner abruptly at this
 * time, which is the start or end of a part of h [s]. Fails only if a script's function fails. */
sw_status sw_restart_jerks(const sw_scene *scene, double time, double h, int *jerks, sw_error *err);
/* Call when a part of h begins: starts anew if a drive does so now [s]. */
sw_status sw_restart_at_jerk(sw_scene *scene, double h, sw_error *err);
/* Call before a try: starts anew if the scene was changed or the referee asks for it. */
void sw_restart_try(sw_ladder *p);
/* Bit of the stepper's `restart`: in the last part a drive came to rest with a deceleration. Friction
 * of the wires was set then, and the strain must follow it: friction is soft for one part. */
enum { SW_HALTED = 2 };
/* Call when the trial struck something; the velocities at the step's start have changed. dull:
 * impacts do not rebound, so the next try takes implicit Euler. */
void sw_restart_struck(sw_scene *scene, int dull);
/* Call when the trial is taken: the next step starts anew if a shock ended in it. */
void sw_restart_taken(sw_scene *scene);
/* *stops: 1 if a drive comes softly to rest in this step or in the one before, while wires slide.
 * Such a step is tried with implicit Euler. In a method of second order, nodes swing back by its
 * error; friction needs only nanometres to change its direction and would stay reversed. */
sw_status sw_restart_stops(const sw_scene *scene, double h, int *stops, sw_error *err);
/* Shortens *h so that the step ends where the velocity of a drive jumps, or where a drive comes to
 * rest with a deceleration while wires slide [s]. sw_restart_halts: 1 if such a stop lies between
 * now and h. Both, and sw_restart_stops, fail only if a script's function fails. */
sw_status sw_restart_until_break(sw_scene *scene, double *h, sw_error *err);
sw_status sw_restart_halts(const sw_scene *scene, double h, int *halts, sw_error *err);
/* Returns the longest part that may begin now; HUGE_VAL: any [s]. Call sw_restart_after_stop before
 * it: that notes whether a drive stops at once now, in steps of h, while wires slide. Fails as
 * above. */
double sw_restart_part(const sw_scene *scene);
sw_status sw_restart_after_stop(sw_scene *scene, double h, sw_error *err);
/* Shortens *h if a drive comes softly to rest soon while wires slide [s]. p->brakes: 1 if it does
 * so within these parts. Fails as above. */
sw_status sw_restart_before_stop(sw_ladder *p, double *h, sw_error *err);
/* Call when the part was refused. cut: 1 if it only has to end sooner. */
void sw_restart_refused(sw_ladder *p, int cut);

/* Call after a stepper was made: it starts anew, unless the scene goes on unchanged
 * (SW_GOES_ON). */
void sw_restart_stepper(sw_scene *scene);
/* For changes of nodes only, which are not a jump. sw_restart_pending, before the change: 1 if a
 * restart is due. sw_restart_resume, after it: restores that. */
int sw_restart_pending(const sw_scene *scene);
void sw_restart_resume(sw_scene *scene, int pending);

#endif
