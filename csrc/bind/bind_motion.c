/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The class `trajectory`. */
#include "bind/bind_motion.h"

#include <string.h>

#include "bind/child.h"

typedef struct trajectory {
  lsw_handle handle; /* object: sw_motion, one reference */
} trajectory;

static sw_motion *check(lua_State *L) {
  const trajectory *self = lsw_check(L, 1, &lsw_class_trajectory);
  return self->handle.object;
}

static void close_trajectory(lsw_handle *h) { sw_motion_release(h->object); }

/* --- at a time ------------------------------------------------------------------ */

/* Evaluates the motion of the trajectory at index 1. A Lua function may close its own trajectory:
 * the motion is retained meanwhile, and a further evaluation is an error. */
static void eval(lua_State *L, sw_motion *motion, double t, sw_motion_state *out) {
  sw_error err = {{0}};
  lsw_still_open(L);
  sw_motion_retain(motion);
  const sw_status status = sw_motion_eval(motion, t, out, &err);
  sw_motion_release(motion);
  if (status != SW_OK) lsw_motion_rethrow(L, status, &err);
}

static sw_motion_state state(lua_State *L) {
  sw_motion_state s;
  sw_motion *motion = check(L);
  eval(L, motion, lsw_number(L, 2, "trajectory: the time", "s"), &s);
  return s;
}

static int m_position(lua_State *L) { return lsw_push_vector(L, state(L).pose.p), 1; }
static int m_rotation(lua_State *L) { return lsw_push_quaternion(L, state(L).pose.q), 1; }
static int m_velocity(lua_State *L) { return lsw_push_vector(L, state(L).v), 1; }
static int m_acceleration(lua_State *L) { return lsw_push_vector(L, state(L).a), 1; }
static int m_angular_velocity(lua_State *L) { return lsw_push_vector(L, state(L).omega), 1; }
static int m_angular_acceleration(lua_State *L) { return lsw_push_vector(L, state(L).alpha), 1; }

/* --- as a whole ------------------------------------------------------------------- */

static int m_duration(lua_State *L) { return lua_pushnumber(L, sw_motion_duration(check(L))), 1; }
static int m_starts(lua_State *L) { return lua_pushnumber(L, sw_motion_start(check(L))), 1; }
static int m_ends(lua_State *L) { return lua_pushnumber(L, sw_motion_end(check(L))), 1; }

static int m_length(lua_State *L) {
  const double length = sw_motion_length(check(L));
  if (isnan(length)) return luaL_error(L, "trajectory: the path of a func has no known length");
  lua_pushnumber(L, length);
  return 1;
}

static int m_law(lua_State *L) { return lua_pushstring(L, sw_motion_law_name(check(L))), 1; }

static int m_relative(lua_State *L) {
  lua_pushboolean(L, sw_motion_is_relative(check(L)));
  return 1;
}

/* --- derived trajectories --------------------------------------------------------- */

static int open_view(lua_State *L, lsw_handle *h, sw_status status, sw_motion *motion) {
  if (status != SW_OK) return lsw_raise(L, status, NULL);
  h->object = motion;
  return 1;
}

/* placed(position, rotation): the trajectory applied to this pose as a displacement. */
static int m_placed(lua_State *L) {
  sw_motion *seen = NULL, *motion = check(L);
  sw_pose base;
  base.p = lsw_vector(L, 2, "trajectory: position to be displaced", "m");
  base.q = lsw_rotation(L, 3, "trajectory: rotation to be displaced");
  lsw_handle *h = lsw_new(L, &lsw_class_trajectory, 0);
  lsw_still_open(L);
  const sw_status status = sw_motion_relative(motion, base, &seen);
  return open_view(L, h, status, seen);
}

/* delayed(seconds): the same, later. */
static int m_delayed(lua_State *L) {
  sw_motion *seen = NULL, *motion = check(L);
  const double delay = lsw_number(L, 2, "trajectory: the delay", "s");
  lsw_handle *h = lsw_new(L, &lsw_class_trajectory, 0);
  lsw_still_open(L);
  const sw_status status = sw_motion_shifted(motion, delay, &seen);
  return open_view(L, h, status, seen);
}

/* --- bulk --------------------------------------------------------------------------- */

static const struct column {
  const char *name;
  size_t offset; /* in sw_motion_state [B] */
  int width;     /* numbers [-] */
} columns[] = {{"position", offsetof(sw_motion_state, pose.p), 3},
               {"rotation", offsetof(sw_motion_state, pose.q), 4},
               {"velocity", offsetof(sw_motion_state, v), 3},
               {"acceleration", offsetof(sw_motion_state, a), 3},
               {"angular_velocity", offsetof(sw_motion_state, omega), 3},
               {"angular_acceleration", offsetof(sw_motion_state, alpha), 3}};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static void store_row(lua_State *L, int first, lua_Integer i, const sw_motion_state *s) {
  for (int k = 0; k < COLUMNS; k++) {
    double values[4] = {0};
    const int width = columns[k].width;
    memcpy(values, (const char *)s + columns[k].offset, (size_t)width * sizeof *values);
    for (int j = 0; j < width; j++) {
      lua_pushnumber(L, values[j]);
      lua_rawseti(L, first + k, i * width + j + 1);
    }
  }
}

static double sample_end(lua_State *L, int index, double usual, const char *what) {
  if (!lua_isnoneornil(L, index)) return lsw_number(L, index, what, "s");
  if (!isfinite(usual))
    luaL_error(L,
               "trajectory: this trajectory has no end; sample(n, from, to) needs both times [s]");
  return usual;
}

/* sample(n, from, to): n states at evenly spaced times, as flat arrays by name. */
static int m_sample(lua_State *L) {
  sw_motion *motion = check(L);
  const double count = lsw_number(L, 2, "trajectory: the number of samples", "-");
  if (!(count >= 2 && count <= 1e7) || count != floor(count))
    return luaL_error(L, "trajectory: sample(%f): the number must be whole and in [2, 1e7]", count);
  const int n = (int)count;
  const double from = sample_end(L, 3, sw_motion_start(motion), "trajectory: the first time");
  const double to = sample_end(L, 4, sw_motion_end(motion), "trajectory: the last time");
  lua_settop(L, 4);
  lua_createtable(L, n, 0);
  for (int k = 0; k < COLUMNS; k++) lua_createtable(L, n * columns[k].width, 0);
  for (int i = 0; i < n; i++) {
    sw_motion_state s;
    const double t = i + 1 < n ? from + (to - from) * i / (n - 1) : to;
    eval(L, motion, t, &s);
    lua_pushnumber(L, t);
    lua_rawseti(L, 5, i + 1);
    store_row(L, 6, i, &s);
  }
  lua_createtable(L, 0, COLUMNS + 1);
  lua_insert(L, 5);
  for (int k = COLUMNS - 1; k >= 0; k--) lua_setfield(L, 5, columns[k].name);
  lua_setfield(L, 5, "t");
  return 1;
}

static int describe(lua_State *L) {
  const sw_motion *motion = check(L);
  const char *displaced = sw_motion_is_relative(motion) ? ", displacement" : "";
  const double duration = sw_motion_duration(motion);
  if (sw_motion_count(motion) == 0 && isfinite(duration))
    return lsw_say(L, "trajectory: a function of time for %.6g s%s", duration, displaced);
  if (sw_motion_count(motion) == 0)
    return lsw_say(L, "trajectory: a function of time%s", displaced);
  return lsw_say(L, "trajectory: %s, %zu way-points, %.6g m in %.6g s%s",
                 sw_motion_law_name(motion), sw_motion_count(motion), sw_motion_length(motion),
                 duration, displaced);
}

static const luaL_Reg methods[] = {{"position", m_position},
                                   {"rotation", m_rotation},
                                   {"velocity", m_velocity},
                                   {"acceleration", m_acceleration},
                                   {"angular_velocity", m_angular_velocity},
                                   {"angular_acceleration", m_angular_acceleration},
                                   {"duration", m_duration},
                                   {"starts", m_starts},
                                   {"ends", m_ends},
                                   {"length", m_length},
                                   {"law", m_law},
                                   {"relative", m_relative},
                                   {"placed", m_placed},
                                   {"delayed", m_delayed},
                                   {"sample", m_sample},
                                   {NULL, NULL}};

const lsw_class lsw_class_trajectory = {.name = "trajectory",
                                        .size = sizeof(trajectory),
                                        .methods = methods,
                                        .describe = describe,
                                        .close = close_trajectory,
                                        .gone = "the trajectory has been closed"};

/* --- the module's functions --------------------------------------------------------- */

/* trajectory(table | function | trajectory) */
static int f_trajectory(lua_State *L) {
  if (lua_isnoneornil(L, 1))
    return luaL_error(L, "trajectory: a table of parameters, a function or a trajectory is needed");
  lua_settop(L, 1);
  if (lsw_test(L, 1, &lsw_class_trajectory)) return 1;
  lsw_motion_args args;
  if (lua_isfunction(L, 1)) {
    lua_createtable(L, 0, 1);
    lua_insert(L, 1);
    lua_setfield(L, 1, "func");
  }
  lsw_arguments(L, 1, "trajectory", &lsw_motion_params, &args);
  lsw_motion_make(L, 1, "trajectory", &args);
  return 1;
}

/* trajectory_reader(function): sets the function that reads way-points from `path`. */
static int f_trajectory_reader(lua_State *L) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  lua_settop(L, 1);
  lsw_motion_keep_reader(L);
  return 0;
}

/* trajectory_parameters(): the rows of the table for a trajectory. */
static int f_trajectory_parameters(lua_State *L) {
  lsw_push_params(L, &lsw_motion_params);
  return 1;
}

const luaL_Reg lsw_module_motion[] = {{"trajectory", f_trajectory},
                                      {"trajectory_reader", f_trajectory_reader},
                                      {"trajectory_parameters", f_trajectory_parameters},
                                      {NULL, NULL}};
