/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene:zone, and how near wires came to zones. */
#include <math.h>

#include "bind/bind_shape.h"
#include "bind/child.h"
#include "bind/module.h"

/* core.zone(scene, { shape =, at =, name =, temperature = }) -> its name, shape, position, rotation
 */
static int mod_zone(lua_State *L) {
  sw_scene *scene = ((lsw_handle *)lsw_check(L, 1, &lsw_class_scene))->object;
  sw_zone_args args;
  sw_error err = {""};
  const lsw_section extra = {&sw_zone_params, &args};
  sw_shape *shape = lsw_shape_from_table(L, 2, &extra, 1);
  const sw_status status = sw_scene_add_zone(scene, shape, &args, &err);
  sw_shape_release(shape);
  lsw_must(L, status, &err);
  const sw_zone *zone = sw_scene_zone(scene, sw_scene_zones(scene) - 1);
  lua_pushstring(L, zone->name);
  lsw_push_shape(L, zone->shape);
  lsw_push_vector(L, zone->pose.p), lsw_push_quaternion(L, zone->pose.q);
  return 4;
}

static void set_known(lua_State *L, const char *name, double value) {
  if (!isnan(value)) lsw_set_number(L, name, value);
}

/* core.zones(wire) -> { { name, temperature [degC], and where a step was watched gap [m], s [m],
 * time [s], between [m], inside [s] }, ... } */
static int mod_zones(lua_State *L) {
  sw_scene *scene;
  const lsw_child *w = lsw_check_child(L, 1, &lsw_class_wire, &scene);
  const size_t count = sw_scene_zones(scene);
  lua_createtable(L, (int)count, 0);
  for (size_t k = 0; k < count; k++) {
    const sw_zone *z = sw_scene_zone(scene, k);
    const sw_zone_past *past = sw_scene_zone_past(scene, w->id, k);
    lua_createtable(L, 0, 7);
    lua_pushstring(L, z->name);
    lua_setfield(L, -2, "name");
    set_known(L, "temperature", z->temperature);
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

static const luaL_Reg functions[] = {{"zone", mod_zone}, {"zones", mod_zones}, {NULL, NULL}};

void lsw_open_zone(lua_State *L) { luaL_setfuncs(L, functions, 0); }
