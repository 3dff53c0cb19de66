/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Removal of objects from a scene, for scene:remove, which is in Lua. */
#include "bind/bind_shape.h"
#include "bind/child.h"
#include "bind/share.h"

/* core.remove_body(wire or object of particles): also releases its holds. */
static int mod_remove_body(lua_State *L) {
  const int loose = lsw_test(L, 1, &lsw_class_particles) != NULL;
  return lsw_order(L, loose ? &lsw_class_particles : &lsw_class_wire, sw_scene_remove_body);
}

/* core.remove_tool(tool): removes it with its pads. */
static int mod_remove_tool(lua_State *L) {
  return lsw_order(L, &lsw_class_tool, sw_scene_remove_tool);
}

/* core.shape_of(obstacle) -> its shape; also for a removed obstacle, which frames still show */
static int mod_shape_of(lua_State *L) {
  sw_shape *shape;
  const lsw_self o = lsw_check_self(L, &lsw_class_obstacle);
  LSW_DO(L, sw_scene_obstacle_shape, o.scene, o.id, &shape);
  lsw_push_shape(L, shape);
  return 1;
}

const luaL_Reg lsw_module_leave[] = {{"remove_body", mod_remove_body},
                                     {"remove_tool", mod_remove_tool},
                                     {"shape_of", mod_shape_of},
                                     {NULL, NULL}};
