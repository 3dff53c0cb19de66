/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is kept and told of every accepted state: histories, extremes, series, and events: breaking
 * loads, kinks, crashes, what presses hard, wires that may buckle. */
#ifndef SW_WATCH_OBSERVE_H
#define SW_WATCH_OBSERVE_H

#include "base/tape.h"
#include "scene/parts.h"
#include "scene/values.h"

/* After an accepted state, which holds and jaws follow: histories, extremes, logs. */
sw_status sw_scene_observe(sw_scene *scene, sw_error *err);
/* Steps are to begin at the state, whose holds are placed: the wear of wires goes on from it, and
 * zones see it. SW_ENOMEM. */
sw_status sw_scene_begin_watching(sw_scene *scene, sw_error *err);

/* Tells of a wire whose largest tension is above its breaking load. */
void sw_scene_watch_breaking(sw_scene *scene, size_t wire, const sw_wire_extremes *now);
/* The same at the end of a run, of runs that were shorter than the window. */
void sw_scene_end_breaking(sw_scene *scene);
/* And as the end of a sentence, or nothing. */
void sw_scene_tell_broken(const sw_scene *scene, char *out, size_t size);
/* Tells of a tube that is folded at one place. */
void sw_scene_watch_kink(sw_scene *scene, size_t wire, const sw_wire_extremes *now);

/* 1: there is a tie that has a strength, and is not broken. */
int sw_scene_may_break(const sw_scene *scene);
/* SW_ENOCONV when a tie is pulled far beyond its strength with nodes at x: it breaks earlier. */
sw_status sw_scene_check_ties(const sw_scene *scene, const double *x, sw_error *err);
/* The hardest pull of ties that go taut, and as a share of what is usual for their wires [N],
 * [-]. */
typedef struct sw_snap {
  double pull, jolt;
} sw_snap;
/* 1: a tie goes taut between the scene's places and those of the last trial's stages: one that
 * snaps taut may be slack again at its end. */
int sw_scene_ties_snap(const sw_scene *scene, sw_snap *snap);
/* After a step, before histories follow: ties that were pulled too hard break. */
void sw_scene_watch_ties(sw_scene *scene);

/* Looks at a hold of the accepted state: is it driven into obstacles, does it push too hard? */
sw_status sw_hold_look_out(sw_scene *scene, sw_hold *hold, sw_error *err);
/* 1: one was driven into an obstacle after this time, that of a step's start. */
int sw_hold_crashed(const sw_scene *scene, double since);

/* Tells of a rod or string that two obstacles squeeze. */
void sw_scene_watch_squeezed(sw_scene *scene, size_t wire);

/* The obstacle that presses a wire hard, as the end of a sentence, or nothing. */
void sw_scene_tell_pressed(const sw_scene *scene, char *out, size_t size);

/* Tells of wires that are perfectly straight, or slow and in a plane, and pushed beyond buckling.
 * SW_ENOMEM, SW_ECALLBACK. */
sw_status sw_scene_look_for_buckling(sw_scene *scene, sw_error *err);

/* Add a row of the accepted state. */
sw_status sw_watch_wire(sw_scene *scene, size_t wire, const sw_wire_extremes *now, sw_error *err);
/* The same of all forces that tell what they do to wires (clips, ties). */
sw_status sw_watch_forces(sw_scene *scene, sw_error *err);
/* Ties between wires. */
sw_status sw_watch_ties(sw_scene *scene, sw_error *err);
void sw_watches_clear(sw_watches *watches);
void sw_tape_watches(sw_tape *tape, sw_watches *watches);

#endif
