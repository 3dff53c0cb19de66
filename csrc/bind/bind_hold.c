/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class clamp (clamps, pins, grips and feeds) and scene:clamp, pin, grip, feed. */
#include <limits.h>
#include <string.h>

#include "bind/child.h"
#include "bind/share.h"

/* scene:clamp, pin, ...: adds a hold of the class that is the upvalue. */
static int new_hold(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  const sw_link_class *cls = lua_touserdata(L, lua_upvalueindex(1));
  const char *kind = cls->name;
  sw_hold_args args = {.s = 0,
                       .direction = {NAN, NAN, NAN},
                       .line = {NAN, NAN, NAN},
                       .speed = NAN,
                       .force = NAN,
                       .force_limit = NAN};
  if (lsw_test(L, 2, &lsw_class_particles)) {
    if (strcmp(kind, "clamp") == 0) return lsw_hold_particles(L);
    return luaL_error(L, "scene:%s goes with wires; for particles use scene:hold", kind);
  }
  const char *what = lua_pushfstring(L, "scene:%s", kind);
  const sw_handle wire = lsw_check_child_of(L, 2, &lsw_class_wire, scene,
                                            lua_pushfstring(L, "%s: the first argument", what));
  lsw_arguments(L, 3, what, &cls->params, &args);
  if (lua_istable(L, 3)) args.points = lsw_read_points(L, 3, "path", kind, &args.count);
  lsw_child *child = lsw_new_child(L, &lsw_class_clamp);
  LSW_DO(L, sw_scene_add_hold, scene, cls, wire, &args, &child->id);
  return 1;
}

void lsw_add_holds(lua_State *L) {
  for (int i = 0; sw_link_all()[i]; i++) {
    if (!sw_link_all()[i]->hold) continue;
    lua_pushlightuserdata(L, (void *)sw_link_all()[i]);
    lua_pushcclosure(L, new_hold, 1);
    lua_setfield(L, -2, sw_link_all()[i]->name);
  }
}

static lsw_load load_of(lua_State *L, int with_point) {
  lsw_load on;
  sw_vec point = sw_v(NAN, NAN, NAN);
  static const sw_param rows[] = {
      {"at", SW_PARAM_VECTOR, "m", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, 0,
       "point about which the moment is taken (default: the held point)"}};
  static const sw_params params = SW_PARAMS("clamp", rows);
  const lsw_self c = lsw_check_self(L, &lsw_class_clamp);
  if (with_point) lsw_arguments(L, 2, "clamp:moment", &params, &point);
  const sw_vec *at = isnan(point.x) ? NULL : &point;
  LSW_DO(L, sw_scene_hold_force, c.scene, c.id, at, &on.force, &on.moment);
  return on;
}

/* clamp:force() on the wire [N]; clamp:moment([{ at = point }]) about the held point or this point
 * [N m]. */
static int meth_force(lua_State *L) { return lsw_push_vector(L, load_of(L, 0).force), 1; }
static int meth_moment(lua_State *L) { return lsw_push_vector(L, load_of(L, 1).moment), 1; }

/* clamp:pose() -> position, rotation; clamp:pose(position [, rotation]) sets them.
 * Without a rotation the present one stays. */
static int meth_pose(lua_State *L) { return lsw_pose(L, &lsw_class_clamp); }

/* clamp:follow(trajectory or its table); clamp:follow(nil) stops the clamp where it is. */
static int meth_follow(lua_State *L) { return lsw_follow(L, &lsw_class_clamp, "clamp:follow"); }

static int meth_release(lua_State *L) {
  return lsw_order(L, &lsw_class_clamp, sw_scene_release_hold);
}

/* clamp:crash() -> { time [s], depth [m], obstacle } of the last time that the clamp drove the wire
 * into an obstacle; nothing if it never did */
static int meth_crash(lua_State *L) {
  double time, depth;
  const char *obstacle;
  const lsw_self c = lsw_check_self(L, &lsw_class_clamp);
  LSW_DO(L, sw_scene_hold_crash, c.scene, c.id, &time, &depth, &obstacle);
  if (!(depth > 0)) return 0;
  lsw_quiet(L);
  lua_createtable(L, 0, 3);
  lsw_set_number(L, "time", time);
  lsw_set_number(L, "depth", depth);
  lsw_set_text(L, "obstacle", obstacle);
  return 1;
}

/* Pushes width columns of a log's rows, starting at column from, as one flat list. */
static void push_columns(lua_State *L, const double *rows, size_t count, size_t from,
                         size_t width) {
  lua_createtable(L, count * width < INT_MAX ? (int)(count * width) : 0, 0);
  for (size_t i = 0; i < count * width; i++)
    lsw_put_number(L, i, rows[i / width * SW_LOG_SIZE + from + i % width]);
}

/* clamp:log(t1, t2) -> flat rows of 10: t, force, moment, point [s, N, N m, m]; number of rows; for
 * each row a span [s]. Span above 0: the force is the mean over this time up to t; below 0: the
 * force at the end of a step of this length; 0: an equilibrium. See lsw_log_rows. */
static int meth_log(lua_State *L) {
  const double *rows;
  const size_t n = lsw_log_rows(L, &lsw_class_clamp, SW_LOG_SIZE, &rows);
  push_columns(L, rows, n, 0, SW_LOG_SPAN);
  lua_pushinteger(L, (lua_Integer)n);
  push_columns(L, rows, n, SW_LOG_SPAN, 1);
  return 3;
}

/* clamp:get() -> a table of its present parameters */
static int meth_get(lua_State *L) {
  sw_hold_args args;
  const sw_params *rows;
  const lsw_self c = lsw_check_self(L, &lsw_class_clamp);
  LSW_DO(L, sw_scene_hold_args, c.scene, c.id, &rows, &args);
  lsw_push_values(L, rows, &args);
  return 1;
}

/* clamp:set{ friction = }: changes its parameters. */
static int meth_set(lua_State *L) {
  sw_hold_args args;
  const sw_params *rows;
  const lsw_self c = lsw_check_self(L, &lsw_class_clamp);
  lua_settop(L, 2);
  LSW_DO(L, sw_scene_editable, c.scene);
  LSW_DO(L, sw_scene_hold_args, c.scene, c.id, &rows, &args);
  lsw_changes(L, 2, lua_pushfstring(L, "%s:set", rows->object), rows, &args);
  LSW_DO(L, sw_scene_set_hold, c.scene, c.id, &args);
  return 0;
}

/* --- read-outs of some kinds ---------------------------------------------------- */

static int reading(lua_State *L, const char *name) {
  double value;
  const lsw_self c = lsw_check_self(L, &lsw_class_clamp);
  LSW_DO(L, sw_scene_read_hold, c.scene, c.id, name, &value);
  if (isnan(value))
    lua_pushnil(L);
  else
    lua_pushnumber(L, value);
  return 1;
}

/* clamp:read() -> all read-outs of its kind, by name; see the file of the kind */
static int meth_read(lua_State *L) {
  const lsw_self c = lsw_check_self(L, &lsw_class_clamp);
  const char *const *names;
  LSW_DO(L, sw_scene_hold_outputs, c.scene, c.id, &names);
  lua_newtable(L);
  for (; names && *names; names++) {
    reading(L, *names);
    lua_setfield(L, -2, *names);
  }
  return 1;
}

/* slider:place() -> place along the rail [m], speed [m/s], force on the wire along the rail [N] */
static int meth_place(lua_State *L) {
  return reading(L, "place") + reading(L, "speed") + reading(L, "force");
}

/* Length of wire paid out so far, unstressed [m]. */
static int meth_fed(lua_State *L) { return reading(L, "fed"); }

/* Force that moves the wire outwards [N]; the guide's walls bear the rest of force(). */
static int meth_drive_force(lua_State *L) { return reading(L, "drive_force"); }

/* --- feeds ---------------------------------------------------------------------- */

/* Returns the argument at 2, checked like the parameter `name` of scene:feed. */
static double feed_argument(lua_State *L, const char *name) {
  sw_error err;
  const sw_params *rows = &sw_link_find("feed")->params;
  size_t i = 0;
  while (i + 1 < rows->count && strcmp(rows->rows[i].name, name) != 0) i++;
  const sw_param *row = &rows->rows[i];
  const double value = lsw_number(L, 2, lua_pushfstring(L, "feed:%s", name), row->unit);
  if (sw_param_check("feed", row, value, &err) != SW_OK) luaL_error(L, "%s", err.text);
  return value;
}

/* Gives an order with the argument at 2, checked like the parameter `row` of scene:feed.
 * may_be_nil: nil is allowed and gives NAN (none). */
static int order_feed(lua_State *L, const char *order, const char *row, int may_be_nil) {
  const lsw_self c = lsw_check_self(L, &lsw_class_clamp);
  const double value = may_be_nil && lua_isnil(L, 2) ? (double)NAN : feed_argument(L, row);
  LSW_DO(L, sw_scene_order_hold, c.scene, c.id, order, value, NULL);
  return 0;
}

/* feed:speed() -> present speed; feed:speed(v) sets it [m/s]. */
static int meth_speed(lua_State *L) {
  return lua_gettop(L) > 1 ? order_feed(L, "speed", "speed", 0) : reading(L, "speed");
}

/* feed:push(force): feeds with this force instead of a speed [N]. */
static int meth_push(lua_State *L) { return order_feed(L, "push", "force", 0); }

/* feed:force_limit() -> the limit or nil; feed:force_limit(force) sets it, (nil) removes it [N]. */
static int meth_force_limit(lua_State *L) {
  return lua_gettop(L) > 1 ? order_feed(L, "force_limit", "force_limit", 1)
                           : reading(L, "force_limit");
}

typedef struct length_args {
  double length;                        /* [m] */
  double speed, duration, acceleration; /* NAN = not given [m/s], [s], [m/s2] */
  char law[SW_NAME_SIZE];
} length_args;

static const sw_param length_rows[] = {
    {"length", SW_PARAM_NUMBER, "m", NAN, -1e6, 1e6, SW_PARAM_REQUIRED, NULL,
     offsetof(length_args, length), "length to pay out; below 0: to draw in"},
    {"speed", SW_PARAM_NUMBER, "m/s", NAN, 0, 1e4, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(length_args, speed), "highest speed"},
    {"duration", SW_PARAM_NUMBER, "s", NAN, 0, 1e9, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(length_args, duration), "instead of the speed"},
    {"acceleration", SW_PARAM_NUMBER, "m/s2", NAN, 0, 1e6, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(length_args, acceleration), "highest acceleration"},
    {"law", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(length_args, law),
     "law of the motion, as in a trajectory (default 'minimum-jerk')"},
};
static const sw_params length_params = SW_PARAMS("feed:feed", length_rows);

/* feed:feed{ length =, speed = or duration = } -> time that it will take [s]. */
static int meth_feed(lua_State *L) {
  sw_error err = {""};
  sw_motion *motion = NULL;
  length_args a = {.speed = NAN, .duration = NAN, .acceleration = NAN};
  const lsw_self c = lsw_check_self(L, &lsw_class_clamp);
  lsw_arguments(L, 2, "feed:feed", &length_params, &a);
  lsw_still_open(L);
  const sw_waypoint points[2] = {{.t = NAN}, {.p = {a.length, 0, 0}, .t = NAN}};
  sw_motion_plan plan = sw_motion_plan_empty();
  plan.name = "feed:feed", plan.law = a.law[0] ? a.law : NULL;
  plan.points = points, plan.count = 2;
  plan.speed = a.speed, plan.duration = a.duration, plan.acceleration = a.acceleration;
  if (a.length != 0) LSW_DO(L, sw_motion_create, &plan, &motion);
  const sw_status status = sw_scene_order_hold(c.scene, c.id, "length", a.length, motion, &err);
  lua_pushnumber(L, motion ? sw_motion_end(motion) : 0.0);
  sw_motion_release(motion);
  lsw_must(L, status, &err);
  return 1;
}

/* --- the class ------------------------------------------------------------------ */

static int describe(lua_State *L) {
  lsw_self c;
  sw_error err;
  sw_vec force, moment;
  if (!lsw_find_self(L, &lsw_class_clamp, &c)) return 1;
  const sw_identity is = sw_scene_identify(c.scene, SW_OF_HOLD, c.id);
  if (!is.name) return lsw_say_taken_back(L, &lsw_class_clamp);
  if (!is.alive) return lsw_say(L, "%s '%s' (released)", is.kind, is.name);
  if (sw_scene_hold_force(c.scene, c.id, NULL, &force, &moment, &err) != SW_OK)
    return lsw_say(L, "%s '%s'", is.kind, is.name);
  return lsw_say(L, "%s '%s': force on the wire (%.4g, %.4g, %.4g) N", is.kind, is.name, force.x,
                 force.y, force.z);
}

static const char *word_of(lua_State *L) {
  lsw_self c;
  return lsw_find_self(L, &lsw_class_clamp, &c) ? sw_scene_identify(c.scene, SW_OF_HOLD, c.id).kind
                                                : NULL;
}

static const luaL_Reg methods[] = {{"force", meth_force},
                                   {"moment", meth_moment},
                                   {"pose", meth_pose},
                                   {"follow", meth_follow},
                                   {"release", meth_release},
                                   {"log", meth_log},
                                   {"crash", meth_crash},
                                   {"get", meth_get},
                                   {"set", meth_set},
                                   {"read", meth_read},
                                   {"place", meth_place},
                                   {"fed", meth_fed},
                                   {"feed", meth_feed},
                                   {"speed", meth_speed},
                                   {"push", meth_push},
                                   {"force_limit", meth_force_limit},
                                   {"drive_force", meth_drive_force},
                                   {NULL, NULL}};

static const luaL_Reg properties[] = {
    {"name", lsw_prop_name}, {"kind", lsw_prop_kind}, {"held", lsw_prop_alive}, {NULL, NULL}};

const lsw_class lsw_class_clamp = {.name = "clamp",
                                   .kind = SW_OF_HOLD,
                                   .size = sizeof(lsw_child),
                                   .methods = methods,
                                   .describe = describe,
                                   .properties = properties,
                                   .gone = "this clamp was never made",
                                   .word = word_of};
