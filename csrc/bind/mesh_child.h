/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh files are read in a child process. */
#ifndef LSW_MESH_CHILD_H
#define LSW_MESH_CHILD_H

#include <lua.h>

/* To be called before anything that may read a mesh file for L: stock Lua tells by a hook of its
 * main thread that Ctrl-C was pressed. */
void lsw_mesh_child_for(lua_State *L);

/* Have the core read its mesh files in a child process from now on. */
void lsw_mesh_child_open(void);

#endif
