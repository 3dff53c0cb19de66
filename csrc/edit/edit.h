/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Of changes of a scene, for each other and for those that copy, mend or end it. */
#ifndef SW_EDIT_EDIT_H
#define SW_EDIT_EDIT_H

#include "edit/wires.h"
#include "link/hold.h"
#include "scene/forces.h"
#include "scene/obstacle.h"
#include "scene/scene.h"
#include "scene/wire.h"

/* What a mesh of this class for the wire is to be of. */
sw_strand_plan sw_scene_strand_plan(const sw_scene_wire *wire, const sw_wire_class *cls,
                                    const sw_wire_mesh_args *mesh);
/* A wire's mesh as drawn, of some segments; frames too. SW_ENOMEM. */
sw_status sw_scene_draw(sw_scene_wire *wire, size_t segments, sw_mesh *out, sw_error *err);
/* May the wire, as it is given, be in the scene with its forces and rules? */
sw_status sw_scene_check_rules(const sw_scene *scene, size_t wire, const sw_scene_wire *as,
                               sw_error *err);
/* May it touch others, as rules of contact ask of it? */
sw_status sw_scene_check_touched(const sw_scene *scene, size_t wire, const sw_scene_wire *as,
                                 sw_error *err);
/* Free what these slots own. */
void sw_scene_clear_body(sw_scene_wire *body);
void sw_scene_clear_obstacle(sw_scene_obstacle *obstacle);
void sw_scene_clear_force(sw_scene_force *force);
/* Forget rules of contact beyond the first ones. */
void sw_scene_drop_rules(sw_scene *scene, size_t keep);
/* The class of a wire or of objects of particles; NULL: there is none of this name. */
const sw_wire_class *sw_scene_body_class(const char *name);

/* Take hold of the redrawn mesh anew. The hold is not alive; those that are were there
 * before it. What drives it stays. SW_ENOMEM. */
sw_status sw_scene_retake_hold(sw_scene *scene, sw_hold *hold);
/* Where and how a hold holds, into another slot that owns nothing. SW_ENOMEM. */
sw_status sw_scene_copy_shape(const sw_hold *from, sw_hold *to);
/* A wire without frames has got some: its living holds keep it as they do, frames and all. */
void sw_scene_frame_holds(sw_scene *scene, size_t wire);
/* Take hold of a wire that has other nodes but lies as before; the hold's pose is known. It is
 * not alive; those that are have done so. SW_EINVAL when one of them is in the way; SW_ENOMEM. */
sw_status sw_scene_rehold(sw_scene *scene, sw_hold *hold, sw_pose pose, sw_error *err);

/* Make their nodes anew in a wire that was drawn again and has its holds. SW_ENOMEM. */
sw_status sw_scene_retake_joins(sw_scene *scene, size_t wire);
/* Meshes are others: joins of wires that lie as drawn keep what these have now. */
void sw_scene_measure_joins(sw_scene *scene);

#endif
