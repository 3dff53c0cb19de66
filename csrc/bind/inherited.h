/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters that a table of arguments inherits by the __index of its metatable: scripts make
 * variants of a table so. Objects, whose metatables have a __name, inherit none. */
#ifndef SW_BIND_INHERITED_H
#define SW_BIND_INHERITED_H

#include <lua.h>

/* 1 if the table at index may have fields beyond its own. */
int lsw_inherits(lua_State *L, int index);

enum { LSW_LONGEST_CHAIN = 100 }; /* of tables that inherit from each other; circles end here */

/* Pushes what the table at the absolute index inherits from tables under the key, and returns 1;
 * else 0. */
int lsw_inherited(lua_State *L, int index, const char *key);

/* 1 if the table at the absolute index gives a value for the key in any way. Errors of a function
 * count as none: it may raise one for each key that it does not know. */
int lsw_gives(lua_State *L, int index, const char *key);

/* Replaces the table on top of the stack by the one that it inherits from, and returns 1; else pops
 * it and returns 0. The fields of this one can be listed, unlike those behind a function. */
int lsw_base(lua_State *L);

/* 1 if the inherited key at -2 with its value at -1 is meant as a parameter: metamethods and
 * methods of a class may be in the same table. */
int lsw_is_field(lua_State *L);

#endif
