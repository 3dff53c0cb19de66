/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Objects of a scene by their handles: NULL with err set if there is none. */
#ifndef SW_SCENE_LOOKUP_H
#define SW_SCENE_LOOKUP_H

#include "link/joint.h"
#include "scene/parts.h"
#include "scene/wire.h"

/* Declares a pointer to what a call finds; returns SW_EDEAD from the function where it finds none.
 */
/* NOLINTBEGIN(bugprone-macro-parentheses): a type and a declared name take none */
#define SW_FIND(type, name, call) \
  type *name = (call);            \
  if (!name) return SW_EDEAD
/* NOLINTEND(bugprone-macro-parentheses) */

sw_hold *sw_scene_find_hold(const sw_scene *scene, sw_handle h, sw_error *err);
/* The same of a hold that has not been released. */
sw_hold *sw_scene_living_hold(const sw_scene *s, sw_handle hold, sw_error *err);

/* NULL: the scene does not know it. */
sw_joint *sw_scene_find_join(const sw_scene *scene, sw_handle join, sw_error *err);

/* Released or not. */
sw_scene_force *sw_scene_find_force(const sw_scene *scene, sw_handle h, sw_error *err);

/* Those that are there; any: also one that was taken away. */
sw_scene_obstacle *sw_scene_find_obstacle(const sw_scene *scene, sw_handle h, sw_error *err);
sw_scene_obstacle *sw_scene_any_obstacle(const sw_scene *scene, sw_handle h, sw_error *err);
sw_tool *sw_scene_find_tool(const sw_scene *scene, sw_handle h, sw_error *err);
sw_tool *sw_scene_any_tool(const sw_scene *scene, sw_handle h, sw_error *err);

/* SW_EINVAL when the wire is a mesh of particles, which does not go with what. */
sw_status sw_scene_check_line(const sw_scene_wire *wire, const char *what, sw_error *err);
/* May it touch others? Wires that are lines and objects of particles do, sections of meshes do not.
 */
sw_status sw_scene_check_touching(const sw_scene_wire *wire, sw_error *err);
/* The object of a handle, or NULL with err set. A body is a wire or an object of particles. */
sw_scene_wire *sw_scene_find_body(const sw_scene *scene, sw_handle h, sw_error *err);
sw_scene_wire *sw_scene_find_wire(const sw_scene *scene, sw_handle h, sw_error *err);
/* The body of a number in frames, or NULL when it is gone; then what is known of it. */
const sw_scene_wire *sw_scene_numbered(const sw_scene *scene, size_t number, const sw_gone **gone);

#endif
