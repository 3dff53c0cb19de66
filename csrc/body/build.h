/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the edited scene to a system that can be advanced, and back. */
#ifndef SW_BODY_BUILD_H
#define SW_BODY_BUILD_H

#include "scene/parts.h"
#include "scene/scene.h"
#include "scene/wire.h"

/* Leave the built state: the meshes become authoritative again. */
sw_status sw_scene_unbuild(sw_scene *scene);
/* Make the system from the meshes and holds, if it is not. */
sw_status sw_scene_build(sw_scene *scene, sw_error *err);

/* The wire is as drawn: not twisted anywhere. SW_ENOMEM. */
sw_status sw_scene_draw_untwisted(sw_scene_wire *wire);

/* Drop the contact memory kept for the next system. */
void sw_scene_forget_contact(sw_scene *scene);

/* The wire of a handle, in a scene that is built, readable and refreshed. */
sw_status sw_scene_open_wire(sw_scene *scene, sw_handle h, sw_scene_wire **wire, sw_error *err);
/* SW_EINVAL when place is no arc length of the wire. */
sw_status sw_scene_check_place(const sw_scene_wire *wire, double place, sw_error *err);
/* The body of a handle, in a scene that is built, readable and refreshed. */
sw_status sw_scene_open_body(sw_scene *scene, sw_handle h, sw_scene_wire **body, sw_error *err);
/* SW_EINVAL for a speed that nothing has [m/s]. */
sw_status sw_scene_check_speed(const sw_scene *scene, const sw_scene_wire *body, double speed,
                               sw_error *err);

#endif
