/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds objects of a scene by their handles. Returns NULL with err set if there is none. */
#ifndef SW_SCENE_LOOKUP_H
#define SW_SCENE_LOOKUP_H

#include "link/joint.h"
#include "scene/parts.h"
#include "scene/wire.h"

/* Declares a pointer to the result of a call; returns SW_EDEAD from the function if it is NULL. */
/* NOLINTBEGIN(bugprone-macro-parentheses): a type and a declared name take none */
#define SW_FIND(type, name, call) \
  type *name = (call);            \
  if (!name) return SW_EDEAD
/* NOLINTEND(bugprone-macro-parentheses) */

sw_hold *sw_scene_find_hold(const sw_scene *scene, sw_handle h, sw_error *err);
/* The same for a hold that has not been released. */
sw_hold *sw_scene_living_hold(const sw_scene *s, sw_handle hold, sw_error *err);

/* A join, released or not. */
sw_joint *sw_scene_find_join(const sw_scene *scene, sw_handle join, sw_error *err);

/* A force, released or not. */
sw_scene_force *sw_scene_find_force(const sw_scene *scene, sw_handle h, sw_error *err);

/* Objects in the scene; any: also one that was taken away. */
sw_scene_obstacle *sw_scene_find_obstacle(const sw_scene *scene, sw_handle h, sw_error *err);
sw_scene_obstacle *sw_scene_any_obstacle(const sw_scene *scene, sw_handle h, sw_error *err);
sw_tool *sw_scene_find_tool(const sw_scene *scene, sw_handle h, sw_error *err);
sw_tool *sw_scene_any_tool(const sw_scene *scene, sw_handle h, sw_error *err);

/* SW_EINVAL when the wire is a mesh of particles, which `what` does not support. */
sw_status sw_scene_check_line(const sw_scene_wire *wire, const char *what, sw_error *err);
/* A body is a wire or an object of particles; sw_scene_find_wire refuses the latter. */
sw_scene_wire *sw_scene_find_body(const sw_scene *scene, sw_handle h, sw_error *err);
sw_scene_wire *sw_scene_find_wire(const sw_scene *scene, sw_handle h, sw_error *err);
/* Returns the body of a number in frames; NULL if it is gone, then *gone is its record. */
const sw_scene_wire *sw_scene_numbered(const sw_scene *scene, size_t number, const sw_gone **gone);

#endif
