/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads mesh files in a child process. */
#ifndef LSW_MESH_CHILD_H
#define LSW_MESH_CHILD_H

#include <lua.h>

/* Call this before anything that may read a mesh file for L. When Ctrl-C is pressed, stock Lua sets
 * a hook on its main thread; the reading watches for this hook. */
void lsw_mesh_child_for(lua_State *L);

/* Makes the core read all mesh files in a child process. */
void lsw_mesh_child_open(void);

#endif
