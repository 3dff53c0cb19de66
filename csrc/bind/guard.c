/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Methods refuse arguments that they do not take. How many they take, the rows of the calls in Lua
 * tell: a method asks them when it first gets more than it knows of. */
#include "bind/class.h"

static const char key = 0; /* its address is the key in the registry of the function that tells */

enum { METHOD = 2, MOST = 3 }; /* upvalues of guarded(), after the class */

/* Asks the function of Lua for how many arguments the method takes. It raises an error for those
 * that scripts may not give. */
static void ask(lua_State *L, const luaL_Reg *m) {
  const int given = lua_gettop(L);
  const lsw_class *c = lua_touserdata(L, lua_upvalueindex(1));
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &key) != LUA_TFUNCTION) {
    lua_pop(L, 1); /* the core without the rest of the library */
    return;
  }
  luaL_checkstack(L, given + 3, "too many arguments");
  lua_pushstring(L, c->name);
  lua_pushstring(L, m->name);
  for (int i = 1; i <= given; i++) lua_pushvalue(L, i);
  lua_call(L, given + 2, 1);
  lua_replace(L, lua_upvalueindex(MOST));
}

/* Upvalues: the class, the method's luaL_Reg, how many values it takes with its object. */
static int guarded(lua_State *L) {
  const luaL_Reg *m = lua_touserdata(L, lua_upvalueindex(METHOD));
  if (lua_gettop(L) > lua_tointeger(L, lua_upvalueindex(MOST))) ask(L, m);
  return m->func(L);
}

void lsw_set_methods(lua_State *L, const lsw_class *c, const luaL_Reg *methods) {
  for (const luaL_Reg *m = methods; m->name; m++) {
    lua_pushlightuserdata(L, (void *)c);
    lua_pushlightuserdata(L, (void *)m);
    lua_pushinteger(L, 1);
    lua_pushcclosure(L, guarded, MOST);
    lua_setfield(L, -2, m->name);
  }
}

const char *lsw_running_method(lua_State *L) {
  lua_Debug ar;
  if (!lua_getstack(L, 0, &ar) || !lua_getinfo(L, "f", &ar)) return NULL;
  const int is_method = lua_tocfunction(L, -1) == guarded;
  lua_pop(L, 1);
  if (!is_method) return NULL;
  return ((const luaL_Reg *)lua_touserdata(L, lua_upvalueindex(METHOD)))->name;
}

/* core.count_arguments(f): f(class, method, object, ...) tells how many values a method takes, its
 * object included; INT_MAX or more: any number. */
static int mod_count_arguments(lua_State *L) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  lua_settop(L, 1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &key);
  return 0;
}

const luaL_Reg lsw_module_guard[] = {{"count_arguments", mod_count_arguments}, {NULL, NULL}};
