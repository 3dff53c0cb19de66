/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Lua module softworld.core. */
#include "bind/module.h"

#include "bind/bind_motion.h"
#include "bind/class.h"
#include "bind/locale.h"
#include "bind/mesh_child.h"

#define X(name) extern const luaL_Reg lsw_module_##name[];
#include "bind/modules.def"
#undef X

static int mod_allocated(lua_State *L) {
  lua_pushinteger(L, (lua_Integer)sw_alloc_live());
  lua_pushinteger(L, (lua_Integer)sw_alloc_count());
  return 2;
}

static int mod_fail_allocation(lua_State *L) {
  sw_alloc_fail_at((long)lsw_integer(L, 1, "fail_allocation: the number"));
  return 0;
}

static const luaL_Reg functions[] = {
    {"allocated", mod_allocated},             /* -> bytes in use, memory requests so far */
    {"fail_allocation", mod_fail_allocation}, /* makes the n-th request fail, for specs */
    {NULL, NULL}};

int luaopen_softworld_core(lua_State *L) {
  luaL_checkversion(L);
  luaL_newlib(L, functions);
  lua_pushliteral(L, SW_VERSION);
  lua_setfield(L, -2, "version");
  lsw_open_quiet(L);
  lsw_open_classes(L);
  lua_setfield(L, -2, "class");
  lsw_open_vectors(L);
  lsw_locale_open(L);
  lsw_mesh_child_open();
  lsw_motion_open_functions(L);
  lsw_motion_open_arguments();
#define X(name) luaL_setfuncs(L, lsw_module_##name, 0);
#include "bind/modules.def"
#undef X
  return 1;
}
