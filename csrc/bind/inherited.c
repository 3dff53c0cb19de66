/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields that a table of arguments inherits. */
#include "bind/inherited.h"

#include <lauxlib.h>
#include <string.h>

#include "bind/class.h"

static int is_object(lua_State *L, int index) {
  const int named = luaL_getmetafield(L, index, "__name");
  if (named != LUA_TNIL) lua_pop(L, 1);
  return named == LUA_TSTRING;
}

int lsw_inherits(lua_State *L, int index) {
  if (is_object(L, index) || luaL_getmetafield(L, index, "__index") == LUA_TNIL) return 0;
  lua_pop(L, 1);
  return 1;
}

/* Pushes the own field of the table on top of the stack; 0 and nothing if there is none. */
static int own_field(lua_State *L, const char *key) {
  lua_pushstring(L, key);
  if (lua_rawget(L, -2) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  return 0;
}

int lsw_inherited(lua_State *L, int index, const char *key) {
  const int top = lua_gettop(L);
  lua_pushvalue(L, index);
  int found = own_field(L, key);
  if (found) return lua_settop(L, top), 0;
  for (int n = 0; n < LSW_LONGEST_CHAIN && !found && lsw_base(L); n++) found = own_field(L, key);
  if (found) lua_replace(L, top + 1);
  lua_settop(L, top + found);
  return found;
}

static int get(lua_State *L) {
  lua_gettable(L, 1);
  return 1;
}

int lsw_gives(lua_State *L, int index, const char *key) {
  const unsigned stops = sw_interrupt_count();
  lua_pushcfunction(L, get);
  lua_pushvalue(L, index);
  lua_pushstring(L, key);
  const int fine = lua_pcall(L, 2, 1, 0) == LUA_OK && !lua_isnil(L, -1);
  lsw_stop_since(L, stops);
  lua_pop(L, 1);
  return fine;
}

int lsw_base(lua_State *L) {
  const int base = is_object(L, -1) ? LUA_TNIL : luaL_getmetafield(L, -1, "__index");
  if (base != LUA_TNIL) lua_remove(L, -2);
  if (base == LUA_TTABLE) return 1;
  lua_pop(L, 1);
  return 0;
}

int lsw_is_field(lua_State *L) {
  const char *key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "";
  return strncmp(key, "__", 2) != 0 && !lua_isfunction(L, -1);
}
