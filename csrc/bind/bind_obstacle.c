/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class obstacle and scene:obstacle. */

#include "bind/bind_shape.h"
#include "bind/child.h"
#include "bind/share.h"

int lsw_scene_obstacle(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_obstacle_args args;
  sw_error err = {""};
  sw_status status = SW_EINVAL;
  const lsw_section extra = {&sw_obstacle_params, &args};
  lua_settop(L, 2);
  lsw_child *child = lsw_new_child(L, &lsw_class_obstacle);
  sw_shape *shape = lsw_shape_from_table(L, 2, &extra, 1);
  if (lsw_is_open(L)) status = sw_scene_add_obstacle(scene, shape, &args, &child->id, &err);
  sw_shape_release(shape);
  lsw_still_open(L);
  lsw_must(L, status, &err);
  lua_pushvalue(L, 3);
  return 1;
}

static lsw_self check(lua_State *L) { return lsw_check_self(L, &lsw_class_obstacle); }

static lsw_load load_of(lua_State *L, int with_point) {
  lsw_load on;
  sw_vec about = sw_v(0, 0, 0);
  static const sw_param rows[] = {
      {"at", SW_PARAM_VECTOR, "m", 0, -HUGE_VAL, HUGE_VAL, 0, NULL, 0,
       "point about which the moment is taken (default: the world's origin)"}};
  static const sw_params params = SW_PARAMS("obstacle:moment", rows);
  const lsw_self o = check(L);
  if (with_point) lsw_arguments(L, 2, "obstacle:moment", &params, &about);
  LSW_DO(L, sw_scene_obstacle_force, o.scene, o.id, about, &on.force, &on.moment);
  return on;
}

/* obstacle:force(): contact force on the obstacle, mean over the last step [N];
 * obstacle:moment([{ at = point }]) about this point or the world's origin [N m]. */
static int meth_force(lua_State *L) { return lsw_push_vector(L, load_of(L, 0).force), 1; }
static int meth_moment(lua_State *L) { return lsw_push_vector(L, load_of(L, 1).moment), 1; }

/* obstacle:pose() -> position, rotation; obstacle:pose(position [, rotation]) sets them. Without a
 * rotation the present one stays. */
static int meth_pose(lua_State *L) { return lsw_pose(L, &lsw_class_obstacle); }

static int meth_follow(lua_State *L) {
  return lsw_follow(L, &lsw_class_obstacle, "obstacle:follow");
}

/* obstacle:get() -> a table of its present parameters */
static int meth_get(lua_State *L) {
  sw_obstacle_args args;
  const lsw_self o = check(L);
  LSW_DO(L, sw_scene_obstacle_args, o.scene, o.id, &args);
  lsw_push_values(L, &sw_obstacle_params, &args);
  return 1;
}

static int given(lua_State *L, const char *name) {
  const int there = lua_getfield(L, 2, name) != LUA_TNIL;
  lua_pop(L, 1);
  return there;
}

/* obstacle:set{ friction =, restitution =, at =, ... }: changes its parameters. Friction alone also
 * sets the kinetic friction. */
static int meth_set(lua_State *L) {
  sw_obstacle_args args;
  const lsw_self o = check(L);
  lua_settop(L, 2);
  LSW_DO(L, sw_scene_editable, o.scene);
  LSW_DO(L, sw_scene_obstacle_args, o.scene, o.id, &args);
  lsw_changes(L, 2, "obstacle:set", &sw_obstacle_params, &args);
  const int rubs = given(L, "friction"), slides = given(L, "kinetic_friction");
  const int placed = given(L, "at") || given(L, "rotation"), bounces = given(L, "restitution");
  if (rubs && !slides) args.kinetic = args.friction;
  if (placed) { /* all has been read: an argument that raises changes nothing */
    const sw_pose pose = {args.at, args.rotation};
    LSW_DO(L, sw_scene_object_put, o.scene, SW_OF_OBSTACLE, o.id, pose);
  }
  if (rubs || slides || bounces) LSW_DO(L, sw_scene_obstacle_set_surface, o.scene, o.id, &args);
  return 0;
}

static int meth_remove(lua_State *L) {
  return lsw_order(L, &lsw_class_obstacle, sw_scene_remove_obstacle);
}

/* obstacle:log() -> flat rows of 5: t [s], force [N], span [s]; number of rows. The force is the
 * mean over the span up to t; span 0: an equilibrium. */
static int meth_log(lua_State *L) { return lsw_log(L, &lsw_class_obstacle, SW_LOG_OBSTACLE_SIZE); }

/* obstacle.shape: the shape in its own axes, at the origin. */
static int prop_shape(lua_State *L) {
  sw_shape *shape;
  const lsw_self o = check(L);
  if (!sw_scene_identify(o.scene, SW_OF_OBSTACLE, o.id).alive)
    return lsw_not_there(L, &lsw_class_obstacle, o.scene);
  LSW_DO(L, sw_scene_obstacle_shape, o.scene, o.id, &shape);
  lsw_push_shape(L, shape);
  return 1;
}

static const luaL_Reg methods[] = {
    {"force", meth_force},   {"moment", meth_moment}, {"pose", meth_pose},
    {"follow", meth_follow}, {"remove", meth_remove}, {"log", meth_log},
    {"get", meth_get},       {"set", meth_set},       {NULL, NULL}};

static int describe(lua_State *L) {
  lsw_self o;
  sw_error err;
  sw_vec force, moment;
  if (!lsw_find_self(L, &lsw_class_obstacle, &o)) return 1;
  const sw_identity is = sw_scene_identify(o.scene, SW_OF_OBSTACLE, o.id);
  if (!is.name) return lsw_say_taken_back(L, &lsw_class_obstacle);
  if (!is.alive) return lsw_say(L, "%s '%s' (removed)", is.kind, is.name);
  if (sw_scene_obstacle_force(o.scene, o.id, sw_v(0, 0, 0), &force, &moment, &err) != SW_OK)
    return lsw_say(L, "%s '%s'", is.kind, is.name);
  return lsw_say(L, "%s '%s': force on it (%.4g, %.4g, %.4g) N", is.kind, is.name, force.x, force.y,
                 force.z);
}

static const luaL_Reg properties[] = {
    {"shape", prop_shape}, {"name", lsw_prop_name}, {"present", lsw_prop_alive}, {NULL, NULL}};

const lsw_class lsw_class_obstacle = {.name = "obstacle",
                                      .kind = SW_OF_OBSTACLE,
                                      .size = sizeof(lsw_child),
                                      .methods = methods,
                                      .describe = describe,
                                      .properties = properties,
                                      .gone = "this obstacle was never made"};
