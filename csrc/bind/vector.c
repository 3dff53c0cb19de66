/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vectors, places, rotations: Lua tables to C and back. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bind/class.h"

/* Raises the error for a key that the table does not have. */
static void refuse(lua_State *L, const char *what, const char *key, const char *const *names,
                   size_t count) {
  if (!names) luaL_error(L, "%s is a list; it has no field '%s'", what, key);
  const char *near = /* any letter is near to x */
      key[0] && key[1] ? sw_nearest_name(key, names, sizeof names[0], count) : NULL;
  if (near) luaL_error(L, "%s has no field '%s'; did you mean '%s'?", what, key, near);
  luaL_Buffer b;
  luaL_buffinit(L, &b);
  for (size_t i = 0; i < count; i++) {
    luaL_addchar(&b, ' ');
    luaL_addstring(&b, names[i]);
  }
  luaL_pushresult(&b);
  luaL_error(L, "%s has no field '%s'; known are:%s", what, key, lua_tostring(L, -1));
}

void lsw_only(lua_State *L, int index, const char *what, const char *const *names, size_t count) {
  index = lua_absindex(L, index);
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    if (lua_isinteger(L, -2)) continue;
    if (lua_type(L, -2) != LUA_TSTRING) refuse(L, what, lsw_describe(L, -2), NULL, 0);
    const char *key = lua_tostring(L, -2);
    size_t i = 0;
    while (i < count && strcmp(names[i], key) != 0) i++;
    if (i == count && strcmp(key, "n") != 0) refuse(L, what, key, names, count);
  }
}

void lsw_only_items(lua_State *L, int index, const char *what) {
  lsw_only(L, index, what, NULL, 0);
}

/* Pushes item i of the table, or its field name if there is no item i. */
static void push_item(lua_State *L, int table, int i, const char *name) {
  if (lua_geti(L, table, i) == LUA_TNIL) {
    lua_pop(L, 1);
    lua_getfield(L, table, name);
  }
}

static void numbers(lua_State *L, int index, const char *what, const char *unit, int count,
                    const char *const *names, double *out) {
  index = lua_absindex(L, index);
  if (!lua_istable(L, index)) {
    luaL_error(L, "%s must be a table of %d numbers [%s], got %s", what, count, unit,
               lsw_describe(L, index));
    return;
  }
  if (lua_rawlen(L, index) > (size_t)count)
    luaL_error(L, "%s must have %d numbers, got %d", what, count, (int)lua_rawlen(L, index));
  for (int i = 0; i < count; i++) {
    push_item(L, index, i + 1, names[i]);
    out[i] = lsw_number(L, -2, lua_pushfstring(L, "%s, item %d,", what, i + 1), unit);
    lua_pop(L, 2);
  }
}

static const char *const axes[] = {"x", "y", "z"};

static sw_vec vector_in(lua_State *L, int index, const char *what, const char *unit) {
  double v[3] = {0, 0, 0};
  numbers(L, index, what, unit, 3, axes, v);
  return sw_v(v[0], v[1], v[2]);
}

static void only_axes(lua_State *L, int index, const char *what) {
  if (lua_istable(L, index)) lsw_only(L, index, what, axes, 3);
}

sw_vec lsw_vector(lua_State *L, int index, const char *what, const char *unit) {
  only_axes(L, index, what);
  return vector_in(L, index, what, unit);
}

sw_vec lsw_place(lua_State *L, int index, const char *what) {
  only_axes(L, index, what);
  return lsw_place_in(L, index, what);
}

sw_vec lsw_place_in(lua_State *L, int index, const char *what) {
  const sw_vec p = vector_in(L, index, what, "m");
  const double v[] = {p.x, p.y, p.z};
  for (int i = 0; i < 3; i++) {
    if (fabs(v[i]) <= SW_PLACE_FARTHEST) continue;
    char range[96];
    snprintf(range, sizeof range, "%g m is not allowed; it must be in [%g, %g] m", v[i],
             -SW_PLACE_FARTHEST, SW_PLACE_FARTHEST);
    luaL_error(L, "%s: %c = %s", what, "xyz"[i], range);
  }
  return p;
}

/* Raises an error for a key that a turn does not have. */
static void check_turn(lua_State *L, int index, const char *what) {
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    const char *key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "axis";
    if (strcmp(key, "axis") != 0 && strcmp(key, "angle") != 0)
      luaL_error(L, "%s: there is no parameter '%s'; known are: axis angle", what, key);
  }
}

sw_vec lsw_turn(lua_State *L, int index, const char *what) {
  const int top = lua_gettop(L);
  index = lua_absindex(L, index);
  check_turn(L, index, what);
  lua_getfield(L, index, "axis");
  const sw_vec axis = lsw_vector(L, -2, lua_pushfstring(L, "%s.axis", what), "-");
  lua_getfield(L, index, "angle");
  const double angle = lsw_number(L, -2, lua_pushfstring(L, "%s.angle", what), "rad");
  if (sw_norm(axis) == 0) luaL_error(L, "%s.axis must not be the zero vector", what);
  lua_settop(L, top);
  return sw_scale(sw_unit_or(axis, sw_v(0, 0, 1)), angle);
}

sw_quat lsw_rotation(lua_State *L, int index, const char *what) {
  static const char *const names[] = {"w", "x", "y", "z", "axis", "angle"};
  double q[4] = {1, 0, 0, 0};
  index = lua_absindex(L, index);
  if (lua_isnoneornil(L, index)) return sw_quat_identity();
  if (lua_istable(L, index)) {
    const int turns = lua_getfield(L, index, "axis") != LUA_TNIL;
    lua_pop(L, 1);
    if (turns) return sw_quat_exp(lsw_turn(L, index, what));
    lsw_only(L, index, what, names, sizeof names / sizeof names[0]);
  }
  numbers(L, index, what, "-", 4, names, q);
  if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] == 0)
    luaL_error(L, "%s must not be the zero quaternion", what);
  return sw_quat_unit((sw_quat){q[0], q[1], q[2], q[3]});
}

/* Keys of the metatables in the registry. */
static const char vector_class = 0, rotation_class = 0;

void lsw_open_vectors(lua_State *L) {
  lua_newtable(L), lua_pushvalue(L, -1);
  lua_setfield(L, -3, "vector"), lua_rawsetp(L, LUA_REGISTRYINDEX, &vector_class);
  lua_newtable(L), lua_pushvalue(L, -1);
  lua_setfield(L, -3, "rotation"), lua_rawsetp(L, LUA_REGISTRYINDEX, &rotation_class);
}

static void set_class(lua_State *L, const char *key) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, key), lua_setmetatable(L, -2);
}

void lsw_push_vector(lua_State *L, sw_vec a) {
  lua_createtable(L, 3, 0), set_class(L, &vector_class);
  lua_pushnumber(L, a.x), lua_rawseti(L, -2, 1);
  lua_pushnumber(L, a.y), lua_rawseti(L, -2, 2);
  lua_pushnumber(L, a.z), lua_rawseti(L, -2, 3);
}

void lsw_push_quaternion(lua_State *L, sw_quat q) {
  lua_createtable(L, 4, 0), set_class(L, &rotation_class);
  lua_pushnumber(L, q.w), lua_rawseti(L, -2, 1);
  lua_pushnumber(L, q.x), lua_rawseti(L, -2, 2);
  lua_pushnumber(L, q.y), lua_rawseti(L, -2, 3);
  lua_pushnumber(L, q.z), lua_rawseti(L, -2, 4);
}

const char *lsw_turned_by(const char *object, const sw_params *params, const char *key) {
  static const char *const round[] = {"cylinder", "capsule", "torus"};
  int rotates = 0, is_round = 0;
  if (strcmp(key, "axis") != 0 && strcmp(key, "direction") != 0) return NULL;
  for (size_t i = 0; i < params->count; i++)
    rotates += strcmp(params->rows[i].name, "rotation") == 0 ? 1 : 0;
  for (size_t i = 0; i < sizeof round / sizeof *round; i++)
    is_round |= strstr(object, round[i]) != NULL;
  if (!rotates || strstr(object, "plane")) return NULL; /* a plane has a normal */
  return is_round ? "its axis is z; turn it with rotation = { axis = { x, y, z }, angle = [rad] }"
                  : "turn it with rotation = { axis = { x, y, z }, angle = [rad] }";
}
