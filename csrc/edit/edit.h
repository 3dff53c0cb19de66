/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions for changes of a scene: for this room, and for rooms that copy, repair or free a
 * scene. */
#ifndef SW_EDIT_EDIT_H
#define SW_EDIT_EDIT_H

#include "edit/wires.h"
#include "link/hold.h"
#include "scene/forces.h"
#include "scene/obstacle.h"
#include "scene/scene.h"
#include "scene/wire.h"

/* Returns the plan of a mesh of this class for the wire. */
sw_strand_plan sw_scene_strand_plan(const sw_scene_wire *wire, const sw_wire_class *cls,
                                    const sw_wire_mesh_args *mesh);
/* Draws the wire's mesh with this many segments, with frames if needed. SW_ENOMEM. */
sw_status sw_scene_draw(sw_scene_wire *wire, size_t segments, sw_mesh *out, sw_error *err);
/* SW_EINVAL when the wire, as given, does not go with the scene's forces. */
sw_status sw_scene_check_rules(const sw_scene *scene, size_t wire, const sw_scene_wire *as,
                               sw_error *err);
/* Free the memory of these slots. */
void sw_scene_clear_body(sw_scene_wire *body);
void sw_scene_clear_obstacle(sw_scene_obstacle *obstacle);
void sw_scene_clear_force(sw_scene_force *force);
/* Drops rules of contact after the first `keep`. */
void sw_scene_drop_rules(sw_scene *scene, size_t keep);
/* Returns the class of wires or of objects of particles; NULL: there is none of this name. */
const sw_wire_class *sw_scene_body_class(const char *name);

/* Lets a hold grasp its redrawn mesh anew. The hold is not alive; living holds are older. Its drive
 * stays. SW_ENOMEM. */
sw_status sw_scene_retake_hold(sw_scene *scene, sw_hold *hold);
/* Copies where and how a hold holds into another slot that owns nothing. SW_ENOMEM. */
sw_status sw_scene_copy_shape(const sw_hold *from, sw_hold *to);
/* Call when a wire has got frames: its living holds hold it as it lies, with the frames. */
void sw_scene_frame_holds(sw_scene *scene, size_t wire);
/* Lets a hold grasp a wire that has other nodes but lies as before, at the hold's pose. Living
 * holds have grasped the wire already. SW_EINVAL when one of them is in the way; SW_ENOMEM. */
sw_status sw_scene_rehold(sw_scene *scene, sw_hold *hold, sw_pose pose, sw_error *err);
/* Returns the arguments of that grasp. */
sw_hold_args sw_scene_rehold_args(const sw_hold *hold);

/* Makes the nodes of joins anew in a redrawn wire that has its holds. SW_ENOMEM. */
sw_status sw_scene_retake_joins(sw_scene *scene, size_t wire);
/* Call when meshes have changed: joins of wires that lie as drawn measure themselves anew. */
void sw_scene_measure_joins(sw_scene *scene);

#endif
