/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes motions of Lua functions of time. The functions run protected on a separate
 * Lua thread, so that any part of the core can evaluate them. An error's value
 * stays in the registry until the caller raises it again. */

#include <string.h>

#include "bind/bind_motion.h"

static const char thread_key = 0; /* registry: the thread of the functions */
static const char error_key = 0;  /* registry: {value of the last error, true if there is one} */

typedef struct function {
  lua_State *L;  /* the thread */
  int reference; /* of the function in the registry [-] */
} function;

typedef struct job {
  const function *f;
  double t; /* [s] */
  sw_pose *out;
} job;

void lsw_motion_call(lua_State *L, int args, int results, const char *what) {
  if (lua_pcall(L, args, results, 0) == LUA_OK) return;
  const char *text = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
  if (strcmp(text, "attempt to yield across a C-call boundary") == 0)
    luaL_error(L, "%s must not yield or wait: it is called within a step; a process may wait",
               what);
  lua_error(L);
}

const char *lsw_motion_place(lua_State *L) {
  lua_Debug at;
  if (!lua_getinfo(L, ">S", &at) || at.linedefined <= 0) return lua_pushliteral(L, "");
  return lua_pushfstring(L, "%s:%d: ", at.short_src, at.linedefined);
}

static int run(lua_State *L) {
  const job *j = lua_touserdata(L, 1);
  lua_rawgeti(L, LUA_REGISTRYINDEX, j->f->reference);
  const char *place = lsw_motion_place(L);
  const char *name = lua_pushfstring(L, "%strajectory: func(%f)", place, j->t);
  lua_rawgeti(L, LUA_REGISTRYINDEX, j->f->reference);
  lua_pushnumber(L, j->t);
  lsw_motion_call(L, 1, 2, name);
  if (!lua_istable(L, 4))
    return luaL_error(
        L, "%s must return a position {x, y, z} [m] and, if it turns, a rotation; got %s", name,
        luaL_typename(L, 4));
  j->out->p =
      lsw_place(L, 4, lua_pushfstring(L, "%strajectory: position from func(%f)", place, j->t));
  j->out->q =
      lsw_rotation(L, 5, lua_pushfstring(L, "%strajectory: rotation from func(%f)", place, j->t));
  return 0;
}

static sw_status call(void *user, double t, sw_pose *out, sw_error *err) {
  function *f = user;
  job j = {f, t, out};
  lua_State *L = f->L;
  if (!lua_checkstack(L, 10))
    return sw_fail(err, SW_ENOMEM, "trajectory: out of memory for calling the function");
  lua_pushcfunction(L, run);
  lua_pushlightuserdata(L, &j);
  if (lua_pcall(L, 1, 0, 0) == LUA_OK) return SW_OK;
  return lsw_motion_keep_error(L, err);
}

static void release(void *user) {
  function *f = user;
  if (lua_checkstack(f->L, 4)) luaL_unref(f->L, LUA_REGISTRYINDEX, f->reference);
  sw_free(f);
}

sw_status lsw_motion_function(lua_State *L, int index, const lsw_motion_args *args, sw_motion **out,
                              sw_error *err) {
  index = lua_absindex(L, index);
  lua_rawgetp(L, LUA_REGISTRYINDEX, &thread_key);
  lua_State *thread = lua_tothread(L, -1);
  lua_pop(L, 1);
  lua_pushvalue(L, index);
  const int reference = luaL_ref(L, LUA_REGISTRYINDEX);
  function *f = sw_alloc(1, sizeof *f);
  sw_status status = f ? SW_OK : sw_fail(err, SW_ENOMEM, "trajectory: out of memory");
  if (f) {
    *f = (function){thread, reference};
    const sw_motion_callback callback = {call,
                                         f,
                                         release,
                                         args->step,
                                         isnan(args->duration) ? HUGE_VAL : args->duration,
                                         args->start,
                                         args->relative};
    status = sw_motion_create_callback(&callback, out, err);
  }
  if (status != SW_OK) {
    luaL_unref(L, LUA_REGISTRYINDEX, reference);
    sw_free(f);
  }
  return status;
}

/* --- errors ------------------------------------------------------------------- */

sw_status lsw_motion_keep_error(lua_State *L, sw_error *err) {
  const char *text = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
  if (text)
    sw_fail(err, SW_ECALLBACK, "%s", text);
  else
    sw_fail(err, SW_ECALLBACK, "a function raised an error value of type %s", luaL_typename(L, -1));
  lua_rawgetp(L, LUA_REGISTRYINDEX, &error_key);
  lua_insert(L, -2);
  lua_rawseti(L, -2, 1);
  lua_pushboolean(L, 1);
  lua_rawseti(L, -2, 2);
  lua_pop(L, 1);
  return SW_ECALLBACK;
}

/* Pushes the value that a function raised last and forgets it. Pushes nil and returns 0
 * if there is none, else returns 1. */
static int take_error(lua_State *L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &error_key);
  lua_rawgeti(L, -1, 2);
  const int some = lua_toboolean(L, -1);
  lua_pop(L, 1);
  lua_rawgeti(L, -1, 1);
  if (!some) lua_pop(L, 1), lua_pushnil(L);
  lua_pushboolean(L, 0);
  lua_rawseti(L, -3, 1);
  lua_pushboolean(L, 0);
  lua_rawseti(L, -3, 2);
  lua_remove(L, -2);
  return some;
}

int lsw_motion_rethrow(lua_State *L, sw_status status, const sw_error *err) {
  if (status != SW_ECALLBACK) return lsw_raise(L, status, err);
  if (take_error(L)) return lua_error(L);
  return lsw_raise(L, status, err);
}

void lsw_motion_open_functions(lua_State *L) {
  lua_newthread(L);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &thread_key);
  lua_createtable(L, 2, 0);
  lua_pushboolean(L, 0), lua_rawseti(L, -2, 1);
  lua_pushboolean(L, 0), lua_rawseti(L, -2, 2);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &error_key);
}
