/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading the parts of an object of particles. Arrays belong to userdata that stay on the
 * stack. Of this room only. */
#ifndef LSW_BIND_PARTICLES_H
#define LSW_BIND_PARTICLES_H

#include "bind/child.h"

/* Numbers of particles, from 1 on in Lua: the list at index as a new array of count, numbers
 * from 0. what is for messages. NULL for an empty list. */
uint32_t *lsw_particle_numbers(lua_State *L, int index, const char *what, size_t *count);

/* Fill parts from the fields of the table at index; pushes. */
void lsw_read_parts(lua_State *L, int table, sw_particles_parts *parts);

#endif
