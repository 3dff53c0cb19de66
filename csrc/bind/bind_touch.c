/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts of a scene: scene:wire_contact, scene:touches, scene:contacts, scene:penetration. */
#include "bind/child.h"

/* Returns the handles of the wire, or the list of wires, at the top of the stack; pushes the
 * userdata that owns them. */
static sw_handle *read_wires(lua_State *L, const sw_scene *scene, size_t *count) {
  static const char what[] = "scene:wire_contact: between";
  const int at = lua_gettop(L);
  const int single = lsw_test(L, at, &lsw_class_wire) || lsw_test(L, at, &lsw_class_particles);
  if (!single && !lua_istable(L, at))
    luaL_error(L, "%s is a wire, an object of particles or a list of these, got %s", what,
               lsw_describe(L, at));
  if (!single) lsw_only_items(L, at, what);
  *count = single ? 1 : lua_rawlen(L, at);
  if (!*count) luaL_error(L, "%s lists no wire; leave it out for all wires", what);
  sw_handle *wires = lua_newuserdatauv(L, *count * sizeof *wires, 0);
  for (size_t k = 0; k < *count; k++) {
    if (single)
      lua_pushvalue(L, at);
    else
      lua_rawgeti(L, at, (lua_Integer)k + 1);
    wires[k] = lsw_check_body_of(L, lua_gettop(L), scene, what);
    lua_pop(L, 1);
  }
  return wires;
}

int lsw_scene_wire_contact(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_wire_contact_args args;
  sw_handle *wires = NULL;
  size_t count = 0;
  lua_settop(L, 2);
  lsw_arguments(L, 2, "scene:wire_contact", &sw_wire_contact_params, &args);
  if (lua_istable(L, 2) && lua_getfield(L, 2, "between") != LUA_TNIL)
    wires = read_wires(L, scene, &count);
  LSW_DO(L, sw_scene_wire_contact, scene, &args, wires, count);
  return 0;
}

int lsw_scene_touches(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  size_t count = 0;
  LSW_DO(L, sw_scene_wire_touch_count, scene, &count);
  lsw_quiet(L);
  lua_createtable(L, (int)count, 0);
  size_t next[2] = {0, 0};
  sw_wire_touch t;
  for (size_t k = 0; sw_scene_next_touch(scene, next, &t); k++) {
    lua_createtable(L, 0, 7);
    lua_createtable(L, 2, 0);
    for (int i = 0; i < 2; i++) {
      lua_pushstring(L, t.wire[i]);
      lua_rawseti(L, -2, i + 1);
    }
    lua_setfield(L, -2, "wires");
    lsw_set_flat(L, "s", t.s, 2);
    lsw_set_vector(L, "point", t.point);
    lsw_set_vector(L, "normal", t.normal);
    lsw_set_vector(L, "force", t.force);
    lsw_set_vector(L, "friction", t.friction);
    lsw_set_number(L, "normal_force", t.normal_force);
    lua_rawseti(L, -2, (lua_Integer)k + 1);
  }
  return 1;
}

int lsw_scene_penetration(lua_State *L) {
  double now;
  sw_extreme deepest;
  LSW_DO(L, sw_scene_penetration, lsw_check_scene(L), &now, &deepest);
  lua_pushnumber(L, deepest.value);
  lua_pushnumber(L, deepest.s);
  lua_pushnumber(L, deepest.time);
  lua_pushnumber(L, now);
  return 4;
}

int lsw_scene_contacts(lua_State *L) {
  lua_pushinteger(L, (lua_Integer)sw_scene_touches(lsw_check_scene(L)));
  return 1;
}
