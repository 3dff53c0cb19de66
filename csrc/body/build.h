/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Builds the edited scene into a system that can be advanced, and takes it back. */
#ifndef SW_BODY_BUILD_H
#define SW_BODY_BUILD_H

#include "scene/parts.h"
#include "scene/scene.h"
#include "scene/wire.h"

/* Leaves the built state: the meshes become authoritative again. */
sw_status sw_scene_unbuild(sw_scene *scene);
/* Call when a force was added: the system is made anew before it is used for more than places. */
void sw_scene_await_forces(sw_scene *scene);
/* Makes the system from the meshes and holds, unless it exists. */
sw_status sw_scene_build(sw_scene *scene, sw_error *err);

/* Marks the wire as drawn, not twisted anywhere. SW_ENOMEM. */
sw_status sw_scene_draw_untwisted(sw_scene_wire *wire);

/* Gives the kept contact memory to the new system. SW_ENOMEM. */
sw_status sw_scene_inherit_contact(sw_scene *scene);
/* 1 if a wire that is still there pressed on the obstacle at the last step's end. */
int sw_scene_was_pressed(const sw_scene *scene, size_t obstacle);
/* Drops the contact memory kept for the next system. */
void sw_scene_forget_contact(sw_scene *scene);

/* Call after a body or an obstacle was added: wire inside an obstacle then comes out slowly, as at
 * the beginning of a scene, and the energy for that is no error. */
void sw_scene_let_out(sw_scene *scene);

/* Finds the wire of a handle; builds and refreshes the scene for reading. */
sw_status sw_scene_open_wire(sw_scene *scene, sw_handle h, sw_scene_wire **wire, sw_error *err);
/* Does this for reading places and velocities only: does not build in added forces. */
sw_status sw_scene_open_places(sw_scene *scene, sw_handle h, sw_scene_wire **wire, sw_error *err);
/* SW_EINVAL when place is no arc length of the wire. */
sw_status sw_scene_check_place(const sw_scene_wire *wire, double place, sw_error *err);
/* The same for a body. */
sw_status sw_scene_open_body(sw_scene *scene, sw_handle h, sw_scene_wire **body, sw_error *err);
/* SW_EINVAL for a speed above that of light [m/s]. */
sw_status sw_scene_check_speed(const sw_scene *scene, const sw_scene_wire *body, double speed,
                               sw_error *err);

#endif
