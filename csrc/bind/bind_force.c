/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class force and scene:force; Lua functions as forces. */
#include <stdarg.h>
#include <string.h>

#include "bind/bind_motion.h"
#include "bind/bind_particles.h"
#include "bind/child.h"
#include "bind/share.h"

/* A Lua function as a force. The function and its arrays are an entry of the table
 * in the scene's user value 1, so that the garbage collector sees them: { call =,
 * x =, v =, f =, slot =, generation = }. Only methods of the scene evaluate forces,
 * so the scene is at stack index 1 of the running state. */
static lua_State *running;

lua_State *lsw_begin_forces(lua_State *L) {
  lua_State *outer = running;
  running = L;
  return outer;
}

void lsw_end_forces(lua_State *outer) { running = outer; }

/* Pushes the array under key and fills it with exactly n values (zeros for NULL). */
static void push_flat(lua_State *L, int table, const char *key, const double *values, size_t n) {
  lua_getfield(L, table, key);
  for (size_t i = 0; i < n; i++) lsw_put_number(L, i, values ? values[i] : 0.0);
  /* all wires of the force share this table; their node counts may differ */
  for (size_t i = lua_rawlen(L, -1); i > n; i--) {
    lua_pushnil(L);
    lua_rawseti(L, -2, (lua_Integer)i);
  }
}

/* Raises an error with the line where the function is defined. */
static int fail(lua_State *L, const char *format, ...) {
  va_list list;
  va_start(list, format);
  lua_getfield(L, 1, "call");
  lsw_motion_place(L);
  lua_pushliteral(L, "force function: ");
  lua_pushvfstring(L, format, list);
  va_end(list);
  lua_concat(L, 3);
  return lua_error(L);
}

/* Adds the forces of the array to the field. */
static void read_back(lua_State *L, int array, sw_field *field, size_t n) {
  if (lua_rawlen(L, array) > n)
    fail(L, "f must keep its %d items, three for each node; it has %d", (int)n,
         (int)lua_rawlen(L, array));
  for (size_t i = 0; i < n; i++) {
    lua_rawgeti(L, array, (lua_Integer)i + 1);
    const double f = lua_tonumber(L, -1);
    if (lua_type(L, -1) != LUA_TNUMBER || !isfinite(f))
      fail(L, "component %d of the force on node %d is %s; it must be a finite number [N]",
           (int)(i % 3) + 1, (int)(i / 3) + 1, lsw_describe(L, -1));
    lua_pop(L, 1);
    field->force[i] += f;
  }
}

/* A function that returns its force, as functions of motion do, would act without any. The result
 * is on top; f may be returned. */
static void refuse_result(lua_State *L) {
  lua_getfield(L, 1, "f");
  if (!lua_isnil(L, -2) && !lua_rawequal(L, -1, -2))
    fail(L,
         "it returned %s, which is not used; add the force [N] to its fourth argument: f[1] = "
         "f[1] + ..., three items for each node",
         lsw_describe(L, -2));
  lua_pop(L, 2);
}

/* Calls the Lua function, in protected mode. Arguments: the force's table, the field. */
static int call_function(lua_State *L) {
  sw_field *field = lua_touserdata(L, 2);
  const size_t n = 3 * field->plan->nodes;
  lua_getfield(L, 1, "call");
  lua_pushnumber(L, field->time);
  push_flat(L, 1, "x", field->x, n);
  push_flat(L, 1, "v", field->v, n);
  push_flat(L, 1, "f", NULL, n);
  lsw_motion_call(L, 4, 1, "force function");
  refuse_result(L);
  lua_getfield(L, 1, "f");
  read_back(L, lua_gettop(L), field, n);
  return 0;
}

static sw_status call_force(void *user, sw_field *field, sw_error *err) {
  lua_State *L = running;
  if (!L) return sw_fail(err, SW_EBUSY, "force function: there is no Lua state to call it");
  const int number = (int)(size_t)user;
  if (!lua_checkstack(L, 16)) return sw_fail(err, SW_ENOMEM, "force function: out of stack");
  lua_pushcfunction(L, call_function);
  if (lua_getiuservalue(L, 1, 1) != LUA_TTABLE || lua_rawgeti(L, -1, number) != LUA_TTABLE) {
    lua_pop(L, 2);
    return sw_fail(err, SW_EDEAD, "force function: the function no longer exists");
  }
  lua_remove(L, -2);
  lua_pushlightuserdata(L, field);
  if (lua_pcall(L, 2, 0, 0) == LUA_OK) return SW_OK;
  return lsw_motion_keep_error(L, err);
}

/* Keeps the function in the scene's table under a new number, which it returns. */
static int keep_function(lua_State *L, lsw_scene_handle *owner, int function) {
  static const char *const arrays[] = {"x", "v", "f"};
  lua_getiuservalue(L, 1, 1);
  lua_createtable(L, 0, 6);
  lua_pushvalue(L, function);
  lua_setfield(L, -2, "call");
  for (int i = 0; i < 3; i++) {
    lua_newtable(L);
    lua_setfield(L, -2, arrays[i]);
  }
  const int number = ++owner->forces;
  lua_rawseti(L, -2, number);
  lua_pop(L, 1);
  return number;
}

/* Notes the force that the function belongs to; forgets the function if id is NULL. */
static void mark_function(lua_State *L, int number, const sw_handle *id) {
  lua_getiuservalue(L, 1, 1);
  if (id && lua_rawgeti(L, -1, number) == LUA_TTABLE) {
    lsw_set_integer(L, "slot", id->slot);
    lsw_set_integer(L, "generation", id->generation);
    lua_pop(L, 1);
  } else if (!id) {
    lua_pushnil(L);
    lua_rawseti(L, -2, number);
  }
  lua_pop(L, 1);
}

static uint32_t get_count(lua_State *L, const char *name) {
  lua_getfield(L, -1, name);
  const lua_Integer value = lua_tointeger(L, -1);
  lua_pop(L, 1);
  return (uint32_t)value;
}

void lsw_forget_forces(lua_State *L, int index, const sw_scene *scene) {
  lua_getiuservalue(L, index, 1);
  lua_pushnil(L);
  while (lua_next(L, -2)) {
    const sw_handle id = {get_count(L, "slot"), get_count(L, "generation")};
    lua_pop(L, 1);
    if (sw_scene_force_needed(scene, id)) continue;
    lua_pushvalue(L, -1);
    lua_pushnil(L);
    lua_rawset(L, -4); /* lua_next allows removing entries */
  }
  lua_pop(L, 1);
}

enum { OWN_ROWS = 2 };
static const sw_param own_rows[OWN_ROWS] = {
    {"kind", SW_PARAM_OTHER, "-", 0, 0, 0, SW_PARAM_REQUIRED, NULL, 0,
     "name of the force, or a function(t, x, v, f) that adds to f"},
    {"on", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "the wire or object of particles (default: all of them)"},
};
static const sw_params own_params = {"force", own_rows, OWN_ROWS};

static const sw_force_class *read_kind(lua_State *L) {
  const char *names[64];
  size_t count = 0;
  for (size_t i = 0; sw_force_all()[i] && count < 64; i++)
    if (!(sw_force_all()[i]->flags & SW_FORCE_INNER)) names[count++] = sw_force_all()[i]->name;
  return sw_force_find(
      names[lsw_word(L, "scene:force: there is no kind", "a function", names, count)]);
}

int lsw_scene_force(lua_State *L) {
  lsw_scene_handle *owner = lsw_check(L, 1, &lsw_class_scene);
  double args[SW_FORCE_ARGS_MAX / sizeof(double)] = {0};
  sw_callback_args callback = {call_force, NULL};
  sw_error err = {""};
  sw_status status = SW_EINVAL;
  sw_handle wire = {0, 0};
  char none;
  lua_settop(L, 2);
  lsw_check_table(L, 2, "scene:force");
  if (lua_getfield(L, 2, "on") != LUA_TNIL)
    wire = lsw_check_body_of(L, 3, owner->h.object, "scene:force: on");
  lua_getfield(L, 2, "kind");
  const int function = lua_isfunction(L, 4);
  if (lua_isnil(L, 4))
    luaL_error(L, "scene:force: kind is required: the name of a force or a function");
  const sw_force_class *cls = function ? sw_force_find("callback") : read_kind(L);
  const lsw_section sections[] = {{&own_params, &none}, {&cls->params, args}};
  lsw_sections(L, 2, function ? "force" : lua_pushfstring(L, "force %s", cls->name), sections,
               cls->params.count ? 2 : 1);
  if (cls->flags & SW_FORCE_ON_SOME) {
    sw_force_some some;
    lua_getfield(L, 2, "particles");
    some.particle = lsw_particle_numbers(L, -1, "particles of a force", &some.count);
    memcpy(args, &some, sizeof some);
  }
  lsw_child *child = lsw_new_child(L, &lsw_class_force);
  const int number = function ? keep_function(L, owner, 4) : 0;
  if (function) {
    callback.user = (void *)(size_t)number; /* a number, not an address */
    memcpy(args, &callback, sizeof callback);
  }
  if (lsw_is_open(L))
    status = sw_scene_add_force(owner->h.object, cls, wire, args, sizeof args, &child->id, &err);
  if (function) mark_function(L, number, status == SW_OK ? &child->id : NULL);
  lsw_still_open(L);
  lsw_must(L, status, &err);
  return 1;
}

static int meth_release(lua_State *L) {
  const lsw_self f = lsw_check_self(L, &lsw_class_force);
  LSW_DO(L, sw_scene_remove_force, f.scene, f.id);
  lua_getiuservalue(L, 1, 1);
  lsw_forget_forces(L, lua_gettop(L), f.scene);
  return 0;
}

/* force:read(wire) -> values that its kind of force has for this wire, by name; see its file */
static int meth_read(lua_State *L) {
  double values[SW_FORCE_OUTPUTS_MAX];
  const lsw_self f = lsw_check_self(L, &lsw_class_force);
  lua_settop(L, 2);
  const sw_handle wire = lsw_check_body_of(L, 2, f.scene, "force:read: wire");
  LSW_DO(L, sw_scene_read_force, f.scene, f.id, wire, values);
  const char *const *names = sw_scene_force_class(f.scene, f.id)->outputs;
  lua_newtable(L);
  for (size_t k = 0; names[k]; k++) lsw_set_number(L, names[k], values[k]);
  return 1;
}

/* force:log() -> flat rows of 4: t [s], force on wires [N]; number of rows */
static int meth_log(lua_State *L) { return lsw_log(L, &lsw_class_force, SW_LOG_FORCE_SIZE); }

/* force:call_it(name): sets its name in events */
static int meth_call_it(lua_State *L) {
  const lsw_self f = lsw_check_self(L, &lsw_class_force);
  const char *name = lsw_name(L, 2, "force:call_it: the name");
  LSW_DO(L, sw_scene_name_force, f.scene, f.id, name);
  return 0;
}

static int describe(lua_State *L) {
  lsw_self f;
  if (!lsw_find_self(L, &lsw_class_force, &f)) return 1;
  const sw_force_class *cls = sw_scene_force_class(f.scene, f.id);
  if (!cls) return lsw_say_taken_back(L, &lsw_class_force);
  return lsw_say(L, "force %s: %s", cls->name, cls->summary);
}

/* force:get() -> a table of its present parameters */
static int meth_get(lua_State *L) {
  double args[SW_FORCE_ARGS_MAX / sizeof(double)];
  const lsw_self f = lsw_check_self(L, &lsw_class_force);
  LSW_DO(L, sw_scene_force_args, f.scene, f.id, args);
  const sw_force_class *cls = sw_scene_force_class(f.scene, f.id);
  lsw_push_values(L, &cls->params, args);
  lsw_set_text(L, "kind", cls->name);
  return 1;
}

/* force:set{ stiffness =, ... }: changes its parameters */
static int meth_set(lua_State *L) {
  double args[SW_FORCE_ARGS_MAX / sizeof(double)];
  const lsw_self f = lsw_check_self(L, &lsw_class_force);
  lua_settop(L, 2);
  LSW_DO(L, sw_scene_editable, f.scene);
  LSW_DO(L, sw_scene_force_args, f.scene, f.id, args);
  const sw_force_class *cls = sw_scene_force_class(f.scene, f.id);
  if (!cls->params.count) luaL_error(L, "force %s: it has no parameters to set", cls->name);
  const char *name = lua_pushfstring(L, "force %s: set", cls->name);
  lsw_changes(L, 2, name, &cls->params, args);
  LSW_DO(L, sw_scene_set_force, f.scene, f.id, args);
  return 0;
}

static const luaL_Reg methods[] = {
    {"release", meth_release}, {"get", meth_get},         {"set", meth_set}, {"read", meth_read},
    {"log", meth_log},         {"call_it", meth_call_it}, {NULL, NULL}};
static const luaL_Reg properties[] = {
    {"kind", lsw_prop_kind}, {"held", lsw_prop_alive}, {NULL, NULL}};

const lsw_class lsw_class_force = {.name = "force",
                                   .kind = SW_OF_FORCE,
                                   .size = sizeof(lsw_child),
                                   .methods = methods,
                                   .describe = describe,
                                   .properties = properties,
                                   .gone = "this force was never made"};
