/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is recorded and reported for every accepted state: histories, extremes, series, and events
 * (breaking loads, kinks, crashes, hard presses, wires that may buckle). */
#ifndef SW_WATCH_OBSERVE_H
#define SW_WATCH_OBSERVE_H

#include "base/tape.h"
#include "scene/parts.h"
#include "scene/values.h"

/* Updates histories, extremes and logs. Call after an accepted state, when holds and jaws have
 * followed it. */
sw_status sw_scene_observe(sw_scene *scene, sw_error *err);
/* Begins watching at the state from which steps start, with its holds placed: wear goes on from it,
 * and zones see it. SW_ENOMEM. */
sw_status sw_scene_begin_watching(sw_scene *scene, sw_error *err);

/* Reports a wire whose largest tension is above its breaking load. */
void sw_scene_watch_breaking(sw_scene *scene, size_t wire, const sw_wire_extremes *now);
/* The same at the end of a run, for runs shorter than the averaging window. */
void sw_scene_end_breaking(sw_scene *scene);
/* Writes the same as the end of a sentence, or "". */
void sw_scene_tell_broken(const sw_scene *scene, char *out, size_t size);
/* Reports a tube that is folded at one place. */
void sw_scene_watch_kink(sw_scene *scene, size_t wire, const sw_wire_extremes *now);

/* Reports a rod whose edges are too long for its sharpest bend. */
void sw_scene_watch_edges(sw_scene *scene, size_t wire, const sw_wire_extremes *now);
/* Reports a rod that turns about its axis on obstacles, where friction does not resist.
 * SW_ENOMEM. */
sw_status sw_scene_watch_spun(sw_scene *scene, size_t wire, const sw_wire_extremes *now,
                              sw_error *err);
/* Reports a rod whose largest tension lies between two holds that are too near for its edges. */
void sw_scene_watch_between(sw_scene *scene, size_t wire, const sw_wire_extremes *now);
/* Reports rods whose sharpest bend of the run is a corner of the path they were drawn along. Call
 * at the end of a run. */
void sw_scene_end_corners(sw_scene *scene);
/* Turn of the sharpest corner of the path that a wire was drawn along, within reach of s [rad]. */
double sw_corner_turn(const struct sw_scene_wire *wire, double s, double reach);
/* Reports bends that take only an edge or two; once per run, at its end, after other events. */
void sw_scene_end_bends(sw_scene *scene);
/* Reports lines that lie inside an obstacle with edges. Call at the end of a run. */
void sw_scene_end_inside(sw_scene *scene);
/* Reports an object of particles with obstacles, wires or particles in its elements. */
void sw_scene_watch_pierced(sw_scene *scene, size_t wire);
/* Reports a wire or object that passes through an open mesh from its back. */
void sw_scene_watch_sheets(sw_scene *scene, size_t wire);
/* Reports a wire that slips over a part of itself in a rigid grip. */
void sw_scene_watch_passed(sw_scene *scene);
/* Reports lines that pass through each other, or through themselves, since no contact keeps them
 * apart. SW_ENOMEM. */
sw_status sw_scene_watch_through(sw_scene *scene, sw_error *err);
/* A search for rest made wires jump: reports lines that passed through themselves on its way. Call
 * before the equilibrium is observed. */
sw_status sw_scene_watch_leap(sw_scene *scene, sw_error *err);
/* Reports joints that pass no twist where this may count. Call at the end of a run. */
void sw_scene_end_joints(sw_scene *scene);
/* Reports joints that have rolled about a wire that a hold keeps from rolling. judges = 0: only
 * notes the angles at the start. */
void sw_scene_watch_rolls(sw_scene *scene, int judges);

/* 1 if there is an unbroken tie with a strength. */
int sw_scene_may_break(const sw_scene *scene);
/* SW_ENOCONV when a tie is pulled far beyond its strength with nodes at x: it breaks within the
 * step. */
sw_status sw_scene_check_ties(const sw_scene *scene, const double *x, sw_error *err);
/* Ties that go taut. */
typedef struct sw_snap {
  int followed; /* 1: during a blow */
  int any;
  double jolt; /* largest pull over the usual force of its wire, of ties that strike; 0: none [-] */
  double time; /* shortest time of a hard swing, as sw_scene_ties_swing [s] */
} sw_snap;
/* 1 if a tie goes taut between the scene's state and a stage of the last trial. Stages are checked
 * because a tie that snaps taut may be slack again at the trial's end. */
int sw_scene_ties_snap(const sw_scene *scene, int followed, sw_snap *snap);
/* Returns the shortest time sqrt(m/k) of ties that are taut at the scene's state and swing hard; m:
 * mass of the places that they pull at. HUGE_VAL: none does [s]. */
double sw_scene_ties_swing(const sw_scene *scene);
/* Breaks ties that were pulled too hard. Call after a step, before histories follow. */
void sw_scene_watch_ties(sw_scene *scene);

/* Checks a hold of the accepted state: is it driven into an obstacle, does it push too hard? */
sw_status sw_hold_look_out(sw_scene *scene, sw_hold *hold, sw_error *err);
/* Reports a hold that is `depth` [m] deep in an obstacle, by less than a crash, if the obstacle
 * presses the wire there with more than usual forces. Returns 1 if it does. */
int sw_hold_watch_press(sw_scene *scene, const sw_hold *hold, size_t obstacle, double depth);
/* The same for a hold whose direction leads the wire's next edge more than `noticed` [m] deeper
 * into an obstacle than the held place is. */
sw_status sw_hold_watch_tilt(sw_scene *scene, const sw_hold *hold, double noticed, sw_error *err);
/* Reports a slider whose friction locks, or nearly locks, as it slides. */
void sw_hold_watch_jam(sw_scene *scene, const sw_hold *hold);
/* 1 if a hold was driven into an obstacle after `since`, the step's start. */
int sw_hold_crashed(const sw_scene *scene, double since);

/* Reports a rod or string that two obstacles squeeze. */
void sw_scene_watch_squeezed(sw_scene *scene, size_t wire);
/* Logs "pressed" where pads that hold a rod press it into an obstacle. */
void sw_scene_watch_pads_press(sw_scene *scene, size_t wire);
/* In poses: the same where pads squeeze a mesh of springs on an obstacle. */
void sw_scene_watch_sinking(sw_scene *scene, size_t wire);
/* In poses: logs "unkept" where pads end with another force than the one that they are to keep. */
void sw_scene_watch_unkept(sw_scene *scene);

/* Reports pads that hold a mesh along them by more than their friction. */
sw_status sw_scene_watch_caught(sw_scene *scene, size_t wire, sw_error *err);

/* Reports a wire or object whose solid elements a damping's stiffness does not damp. */
void sw_scene_watch_undamped(sw_scene *scene, size_t wire);

/* Reports a wire that breaks loose within a step, where friction of sliding is less. */
void sw_scene_watch_loose(sw_scene *scene, size_t wire);

/* Reports an end of a rod that is pushed onto an obstacle and nearly slips, or hardly does. */
void sw_scene_watch_poke(sw_scene *scene, size_t wire);

/* Writes which obstacle presses a wire hard, and since when wires touch it, as the end of a
 * sentence, or "". */
void sw_scene_tell_pressed(sw_scene *scene, char *out, size_t size);

/* Writes which gripper's pads use up their friction, as the end of a sentence, or "". */
void sw_scene_tell_used_up(const sw_scene *scene, char *out, size_t size);

/* Reports wires that are perfectly straight, or slow and in a plane, and pushed beyond buckling.
 * SW_ENOMEM, SW_ECALLBACK. */
sw_status sw_scene_look_for_buckling(sw_scene *scene, sw_error *err);

/* Reports a wire that stayed straight, or in a plane, under a push that bends real wires, and then
 * buckled. */
struct sw_bend;
void sw_scene_watch_unbent(sw_scene *scene, size_t wire, const struct sw_bend *bend);
/* Follows a moving wire that is pushed and bent in a plane; between steps it is looked at, and
 * reported if a real wire had left the plane. SW_ENOMEM, SW_ECALLBACK. */
void sw_scene_watch_arched(sw_scene *scene, size_t wire, const struct sw_bend *bend);
sw_status sw_scene_look_across(sw_scene *scene, sw_error *err);
/* Reports friction that brakes lines that go round each other. */
void sw_scene_watch_together(sw_scene *scene);
/* Notes how much tension wires lose because they are in each other, and reports it at the end of a
 * run or of settling. Call the first one between steps. SW_ENOMEM, SW_ECALLBACK. */
sw_status sw_scene_watch_sunk(sw_scene *scene, sw_error *err);
void sw_scene_end_sunk(sw_scene *scene);
/* The run ended: reports wires that still stay straight under such a push. Call it after
 * sw_scene_look_for_buckling. */
void sw_scene_end_unbent(sw_scene *scene);

/* Adds a row of the accepted state to a wire's series. */
sw_status sw_watch_wire(sw_scene *scene, size_t wire, const sw_wire_extremes *now, sw_error *err);
/* The same for all forces that report their force on wires (clips, tethers). */
sw_status sw_watch_forces(sw_scene *scene, sw_error *err);
/* The same for all ties between wires. */
sw_status sw_watch_ties(sw_scene *scene, sw_error *err);
void sw_watches_clear(sw_watches *watches);
void sw_tape_watches(sw_tape *tape, sw_watches *watches);

#endif
