/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Methods that several classes of a scene's objects share. */
#ifndef LSW_SHARE_H
#define LSW_SHARE_H

#include "bind/child.h"

/* Force and moment on something [N], [N m]. */
typedef struct lsw_load {
  sw_vec force, moment;
} lsw_load;

/* Runs order(scene, id) on the object at index 1: a method without arguments or results. */
int lsw_order(lua_State *L, const lsw_class *c,
              sw_status (*order)(sw_scene *scene, sw_handle id, sw_error *err));

/* Properties of an object of a scene: its name, its kind or model, and whether it is still there.
 * They also work when it was released or taken away. */
int lsw_prop_name(lua_State *L);
int lsw_prop_kind(lua_State *L);
int lsw_prop_alive(lua_State *L);
/* body:set_velocity(v [, omega [, about]]) */
int lsw_set_velocity(lua_State *L, const lsw_class *c);

/* Of a clamp, an obstacle or a tool: object:pose() -> position, rotation; object:pose(position [,
 * rotation]) sets them. Without a rotation the present one stays. */
int lsw_pose(lua_State *L, const lsw_class *cls);
/* object:follow(trajectory or its table) -> when it ends [s]; object:follow(nil) stops the object
 * where it is. mover: start of messages about the trajectory. */
int lsw_follow(lua_State *L, const lsw_class *cls, const char *mover);

/* Finds the rows of object:log([t1 [, t2]]), size numbers each: from the last row before t1 to the
 * first row after t2 [s]. Returns how many. Calls lsw_quiet, as the rows are the scene's. */
size_t lsw_log_rows(lua_State *L, const lsw_class *c, size_t size, const double **rows);
/* object:log([t1 [, t2]]) -> these rows as one flat list, number of rows. */
int lsw_log(lua_State *L, const lsw_class *c, size_t size);

#endif
