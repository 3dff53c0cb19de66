/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads trajectories for other bindings: anything that moves takes a trajectory,
 * the table for one, or a function of time through these functions. */
#ifndef LSW_BIND_MOTION_H
#define LSW_BIND_MOTION_H

#include "bind/class.h"

extern const lsw_class lsw_class_trajectory;

/* Returns the motion at index: a trajectory, or the table or function for one. The
 * caller must release its reference. Raises a clear error for anything else. what is
 * for messages: "obstacle:follow". */
sw_motion *lsw_motion_from(lua_State *L, int index, const char *what);

/* What the rows lsw_motion_params read. For a table that has other keys as well, put
 * both into an lsw_section. Keys whose values stay in the table (points, func, ...)
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

/* Makes the motion from args and the table at index that args were read from. Pushes
 * the trajectory that owns the motion, and returns the motion without another reference. */
sw_motion *lsw_motion_make(lua_State *L, int index, const char *what, const lsw_motion_args *args);

/* Raises the error of a failed call that evaluated motions: for SW_ECALLBACK the
 * same value that the Lua function raised, else the text, as lsw_raise does. */
int lsw_motion_rethrow(lua_State *L, sw_status status, const sw_error *err);

/* For callbacks of other bindings: keeps the error value on top of L's stack (popped)
 * for lsw_motion_rethrow, and writes it as text to err. Returns SW_ECALLBACK; never raises. */
sw_status lsw_motion_keep_error(lua_State *L, sw_error *err);

/* As lua_call, for functions that the solver calls within a step; what is for messages. They cannot
 * yield, which Lua itself says in words of C. */
void lsw_motion_call(lua_State *L, int args, int results, const char *what);

/* Replaces the function on top of the stack by "file:line: " of its definition, or "" for a
 * function of C. Its results are read within a step, where no line of the script runs that could be
 * named. */
const char *lsw_motion_place(lua_State *L);

/* --- between the files of this binding ---------------------------------------- */

void lsw_motion_open_functions(lua_State *L);

/* Makes the motion of the Lua function at index: *out, with one reference. */
sw_status lsw_motion_function(lua_State *L, int index, const lsw_motion_args *args, sw_motion **out,
                              sw_error *err);

/* Keeps the function on top of the stack (popped) that reads way-points. It is called with
 * a `path`, a `scale` (or nil) and the object's name, and returns the array of way-points. */
void lsw_motion_keep_reader(lua_State *L);

void lsw_motion_open_arguments(void);

#endif
