/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Largest values of wires, at the present state and over a run. */
#ifndef SW_READ_EXTREMES_H
#define SW_READ_EXTREMES_H

#include "body/side.h"
#include "read/reading.h"
#include "scene/values.h"
#include "state/clamp.h"
#include "state/field.h"
#include "system/system.h"

/* Finds the extremes of wire w at the refreshed state. */
void sw_scene_wire_now(sw_scene *scene, size_t w, sw_wire_extremes *now);
/* Adds the tensions of the run so far, including the present state. */
void sw_scene_run_tension(const sw_scene *scene, size_t wire, const sw_wire_extremes *now,
                          sw_wire_extremes *run);
/* Keeps the larger ones; the tension is left out. */
void sw_scene_keep_extremes(sw_wire_extremes *kept, const sw_wire_extremes *now);
void sw_scene_reset_extremes(sw_scene *scene);
/* 1 if the step that led to this state counts by window means. Steps as long as the window, and
 * equilibria, count as they are. */
int sw_scene_is_averaged(const sw_scene *scene);
/* Counts the mean tensions over the window as loads of the wire's recorded wear, whose places must
 * be the present ones. sw_scene_end_wear: at the end of a run, those that are not counted yet. */
void sw_scene_wear_means(sw_scene *scene, size_t wire);
void sw_scene_end_wear(sw_scene *scene);
/* Returns the axial forces of a line's edges (edges) for the wear: at the step's end, or of a
 * coarse step the means over the step [N]. */
const double *sw_scene_step_tension(const sw_scene *scene, const sw_body *body);
/* Finds the extremes of wire w at an accepted state, and keeps the larger ones. SW_ENOMEM. */
sw_status sw_scene_note_extremes(sw_scene *scene, size_t w, sw_wire_extremes *now, sw_error *err);
static inline double sw_angle_of_chord(double chord) { return 2.0 * asin(fmin(1.0, 0.5 * chord)); }
/* Returns |t2 - t1| at inner node i of a line [-]. */
double sw_scene_hinge_chord(const sw_field *field, size_t i);
/* How sharp a refreshed line's bend of this curvature is for its edges: about an inner node, or
 * from a clamp or joint on (else NULL). At a free end the curvature is zero [1/m]. */
sw_sharpness sw_scene_sharpness(const sw_scene *scene, const sw_body *body, size_t node,
                                const sw_bent_side *side, double value);
/* How sharp a mesh's largest bend is for its slices, if a hold is near; else all is 0. now: bend
 * and tension. */
sw_sharpness sw_scene_mesh_sharpness(const sw_scene *scene, size_t wire,
                                     const sw_wire_extremes *now);

#endif
