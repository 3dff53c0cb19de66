/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef SW_PROBE_PROBE_H
#define SW_PROBE_PROBE_H

#include <lua.h>

/* fields(scene) -> string: its objects' fields as they lie in memory */
int lsw_probe_fields(lua_State *L);

#endif
