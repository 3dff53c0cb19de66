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

/* Of a wire or an object of particles: its name, also when it was taken away; is it there? */
int lsw_body_name(lua_State *L, const lsw_class *c);
int lsw_body_present(lua_State *L, const lsw_class *c);
/* body:set_velocity(v [, omega [, about]]) */
int lsw_set_velocity(lua_State *L, const lsw_class *c);

/* Something that has a place of its own: clamp, obstacle, tool. */
typedef struct lsw_posed {
  const lsw_class *cls;
  const char *name, *mover; /* in messages; of its trajectory */
  sw_status (*get)(sw_scene *scene, sw_handle id, sw_pose *out, sw_error *err);
  sw_status (*set)(sw_scene *scene, sw_handle id, sw_pose pose, sw_error *err);
  sw_status (*follow)(sw_scene *scene, sw_handle id, sw_motion *motion, int relative,
                      sw_error *err);
} lsw_posed;

/* object:pose() -> position, rotation; object:pose(position [, rotation]) sets; without a rotation
 * it keeps the one it has. */
int lsw_pose(lua_State *L, const lsw_posed *of);
/* object:follow(trajectory or its table) -> when it ends [s]; object:follow(nil) stops it there. */
int lsw_follow(lua_State *L, const lsw_posed *of);

/* object:log() -> flat rows of size numbers; how many rows. */
typedef sw_status (*lsw_log_reader)(sw_scene *scene, sw_handle id, const double **rows,
                                    size_t *count, sw_error *err);
int lsw_log(lua_State *L, const lsw_class *c, lsw_log_reader read, size_t size);

#endif
