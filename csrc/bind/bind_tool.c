/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class tool and scene:tool: a gripper's frame, jaws and pads (see grip/tool.h). Users call it
 * through scene:gripper. */
#include <math.h>

#include "bind/child.h"
#include "bind/share.h"

static const sw_param rows[] = {
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_tool_args, name),
     "name used in messages"},
    {"at", SW_PARAM_VECTOR, "m", 0, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(sw_tool_args, at),
     "centre"},
    {"rotation", SW_PARAM_ROTATION, "rad", 0, 0, 0, 0, NULL, offsetof(sw_tool_args, rotation),
     "orientation"},
    {"opening", SW_PARAM_NUMBER, "m", 0, 0, 1e3, 0, NULL, offsetof(sw_tool_args, opening),
     "between facing pads"},
};
static const sw_params tool_params = SW_PARAMS("scene:tool", rows);

int lsw_scene_tool(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_tool_args args;
  lua_settop(L, 2);
  lsw_child *child = lsw_new_child(L, &lsw_class_tool);
  lsw_arguments(L, 2, "scene:tool", &tool_params, &args);
  LSW_DO(L, sw_scene_add_tool, scene, &args, &child->id);
  return 1;
}

static lsw_self check(lua_State *L) { return lsw_check_self(L, &lsw_class_tool); }

/* tool:pad(obstacle, finger, opens): attaches the obstacle to the tool, as a pad of this finger
 * (from 1; 0: another part of the tool). opens: its move in the tool's axes per opening [m/m]. */
static int meth_pad(lua_State *L) {
  const lsw_self t = check(L);
  const sw_handle o = lsw_check_child_of(L, 2, &lsw_class_obstacle, t.scene, "tool:pad: obstacle");
  const lua_Integer finger = lsw_integer(L, 3, "tool: the number of the finger");
  luaL_argcheck(L, finger >= 0 && finger <= SW_TOOL_PADS, 3, "finger out of range");
  const sw_vec opens = lsw_vector(L, 4, "tool:pad: opens", "-");
  LSW_DO(L, sw_scene_tool_pad, t.scene, t.id, o, (int)finger - 1, opens);
  return 0;
}

static int meth_hold(lua_State *L) {
  const lsw_self t = check(L);
  const sw_handle h = lsw_check_child_of(L, 2, &lsw_class_clamp, t.scene, "tool:hold: clamp");
  LSW_DO(L, sw_scene_tool_hold, t.scene, t.id, h);
  return 0;
}

/* tool:take(clamp): takes over the place and motion of a clamp, which goes on with the tool. */
static int meth_take(lua_State *L) {
  const lsw_self t = check(L);
  const sw_handle h = lsw_check_child_of(L, 2, &lsw_class_clamp, t.scene, "tool:take: clamp");
  LSW_DO(L, sw_scene_tool_take, t.scene, t.id, h);
  return 0;
}

static int meth_pads_on(lua_State *L) {
  const lsw_self t = check(L);
  if (!lua_isboolean(L, 2))
    luaL_error(L, "tool:pads_on must be true or false, got %s", lsw_describe(L, 2));
  LSW_DO(L, sw_scene_tool_pads_on, t.scene, t.id, lua_toboolean(L, 2));
  return 0;
}

static int meth_follow(lua_State *L) { return lsw_follow(L, &lsw_class_tool, "gripper:move"); }

static int meth_pose(lua_State *L) { return lsw_pose(L, &lsw_class_tool); }

static const char *const modes[] = {"still", "to", "force", NULL};
static const sw_param jaw_rows[] = {
    {"mode", SW_PARAM_CHOICE, "-", 0, 0, 0, SW_PARAM_REQUIRED, modes, offsetof(sw_jaw_args, mode),
     "still: keep the opening; to: go to an opening; force: close to a force and keep it"},
    {"opening", SW_PARAM_NUMBER, "m", 0, 0, 1e3, 0, NULL, offsetof(sw_jaw_args, opening),
     "to go to"},
    {"speed", SW_PARAM_NUMBER, "m/s", 0, 0, 1e3, 0, NULL, offsetof(sw_jaw_args, speed),
     "highest, of the opening"},
    {"force", SW_PARAM_NUMBER, "N", HUGE_VAL, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_jaw_args, force), "force per finger: wanted, or that at which the jaws stop"},
};
static const sw_params jaw_params = SW_PARAMS("tool:jaws", jaw_rows);

static int meth_jaws(lua_State *L) {
  sw_jaw_args args;
  const lsw_self t = check(L);
  lsw_arguments(L, 2, "tool:jaws", &jaw_params, &args);
  LSW_DO(L, sw_scene_tool_jaws, t.scene, t.id, &args);
  return 0;
}

/* tool:watch(slip [m], stops): a larger slip is an event; stops = true: it ends the run. */
static int meth_watch(lua_State *L) {
  const lsw_self t = check(L);
  const double slip = lsw_number(L, 2, "tool:watch: slip", "m");
  LSW_DO(L, sw_scene_tool_watch, t.scene, t.id, slip, lua_toboolean(L, 3));
  return 0;
}

static const char *const statuses[] = {"rests", "moves", "holds", "stopped", "empty"};

/* tool:state() -> { opening, jaws, squeeze, normal, most, margin, sliding, slip, slipped,
 * turned, place, frozen }; lost_time if the grip was lost; crash_... after a crash; slip_time and
 * slip_place if it slipped. */
static int meth_state(lua_State *L) {
  sw_tool_state now;
  const lsw_self t = check(L);
  LSW_DO(L, sw_scene_tool_state, t.scene, t.id, &now);
  lsw_quiet(L);
  lua_createtable(L, 0, 13);
  lsw_set_text(L, "jaws", statuses[now.status]);
  lsw_set_number(L, "opening", now.opening);
  lsw_set_number(L, "squeeze", now.squeeze);
  lsw_set_number(L, "normal", now.normal);
  lsw_set_number(L, "most", now.most);
  lsw_set_number(L, "margin", now.margin);
  lsw_set_number(L, "sliding", now.sliding);
  lsw_set_number(L, "slip", now.slip);
  lsw_set_vector(L, "slipped", now.slipped);
  lsw_set_vector(L, "turned", now.turned);
  lsw_set_number(L, "place", now.place);
  lsw_set_flag(L, "frozen", now.frozen);
  lsw_set_known(L, "lost_time", now.lost_time);
  if (!isnan(now.crash_time)) {
    lsw_set_number(L, "crash_time", now.crash_time);
    lsw_set_number(L, "crash_depth", now.crash_depth);
    lsw_set_text(L, "crash_part", now.crash_part);
    lsw_set_text(L, "crash_obstacle", now.crash_obstacle);
  }
  lsw_set_known(L, "slip_time", now.slip_time);
  if (!isnan(now.slip_time)) lsw_set_number(L, "slip_place", now.slip_place);
  return 1;
}

/* tool:force([finger]), tool:moment([point [, finger]]): load on wires [N], [N m]. */
static lsw_load load_of(lua_State *L, int point, int finger) {
  lsw_load on;
  sw_vec about;
  const lsw_self t = check(L);
  const sw_vec *at = NULL;
  if (point && !lua_isnoneornil(L, point)) {
    about = lsw_vector(L, point, "gripper:moment: at", "m");
    at = &about;
  }
  if (lua_isnoneornil(L, finger)) {
    LSW_DO(L, sw_scene_tool_force, t.scene, t.id, at, &on.force, &on.moment);
    return on;
  }
  const int k = (int)lsw_integer(L, finger, "tool: the number of the finger") - 1;
  LSW_DO(L, sw_scene_tool_finger, t.scene, t.id, k, at, &on.force, &on.moment);
  return on;
}

static int meth_force(lua_State *L) { return lsw_push_vector(L, load_of(L, 0, 2).force), 1; }
static int meth_moment(lua_State *L) { return lsw_push_vector(L, load_of(L, 2, 3).moment), 1; }

/* tool:log() -> flat rows of 15: t, force, moment, centre, span, opening, squeeze, margin, slip;
 * number of rows. span [s] above 0: the force is the mean over this time up to t; below 0: the
 * force at the end of a step of this length; 0: an equilibrium. */
static int meth_log(lua_State *L) { return lsw_log(L, &lsw_class_tool, SW_LOG_TOOL_SIZE); }

/* tool:touches() -> { { finger, at (on the pad), acts (where the force acts), force (all three in
 * the tool's axes), normal, s, slid, wire = number in frames from 0, wire_name }, ... } */
static int meth_touches(lua_State *L) {
  size_t count;
  lua_Integer found = 0;
  const lsw_self t = check(L);
  LSW_DO(L, sw_scene_tool_touches, t.scene, t.id, &count);
  lsw_quiet(L);
  lua_newtable(L);
  for (size_t k = 0; k < count; k++) {
    sw_tool_touch touch;
    if (!sw_scene_tool_touch(t.scene, t.id, k, &touch)) continue;
    lua_createtable(L, 0, 9);
    lsw_set_text(L, "wire_name", touch.name);
    lsw_set_integer(L, "finger", (size_t)touch.finger + 1);
    lsw_set_vector(L, "at", touch.at);
    lsw_set_vector(L, "acts", touch.acts);
    lsw_set_vector(L, "force", touch.force);
    lsw_set_number(L, "normal", touch.normal);
    lsw_set_number(L, "s", touch.s);
    lsw_set_number(L, "slid", touch.slid);
    lsw_set_integer(L, "wire", touch.wire);
    lua_rawseti(L, -2, ++found);
  }
  return 1;
}

static int push_report(lua_State *L, const sw_freeze_report *r) {
  lua_createtable(L, 0, 8);
  lsw_set_number(L, "s1", r->s1);
  lsw_set_number(L, "s2", r->s2);
  lsw_set_number(L, "energy_before", r->energy_before);
  lsw_set_number(L, "energy_after", r->energy_after);
  lsw_set_vector(L, "force", r->force);
  lsw_set_vector(L, "moment", r->moment);
  lsw_set_momentum(L, "before", r->before);
  lsw_set_momentum(L, "after", r->after);
  if (r->on_rod) lsw_set_text(L, "on", "rod");
  return 1;
}

static const char *const after_thaw[] = {"holds", "opens", "leaves", NULL}; /* see sw_thaw */

/* tool:freeze(wire), tool:thaw([then]) -> { s1, s2 [m], energy_before, energy_after [J], force [N]
 * and moment [N m] of the tool before the change, before, after = momentum { linear, angular }, on
 * = "rod" if the pads press on a rod after a thaw } */
static int meth_freeze(lua_State *L) {
  sw_freeze_report r;
  const lsw_self t = check(L);
  const sw_handle w = lsw_check_child_of(L, 2, &lsw_class_wire, t.scene, "tool:freeze: wire");
  LSW_DO(L, sw_scene_tool_freeze, t.scene, t.id, w, sw_scene_balance, &r);
  return push_report(L, &r);
}

static int meth_thaw(lua_State *L) {
  sw_freeze_report r;
  const lsw_self t = check(L);
  const sw_thaw then = (sw_thaw)luaL_checkoption(L, 2, "holds", after_thaw);
  LSW_DO(L, sw_scene_tool_thaw, t.scene, t.id, then, sw_scene_balance, &r);
  return push_report(L, &r);
}

/* tool:limit(margin): sets the margin at which a frozen grip is lost. */
static int meth_limit(lua_State *L) {
  const lsw_self t = check(L);
  const double margin = lsw_number(L, 2, "tool:limit: margin", "-");
  LSW_DO(L, sw_scene_tool_limit, t.scene, t.id, margin);
  return 0;
}

static const luaL_Reg methods[] = {
    {"pad", meth_pad},       {"hold", meth_hold},   {"pads_on", meth_pads_on},
    {"follow", meth_follow}, {"pose", meth_pose},   {"jaws", meth_jaws},
    {"watch", meth_watch},   {"state", meth_state}, {"force", meth_force},
    {"moment", meth_moment}, {"log", meth_log},     {"touches", meth_touches},
    {"freeze", meth_freeze}, {"thaw", meth_thaw},   {"limit", meth_limit},
    {"take", meth_take},     {NULL, NULL}};

static int describe(lua_State *L) {
  lsw_self t;
  if (!lsw_find_self(L, &lsw_class_tool, &t)) return 1;
  const sw_identity is = sw_scene_identify(t.scene, SW_OF_TOOL, t.id);
  if (!is.alive) return lsw_say_taken_back(L, &lsw_class_tool);
  return lsw_say(L, "tool '%s'", is.name);
}

const lsw_class lsw_class_tool = {.name = "tool",
                                  .kind = SW_OF_TOOL,
                                  .size = sizeof(lsw_child),
                                  .methods = methods,
                                  .describe = describe,
                                  .gone = "this tool was never made"};
