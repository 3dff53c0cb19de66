/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class join and scene:join. */

#include "bind/child.h"
#include "bind/share.h"

/* Returns the end { wire, s = } at the top of the stack, and pops it. */
static sw_join_end read_end(lua_State *L, const sw_scene *scene, size_t number) {
  static const sw_param rows[] = {{"s", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_REQUIRED,
                                   NULL, 0, "arc length at which the wire is joined"}};
  static const sw_params params = SW_PARAMS("scene:join", rows);
  const char *what = lua_pushfstring(L, "scene:join: ends[%d]", (int)number);
  sw_join_end end;
  lua_insert(L, -2);
  const char *first = lua_pushfstring(L, "%s[1]", what);
  lua_insert(L, -2);
  const int at = lua_gettop(L);
  if (!lua_istable(L, at))
    luaL_error(L, "%s must be { wire, s = arc length }, got %s", what, lsw_describe(L, at));
  lua_rawgeti(L, at, 1);
  end.wire = lsw_check_child_of(L, at + 1, &lsw_class_wire, scene, first);
  lua_newtable(L); /* all entries but the wire, to be checked */
  lua_pushnil(L);
  while (lua_next(L, at)) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    if (lua_isinteger(L, -2) && lua_tointeger(L, -2) == 1)
      lua_pop(L, 2);
    else
      lua_rawset(L, at + 2);
  }
  lsw_arguments(L, at + 2, what, &params, &end.s);
  lua_settop(L, at - 3);
  return end;
}

int lsw_scene_join(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_join_args args;
  sw_join_end ends[SW_JOIN_ENDS];
  lua_settop(L, 2);
  lsw_arguments(L, 2, "scene:join", &sw_link_find("join")->params, &args);
  if (!lua_istable(L, 2) || lua_getfield(L, 2, "ends") != LUA_TTABLE)
    return luaL_error(L, "scene:join: ends is required: a list of { wire, s = arc length }");
  lsw_only_items(L, 3, "scene:join: ends");
  const size_t count = lua_rawlen(L, 3);
  for (size_t k = 0; k < count && k < SW_JOIN_ENDS; k++) {
    lua_rawgeti(L, 3, (lua_Integer)k + 1);
    ends[k] = read_end(L, scene, k + 1);
  }
  lsw_child *child = lsw_new_child(L, &lsw_class_join);
  LSW_DO(L, sw_scene_add_join, scene, &args, ends, count, &child->id);
  return 1;
}

static lsw_load load_of(lua_State *L) {
  lsw_load on;
  const lsw_self j = lsw_check_self(L, &lsw_class_join);
  const lua_Integer k = lua_isinteger(L, 2) ? lua_tointeger(L, 2) : 0;
  if (k < 1)
    luaL_error(L, "join: the first argument must be the number of an end, from 1, got %s",
               lsw_describe(L, 2));
  LSW_DO(L, sw_scene_join_force, j.scene, j.id, (size_t)k - 1, &on.force, &on.moment);
  return on;
}

/* join:force(k) on end number k [N]; join:moment(k) about the join's point [N m]. */
static int meth_force(lua_State *L) { return lsw_push_vector(L, load_of(L).force), 1; }
static int meth_moment(lua_State *L) { return lsw_push_vector(L, load_of(L).moment), 1; }

/* join:read() of a tie -> { distance [m], tension [N], peak [N], broken, broken_time [s],
 * broken_force [N] }; no distance (NaN in C) once a wire of it has been removed. */
static int meth_read(lua_State *L) {
  const char *const *names;
  double values[SW_LINK_OUTPUTS];
  const lsw_self j = lsw_check_self(L, &lsw_class_join);
  LSW_DO(L, sw_scene_read_join, j.scene, j.id, &names, values);
  lua_newtable(L);
  for (size_t k = 0; names[k]; k++)
    if (!isnan(values[k])) lsw_set_number(L, names[k], values[k]);
  return 1;
}

/* join:log() of a tie -> flat rows of time [s], force on the first wire [N]; number of rows */
static int meth_log(lua_State *L) { return lsw_log(L, &lsw_class_join, SW_LOG_FORCE_SIZE); }

static int meth_release(lua_State *L) {
  return lsw_order(L, &lsw_class_join, sw_scene_release_join);
}

static int describe(lua_State *L) {
  lsw_self j;
  if (!lsw_find_self(L, &lsw_class_join, &j)) return 1;
  const sw_identity is = sw_scene_identify(j.scene, SW_OF_JOIN, j.id);
  if (!is.name) return lsw_say_taken_back(L, &lsw_class_join);
  return lsw_say(L, "join '%s' of %zu wires%s", is.name, sw_scene_join_ends(j.scene, j.id),
                 is.alive ? "" : " (released)");
}

static const luaL_Reg methods[] = {{"force", meth_force},     {"moment", meth_moment},
                                   {"release", meth_release}, {"read", meth_read},
                                   {"log", meth_log},         {NULL, NULL}};
static const luaL_Reg properties[] = {
    {"name", lsw_prop_name}, {"held", lsw_prop_alive}, {NULL, NULL}};

const lsw_class lsw_class_join = {.name = "join",
                                  .kind = SW_OF_JOIN,
                                  .size = sizeof(lsw_child),
                                  .methods = methods,
                                  .describe = describe,
                                  .properties = properties,
                                  .gone = "this join was never made"};
