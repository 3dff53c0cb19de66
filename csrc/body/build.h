/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the edited scene to a system that can be advanced, and back. */
#ifndef SW_BODY_BUILD_H
#define SW_BODY_BUILD_H

#include "scene/parts.h"
#include "scene/scene.h"

/* Leave the built state: the meshes become authoritative again. */
sw_status sw_scene_thaw(sw_scene *scene);
/* Make the system from the meshes and holds, if it is not. */
sw_status sw_scene_build(sw_scene *scene, sw_error *err);

/* The wire is as drawn: not twisted anywhere. SW_ENOMEM. */
sw_status sw_scene_draw_untwisted(sw_scene_wire *wire);

/* Drop the contact memory kept for the next system. */
void sw_scene_forget_contact(sw_scene *scene);

#endif
