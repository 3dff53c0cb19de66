/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef LSW_MODULE_H
#define LSW_MODULE_H

#include <lua.h>

/* Push the module table softworld.core. */
int luaopen_softworld_core(lua_State *L);

#endif
