/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trajectories for other bindings: anything that moves takes a trajectory, or
 * the table for one, through these. */
#ifndef LSW_BIND_MOTION_H
#define LSW_BIND_MOTION_H

#include "bind/class.h"

extern const lsw_class lsw_class_trajectory;

/* The motion at index, a trajectory or the table (or function) for one; with a
 * reference that the caller must release. Raises a clear error otherwise. what is
 * for messages: "obstacle:follow". */
sw_motion *lsw_motion_from(lua_State *L, int index, const char *what);

/* What lsw_motion_params reads, for a table that has other keys as well (put it
 * into an lsw_section). Keys whose values stay in the table (points, func, ...)
 * are fetched from there by lsw_motion_make. */
typedef struct lsw_motion_args {
  int law;                                   /* index among the laws, -1 = not given [-] */
  double speed, angular_speed;               /* [m/s], [rad/s] */
  double acceleration, angular_acceleration; /* [m/s2], [rad/s2] */
  double duration, blend, start, step;       /* [s], [m], [s], [s] */
  int stop;                                  /* -1 = not given [-] */
  int relative;
} lsw_motion_args;
extern const sw_params lsw_motion_params;

/* Make the motion from args and the table at index they were read from; pushes
 * the trajectory that owns it and returns it without a further reference. */
sw_motion *lsw_motion_make(lua_State *L, int index, const char *what, const lsw_motion_args *args);

/* Raise the error for a failed call that evaluated motions: for SW_ECALLBACK the
 * very value that the Lua function raised, else as lsw_raise does. */
int lsw_motion_rethrow(lua_State *L, sw_status status, const sw_error *err);

/* The same for other bindings' callbacks: keep the value on top of L's stack
 * (popped) for lsw_motion_rethrow, and write it as text to err. Never raises. */
sw_status lsw_motion_keep_error(lua_State *L, sw_error *err);

/* --- between the files of this binding ---------------------------------------- */

void lsw_motion_open_functions(lua_State *L);

/* A motion given by the Lua function at index, as *out with one reference. */
sw_status lsw_motion_function(lua_State *L, int index, const lsw_motion_args *args, sw_motion **out,
                              sw_error *err);

/* Keep the function on top of the stack (popped): called with a `path`, a `scale`
 * (or nil) and the object's name, it returns the array of way-points. */
void lsw_motion_keep_reader(lua_State *L);

void lsw_motion_open_arguments(void);

#endif
