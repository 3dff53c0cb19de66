/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Material frames of wires that turn about their axis. */
#ifndef SW_BODY_SPIN_H
#define SW_BODY_SPIN_H

#include "scene/scene.h"
#include "system/system.h"

/* Measures the unloaded frames of a wire for its plan. SW_ENOMEM. */
sw_status sw_scene_unloaded(const sw_scene *scene, size_t wire, sw_plan *plan);
/* Does this for the values that depend on the edges beside one node. */
void sw_scene_unloaded_near(const sw_scene *scene, size_t wire, sw_plan *plan, size_t node);
/* Present frames: into the system's state, and back into a mesh. */
void sw_scene_frame_in(sw_scene *scene);
void sw_scene_frame_out(sw_scene *scene, size_t wire);
/* Finds the bend of a hinge along the normals and across them, as an angle; returns the hinge's
 * length, 0: there is none. For refreshed bodies with frames [rad], [m]. */
double sw_scene_hinge_bend(const sw_system *system, const sw_body *body, size_t number,
                           double bend[2]);
/* Returns the bend of a hinge beyond that at rest, over its length [1/m]. number: in the plan's
 * list, with clamps after nodes. For refreshed bodies with frames. */
double sw_scene_flexure(const sw_system *system, const sw_body *body, size_t number);
/* Returns the curvature of a refreshed line at one of its clamps [1/m]. */
double sw_scene_clamp_curvature(const sw_system *system, const sw_body *body,
                                const sw_clamp_hinge *clamp);

/* Returns the moment about the wire's axis at an arc length of its mesh [N m]. */
double sw_scene_torque(const sw_system *system, const sw_body *body, double at);
/* Finds the largest torsion beyond that at rest of a refreshed line; its time is not set
 * [rad/m]. */
void sw_scene_torsion(const sw_system *system, const sw_body *body, sw_extreme *out);

#endif
