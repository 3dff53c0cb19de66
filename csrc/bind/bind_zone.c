/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene:zone, and the distances of wires to zones. */

#include "bind/bind_shape.h"
#include "bind/child.h"

/* core.zone(scene, { shape =, at =, name =, temperature =, on = obstacle }) -> name, shape,
 * position, rotation; with `on` also the obstacle's slot, and position and rotation in its axes */
static int mod_zone(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_zone_args args;
  sw_error err = {""};
  sw_status status = SW_EINVAL;
  sw_handle on = {0};
  if (lua_getfield(L, 2, "on") != LUA_TNIL)
    on = lsw_check_child_of(L, -1, &lsw_class_obstacle, scene, "scene:zone: on");
  lua_pop(L, 1);
  const lsw_section extra = {&sw_zone_params, &args};
  sw_shape *shape = lsw_shape_from_table(L, 2, &extra, 1);
  args.on = on;
  if (lsw_is_open(L)) status = sw_scene_add_zone(scene, shape, &args, &err);
  sw_shape_release(shape);
  lsw_still_open(L);
  lsw_must(L, status, &err);
  lsw_quiet(L);
  const sw_zone *zone = sw_scene_zone(scene, sw_scene_zones(scene) - 1);
  lua_pushstring(L, zone->name);
  lsw_push_shape(L, zone->shape);
  lsw_push_vector(L, zone->pose.p), lsw_push_quaternion(L, zone->pose.q);
  if (!zone->on.generation) return 4;
  lua_pushinteger(L, zone->on.slot);
  lsw_push_vector(L, zone->local.p), lsw_push_quaternion(L, zone->local.q);
  return 7;
}

/* core.zones(wire) -> { { name, temperature [degC], gap [m], s [m], time [s], between [m],
 * inside [s] }, ... }; gap to inside only if a step was watched */
static int mod_zones(lua_State *L) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  lsw_quiet(L);
  const size_t count = sw_scene_zones(w.scene);
  lua_createtable(L, (int)count, 0);
  for (size_t k = 0; k < count; k++) {
    const sw_zone *z = sw_scene_zone(w.scene, k);
    const sw_zone_past *past = sw_scene_zone_past(w.scene, w.id, k);
    lua_createtable(L, 0, 7);
    lsw_set_text(L, "name", z->name);
    lsw_set_known(L, "temperature", z->temperature);
    if (past) {
      lsw_set_number(L, "gap", past->gap);
      lsw_set_number(L, "s", past->s);
      lsw_set_number(L, "time", past->time);
      lsw_set_number(L, "between", past->between);
      lsw_set_number(L, "inside", past->inside);
    }
    lua_rawseti(L, -2, (lua_Integer)k + 1);
  }
  return 1;
}

const luaL_Reg lsw_module_zone[] = {{"zone", mod_zone}, {"zones", mod_zones}, {NULL, NULL}};
