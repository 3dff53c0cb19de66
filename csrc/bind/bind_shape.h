/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef LSW_BIND_SHAPE_H
#define LSW_BIND_SHAPE_H

#include "bind/class.h"

/* Returns a new shape (one reference, the caller's) from the table at index. The
 * key `shape` names the kind; the other keys belong to the kind's rows or to
 * the caller's extra sections, which are filled as well. Raises for anything
 * wrong; nothing stays allocated then. */
sw_shape *lsw_shape_from_table(lua_State *L, int index, const lsw_section *extra, int extra_count);

/* Pushes a handle for a shape; takes its own reference. */
void lsw_push_shape(lua_State *L, sw_shape *shape);

#endif
