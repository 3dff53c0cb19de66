/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the motion of a trajectory from its table. */
#include <string.h>

#include "bind/bind_motion.h"

static const char reader_key = 0;          /* registry: the function that reads `path` */
static const char *law_names[16] = {NULL}; /* filled when the module is opened */

#define AT(field) offsetof(lsw_motion_args, field)
#define OTHER(name, unit, doc) \
  { name, SW_PARAM_OTHER, unit, NAN, -INFINITY, INFINITY, 0, NULL, 0, doc }
#define POSITIVE(name, field, unit, doc) \
  { name, SW_PARAM_NUMBER, unit, NAN, 0, INFINITY, SW_PARAM_ABOVE_MIN, NULL, AT(field), doc }

static const sw_param rows[] = {
    OTHER(
        "points", "m",
        "way-points: {x,y,z} or {x=,y=,z=}, each optionally with t [s] and with rotation or turn"),
    OTHER("times", "s", "a time for every way-point, instead of t in each way-point"),
    OTHER("path", "-", "a CSV file of way-points, or the way-points themselves"),
    OTHER("scale", "m", "length unit of a CSV file whose columns name no unit"),
    OTHER("func", "-",
          "function(t) returning position [m] and optionally rotation, instead of points"),
    OTHER(
        "turn", "rad",
        "{axis=, angle=}: turn over the whole path, any number of revolutions; without way-points "
        "in place"),
    OTHER("about", "m",
          "centre of the turns, {x,y,z}: what moves goes round it; way-points, which are relative "
          "then, displace it; default: the place of the object itself"),
    {"law", SW_PARAM_CHOICE, "-", -1, -INFINITY, INFINITY, 0, law_names, AT(law),
     "law of progress; default minimum-jerk, with three or more timed way-points spline"},
    POSITIVE("speed", speed, "m/s", "highest speed along the path; never exceeded"),
    POSITIVE("angular_speed", angular_speed, "rad/s", "highest speed of turning; never exceeded"),
    POSITIVE("acceleration", acceleration, "m/s2",
             "highest acceleration along the path; default: as the law needs"),
    POSITIVE("angular_acceleration", angular_acceleration, "rad/s2",
             "highest angular acceleration along the path"),
    POSITIVE("duration", duration, "s", "time for the whole path, instead of speeds"),
    {"blend", SW_PARAM_NUMBER, "m", NAN, 0, INFINITY, 0, NULL, AT(blend),
     "corners are rounded from this distance before them, at most half a leg; default a tenth of "
     "the shorter leg, linear 0"},
    {"stop", SW_PARAM_BOOLEAN, "-", -1, -INFINITY, INFINITY, 0, NULL, AT(stop),
     "true: stop at every way-point; default: only where the path turns back by more than 120 deg "
     "and no blend is given"},
    {"start", SW_PARAM_NUMBER, "s", 0, -INFINITY, INFINITY, 0, NULL, AT(start),
     "time when the move begins; it is added to the times of the way-points"},
    {"relative", SW_PARAM_BOOLEAN, "-", 0, -INFINITY, INFINITY, 0, NULL, AT(relative),
     "true: way-points are displacements, in world axes, from the place of the object at the "
     "start"},
    {"step", SW_PARAM_NUMBER, "s", 1e-4, 0, 1, SW_PARAM_ABOVE_MIN, NULL, AT(step),
     "time step of the differences from which velocity and acceleration of func are computed"},
};

const sw_params lsw_motion_params = SW_PARAMS("trajectory", rows);

void lsw_motion_open_arguments(void) {
  const size_t most = sizeof law_names / sizeof law_names[0] - 1;
  for (size_t i = 0; i < most; i++) law_names[i] = sw_motion_law_at(i);
}

void lsw_motion_keep_reader(lua_State *L) { lua_rawsetp(L, LUA_REGISTRYINDEX, &reader_key); }

/* --- way-points --------------------------------------------------------------- */

static void check_keys(lua_State *L, int index, const char *what) {
  static const char *const known[] = {"x", "y", "z", "t", "rotation", "turn"};
  lsw_only(L, index, what, known, sizeof known / sizeof known[0]);
}

/* Returns the turn {axis=, angle=} on top of the stack, as axis times angle [rad]. */
static sw_vec read_turn(lua_State *L, const char *what) {
  const int index = lua_gettop(L);
  if (!lua_istable(L, index)) {
    luaL_error(L, "%s must be {axis = {x,y,z}, angle = [rad]}, got %s", what,
               luaL_typename(L, index));
    return sw_v(0, 0, 0);
  }
  return lsw_turn(L, index, what);
}

/* Reads the way-point on top of the stack. */
static void read_point(lua_State *L, const char *what, sw_waypoint *out) {
  const int index = lua_gettop(L);
  *out = (sw_waypoint){.q = sw_quat_identity(), .t = NAN};
  if (!lua_istable(L, index))
    luaL_error(L, "%s must be a table {x, y, z} [m], got %s", what, luaL_typename(L, index));
  check_keys(L, index, what);
  out->p = lsw_place_in(L, index, what);
  if (lua_getfield(L, index, "t") != LUA_TNIL)
    out->t = lsw_number(L, -2, lua_pushfstring(L, "%s: t", what), "s");
  if (lua_getfield(L, index, "rotation") != LUA_TNIL) {
    out->facing = SW_FACING_GIVEN;
    out->q = lsw_rotation(L, -2, lua_pushfstring(L, "%s: rotation", what));
  }
  lua_settop(L, index);
  if (lua_getfield(L, index, "turn") != LUA_TNIL) {
    if (out->facing == SW_FACING_GIVEN) luaL_error(L, "%s: give rotation or turn, not both", what);
    out->facing = SW_FACING_TURNED;
    lua_pushfstring(L, "%s: turn", what);
    lua_insert(L, -2);
    out->turn = read_turn(L, lua_tostring(L, -2));
  }
  lua_settop(L, index);
}

static void read_times(lua_State *L, int table, const char *what, sw_waypoint *points,
                       size_t count) {
  if (lua_getfield(L, table, "times") == LUA_TNIL) {
    lua_pop(L, 1);
    return;
  }
  if (!lua_istable(L, -1))
    luaL_error(L, "%s: times must be an array of numbers [s], got %s", what, luaL_typename(L, -1));
  lsw_only_items(L, -2, lua_pushfstring(L, "%s: times", what));
  lua_pop(L, 1);
  if (lua_rawlen(L, -1) != count)
    luaL_error(L, "%s: times must have one entry per way-point, %d in all, got %d", what,
               (int)count, (int)lua_rawlen(L, -1));
  for (size_t i = 0; i < count; i++) {
    lua_rawgeti(L, -1, (lua_Integer)i + 1);
    const char *name = lua_pushfstring(L, "%s: times[%d]", what, (int)i + 1);
    if (!isnan(points[i].t)) luaL_error(L, "%s: way-point %d also has t", name, (int)i + 1);
    points[i].t = lsw_number(L, -2, name, "s");
    lua_pop(L, 2);
  }
  lua_pop(L, 1);
}

/* Pushes the way-points: `points`, or the ones read from `path`; nil without both. */
static void push_points(lua_State *L, int table, const char *what) {
  const int given = lua_getfield(L, table, "points") != LUA_TNIL;
  if (lua_getfield(L, table, "path") == LUA_TNIL) {
    lua_pop(L, 1);
    return;
  }
  if (given) luaL_error(L, "%s: give points or path, not both", what);
  lua_remove(L, -2);
  if (lua_istable(L, -1)) return;
  if (lua_isfunction(L, -1))
    luaL_error(L, "%s: path is a file or way-points; give a function of time as func", what);
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &reader_key) == LUA_TNIL)
    luaL_error(L, "%s: path needs the module softworld.trajectory to be loaded", what);
  lua_insert(L, -2);
  lua_getfield(L, table, "scale");
  lua_pushstring(L, what);
  lua_call(L, 3, 1);
}

static void has_no_use(lua_State *L, int table, const char *what, const char *key,
                       const char *without) {
  if (lua_getfield(L, table, key) != LUA_TNIL)
    luaL_error(L, "%s: %s has no use without %s", what, key, without);
  lua_pop(L, 1);
}

static sw_status make_path(lua_State *L, int table, const char *what, const lsw_motion_args *args,
                           sw_motion **out, sw_error *err) {
  sw_motion_plan plan = sw_motion_plan_empty();
  if (lua_getfield(L, table, "path") != LUA_TSTRING)
    has_no_use(L, table, what, "scale", "a path that names a file");
  has_no_use(L, table, what, "step", "func");
  push_points(L, table, what);
  const int array = lua_gettop(L);
  if (!lua_istable(L, array) && !lua_isnil(L, array))
    luaL_error(L, "%s: points must be an array of way-points {x,y,z}, got %s", what,
               luaL_typename(L, array));
  if (lua_istable(L, array)) lsw_only_items(L, array, lua_pushfstring(L, "%s: points", what));
  lua_settop(L, array);
  plan.count = lua_istable(L, array) ? lua_rawlen(L, array) : 0;
  sw_waypoint *points = lua_newuserdatauv(L, (plan.count + 1) * sizeof *points, 0);
  for (size_t i = 0; i < plan.count; i++) {
    lua_pushfstring(L, "%s: way-point %d", what, (int)i + 1);
    lua_geti(L, array, (lua_Integer)i + 1);
    read_point(L, lua_tostring(L, -2), &points[i]);
    lua_pop(L, 2);
  }
  read_times(L, table, what, points, plan.count);
  lua_pushfstring(L, "%s: turn", what);
  if (lua_getfield(L, table, "turn") != LUA_TNIL) plan.turn = read_turn(L, lua_tostring(L, -2));
  plan.name = what;
  plan.points = points;
  plan.law = args->law < 0 ? NULL : law_names[args->law];
  plan.speed = args->speed, plan.angular_speed = args->angular_speed;
  plan.acceleration = args->acceleration, plan.angular_acceleration = args->angular_acceleration;
  plan.duration = args->duration, plan.blend = args->blend, plan.stop = args->stop;
  plan.start = args->start, plan.relative = args->relative;
  lua_pushfstring(L, "%s: about", what);
  plan.about = lua_getfield(L, table, "about") != LUA_TNIL;
  if (plan.about) plan.centre = lsw_place(L, -1, lua_tostring(L, -2));
  if (plan.count == 0 && sw_norm(plan.turn) > 0) plan.relative = 1; /* a turn in place */
  return sw_motion_create(&plan, out, err);
}

/* Raises if a key for way-points is given with a func. */
static void check_func(lua_State *L, int table, const char *what) {
  static const char *const theirs[] = {"points",
                                       "path",
                                       "times",
                                       "scale",
                                       "turn",
                                       "about",
                                       "law",
                                       "speed",
                                       "angular_speed",
                                       "acceleration",
                                       "angular_acceleration",
                                       "blend",
                                       "stop"};
  if (!lua_isfunction(L, -1))
    luaL_error(L, "%s: func must be a function of time [s], got %s", what, luaL_typename(L, -1));
  for (size_t i = 0; i < sizeof theirs / sizeof theirs[0]; i++) {
    if (lua_getfield(L, table, theirs[i]) != LUA_TNIL)
      luaL_error(L, "%s: %s has no use with func, which gives the place at any time", what,
                 theirs[i]);
    lua_pop(L, 1);
  }
}

sw_motion *lsw_motion_make(lua_State *L, int index, const char *what, const lsw_motion_args *args) {
  sw_error err = {{0}};
  sw_motion *motion = NULL;
  sw_status status;
  index = lua_absindex(L, index);
  luaL_checkstack(L, 16, what);
  lsw_handle *h = lsw_new(L, &lsw_class_trajectory, 0);
  const int own = lua_gettop(L);
  if (lua_getfield(L, index, "func") != LUA_TNIL) {
    check_func(L, index, what);
    status = lsw_motion_function(L, -1, args, &motion, &err);
  } else {
    status = make_path(L, index, what, args, &motion, &err);
  }
  if (status != SW_OK) lsw_motion_rethrow(L, status, &err);
  h->object = motion;
  lua_settop(L, own);
  return motion;
}

sw_motion *lsw_motion_from(lua_State *L, int index, const char *what) {
  lsw_motion_args args;
  index = lua_absindex(L, index);
  if (lsw_test(L, index, &lsw_class_trajectory)) {
    const lsw_handle *h = lsw_check(L, index, &lsw_class_trajectory);
    return sw_motion_retain(h->object);
  }
  if (lua_isfunction(L, index)) {
    lua_createtable(L, 0, 1);
    lua_pushvalue(L, index);
    lua_setfield(L, -2, "func");
  } else if (lua_istable(L, index)) {
    lua_pushvalue(L, index);
  } else {
    luaL_error(L, "%s takes a trajectory, the table for one or a function of time, got %s", what,
               luaL_typename(L, index));
  }
  lsw_arguments(L, -1, what, &lsw_motion_params, &args);
  sw_motion *motion = sw_motion_retain(lsw_motion_make(L, -1, what, &args));
  lua_pop(L, 2);
  return motion;
}
