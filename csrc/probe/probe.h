/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef SW_PROBE_PROBE_H
#define SW_PROBE_PROBE_H

#include <lua.h>

/* fields(scene) -> string: the bytes of the structs of its objects */
int lsw_probe_fields(lua_State *L);

#endif
