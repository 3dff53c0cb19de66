/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class force and scene:force; Lua functions as forces. */
#include <string.h>

#include "bind/bind_motion.h"
#include "bind/child.h"

/* A Lua function as a force. The function and its arrays live in the scene's
 * user value 1, so that the garbage collector sees them; while a run is under
 * way the scene is at stack index 1 of the state in lsw_running. */
typedef struct lua_force {
  int number; /* key in the scene's table */
} lua_force;

lua_State **lsw_running(void);

static void push_flat(lua_State *L, int table, const char *key, const double *values, size_t n) {
  lua_getfield(L, table, key);
  for (size_t i = 0; i < n; i++) {
    lua_pushnumber(L, values ? values[i] : 0.0);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

/* f of the table's array into the field; returns the index of a bad item or 0. */
static size_t read_back(lua_State *L, int array, sw_field *field, size_t n) {
  for (size_t i = 0; i < n; i++) {
    int number;
    lua_rawgeti(L, array, (lua_Integer)i + 1);
    const double f = lua_tonumberx(L, -1, &number);
    lua_pop(L, 1);
    if (!number || !isfinite(f)) return i + 1;
    field->force[i] += f;
  }
  return 0;
}

/* Runs protected: table of the force, the field. */
static int call_function(lua_State *L) {
  sw_field *field = lua_touserdata(L, 2);
  const size_t n = 3 * field->plan->nodes;
  lua_getfield(L, 1, "call");
  lua_pushnumber(L, field->time);
  push_flat(L, 1, "x", field->x, n);
  push_flat(L, 1, "v", field->v, n);
  push_flat(L, 1, "f", NULL, n);
  lua_call(L, 4, 0);
  lua_getfield(L, 1, "f");
  const size_t bad = read_back(L, lua_gettop(L), field, n);
  if (bad)
    luaL_error(L, "force function: component %d of the force on node %d is not a finite number",
               (int)((bad - 1) % 3) + 1, (int)((bad - 1) / 3) + 1);
  return 0;
}

static sw_status call_force(void *user, sw_field *field, sw_error *err) {
  lua_State *L = *lsw_running();
  if (!L) return SW_OK; /* only runs and settles evaluate forces */
  const int number = (int)(size_t)user;
  if (!lua_checkstack(L, 16)) return sw_fail(err, SW_ENOMEM, "force function: out of stack");
  lua_pushcfunction(L, call_function);
  lua_getiuservalue(L, 1, 1);
  lua_rawgeti(L, -1, number);
  lua_remove(L, -2);
  lua_pushlightuserdata(L, field);
  if (lua_pcall(L, 2, 0, 0) == LUA_OK) return SW_OK;
  return lsw_motion_keep_error(L, err);
}

/* Keep the function at index under a new number of the scene's table. */
static int keep_function(lua_State *L, lsw_scene_handle *owner, int function) {
  static const char *const arrays[] = {"x", "v", "f"};
  const int number = ++owner->forces;
  lua_getiuservalue(L, 1, 1);
  lua_createtable(L, 0, 4);
  lua_pushvalue(L, function);
  lua_setfield(L, -2, "call");
  for (int i = 0; i < 3; i++) {
    lua_newtable(L);
    lua_setfield(L, -2, arrays[i]);
  }
  lua_rawseti(L, -2, number);
  lua_pop(L, 1);
  return number;
}

enum { OWN_ROWS = 2 };
static const sw_param own_rows[OWN_ROWS] = {
    {"kind", SW_PARAM_OTHER, "-", 0, 0, 0, SW_PARAM_REQUIRED, NULL, 0,
     "name of the force, or a function(t, x, v, f) that adds to f"},
    {"on", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0, "the wire (default: every wire)"},
};
static const sw_params own_params = {"force", own_rows, OWN_ROWS};

static const sw_force_class *read_kind(lua_State *L) {
  const char *names[64];
  size_t count = 0;
  const char *word = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : luaL_typename(L, -1);
  for (size_t i = 0; sw_force_all()[i] && count < 64; i++)
    if (!(sw_force_all()[i]->flags & SW_FORCE_INNER)) names[count++] = sw_force_all()[i]->name;
  for (size_t i = 0; i < count; i++)
    if (strcmp(names[i], word) == 0) return sw_force_find(word);
  const char *near = sw_nearest_name(word, names, sizeof names[0], count);
  if (near) luaL_error(L, "scene:force: there is no kind '%s'; did you mean '%s'?", word, near);
  lua_pushliteral(L, "a function");
  for (size_t i = 0; i < count; i++) {
    lua_pushfstring(L, ", %s", names[i]);
    lua_concat(L, 2);
  }
  luaL_error(L, "scene:force: there is no kind '%s'; known are: %s", word, lua_tostring(L, -1));
  return NULL;
}

int lsw_scene_force(lua_State *L) {
  lsw_scene_handle *owner = lsw_check(L, 1, &lsw_class_scene);
  double args[SW_FORCE_ARGS_MAX / sizeof(double)] = {0};
  sw_callback_args callback = {call_force, NULL};
  sw_error err = {""};
  sw_handle wire = {0, 0};
  char none;
  lua_settop(L, 2);
  luaL_checktype(L, 2, LUA_TTABLE);
  if (lua_getfield(L, 2, "on") != LUA_TNIL)
    wire = lsw_check_child_of(L, 3, &lsw_class_wire, owner->h.object, "scene:force: on")->id;
  lua_getfield(L, 2, "kind");
  const int function = lua_isfunction(L, 4);
  if (lua_isnil(L, 4))
    luaL_error(L, "scene:force: kind is required: the name of a force or a function");
  const sw_force_class *cls = function ? sw_force_find("callback") : read_kind(L);
  const lsw_section sections[] = {{&own_params, &none}, {&cls->params, args}};
  lsw_sections(L, 2, function ? "force" : lua_pushfstring(L, "force %s", cls->name), sections,
               cls->params.count ? 2 : 1);
  if (function) {
    callback.user = (void *)(size_t)keep_function(L, owner, 4); /* a number, not an address */
    memcpy(args, &callback, sizeof callback);
  }
  lsw_child *child = lsw_new_child(L, 1, &lsw_class_force);
  lsw_must(L,
           sw_scene_add_force(owner->h.object, cls, wire, args, sizeof args, &child->id, &err),
           &err);
  child->h.object = owner;
  return 1;
}

static int meth_release(lua_State *L) {
  sw_scene *scene;
  sw_error err = {""};
  const lsw_child *f = lsw_check_child(L, 1, &lsw_class_force, &scene);
  lsw_must(L, sw_scene_remove_force(scene, f->id, &err), &err);
  return 0;
}

static const luaL_Reg methods[] = {{"release", meth_release}, {NULL, NULL}};

const lsw_class lsw_class_force = {"force", sizeof(lsw_child), methods, NULL, NULL,
                                   lsw_close_child, "this force handle has been closed"};
