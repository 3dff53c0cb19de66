/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records of every accepted state: histories, extremes, logs. Of the scene's inside. */
#ifndef SW_SCENE_OBSERVE_H
#define SW_SCENE_OBSERVE_H

#include "scene/reading.h"
#include "scene/scene.h"
#include "state/clamp.h"
#include "state/field.h"
#include "system/system.h"

/* After an accepted state, which holds and jaws follow: histories, extremes, logs. */
sw_status sw_scene_observe(sw_scene *scene, sw_error *err);
/* Extremes of wire w at the refreshed state. */
void sw_scene_wire_now(sw_scene *scene, size_t w, sw_wire_extremes *now);
/* The tensions of the run so far, the state now included. */
void sw_scene_run_tension(const sw_scene *scene, size_t wire, const sw_wire_extremes *now,
                          sw_wire_extremes *run);
/* Keep the larger ones, but for the tension. */
void sw_scene_keep_extremes(sw_wire_extremes *kept, const sw_wire_extremes *now);
void sw_scene_reset_extremes(sw_scene *scene);
/* Steps are to begin at the state, whose holds are placed: the wear of wires goes on from it, and
 * zones see it. SW_ENOMEM. */
sw_status sw_scene_begin_watching(sw_scene *scene, sw_error *err);
/* Axial forces of the edges of a line in the step that led here (edges) [N]. */
const double *sw_scene_step_tension(const sw_scene *scene, const sw_body *body);
/* Those of wire w at an accepted state into *now, and kept. SW_ENOMEM. */
sw_status sw_scene_note_extremes(sw_scene *scene, size_t w, sw_wire_extremes *now, sw_error *err);

/* The moment about the wire's axis at arc length at of its mesh [N m]. */
double sw_scene_torque(const sw_system *system, const sw_body *body, double at);
/* Largest torsion beyond that at rest of a refreshed line, without its time [rad/m]. */
void sw_scene_torsion(const sw_system *system, const sw_body *body, sw_extreme *out);
/* |t2 - t1| at inner node i of a line [-]; the curvature beside a clamp [1/m]. */
double sw_scene_hinge_chord(const sw_field *field, size_t i);
double sw_scene_clamp_curvature(const sw_system *system, const sw_body *body,
                                const sw_clamp_hinge *hinge);

#endif
