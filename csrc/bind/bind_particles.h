/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the parts of an object of particles, for files of this folder only. The arrays belong to
 * userdata that stay on the stack. */
#ifndef LSW_BIND_PARTICLES_H
#define LSW_BIND_PARTICLES_H

#include "bind/child.h"

/* Returns the list of particle numbers at index (from 1 in Lua) as a new array of count numbers,
 * from 0; the array's userdata is pushed. what is for messages. */
uint32_t *lsw_particle_numbers(lua_State *L, int index, const char *what, size_t *count);

/* Fills parts from the fields of the table at index; pushes the userdata of the arrays. */
void lsw_read_parts(lua_State *L, int table, sw_particles_parts *parts);

#endif
