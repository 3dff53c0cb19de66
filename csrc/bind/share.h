/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Methods that several classes of a scene's objects have alike. */
#ifndef LSW_SHARE_H
#define LSW_SHARE_H

#include "bind/child.h"

/* Force and moment on something [N], [N m]. */
typedef struct lsw_load {
  sw_vec force, moment;
} lsw_load;

/* A method without arguments or results. */
int lsw_order(lua_State *L, const lsw_class *c,
              sw_status (*order)(sw_scene *scene, sw_handle id, sw_error *err));

/* Properties of an object of a scene, also when it was released or taken away: its name, its kind
 * or model, and whether it is still there. */
int lsw_prop_name(lua_State *L);
int lsw_prop_kind(lua_State *L);
int lsw_prop_alive(lua_State *L);
/* body:set_velocity(v [, omega [, about]]) */
int lsw_set_velocity(lua_State *L, const lsw_class *c);

/* Of a clamp, an obstacle or a tool. object:pose() -> position, rotation; object:pose(position [,
 * rotation]) sets; without a rotation it keeps the one it has. */
int lsw_pose(lua_State *L, const lsw_class *cls);
/* object:follow(trajectory or its table) -> when it ends [s]; object:follow(nil) stops it there.
 * mover: what messages about the trajectory begin with. */
int lsw_follow(lua_State *L, const lsw_class *cls, const char *mover);

/* Of object:log(t1, t2): its rows of size numbers from the last one before t1 to the first one
 * after t2 [s], which may be left out; how many. */
size_t lsw_log_rows(lua_State *L, const lsw_class *c, size_t size, const double **rows);
/* object:log(t1, t2) -> these as one flat list; how many rows. */
int lsw_log(lua_State *L, const lsw_class *c, size_t size);

#endif
