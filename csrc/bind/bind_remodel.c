/* SPDX-License-Identifier: GPL-3.0-or-later */
/* wire:remodel{ model =, ... }: changes a wire's model during a run. */
#include <math.h>

#include "bind/child.h"

/* Key of this Lua state's recent meshes in the registry. */
static const char recent_key;

static int recent_free(lua_State *L) {
  struct sw_strand_recent **recent = lua_touserdata(L, 1);
  sw_wire_recent_free(*recent);
  *recent = NULL;
  return 0;
}

/* Returns this Lua state's recent meshes. */
static struct sw_strand_recent *recent_of(lua_State *L) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &recent_key) != LUA_TUSERDATA) {
    /* NOLINTNEXTLINE(bugprone-sizeof-expression): it holds a pointer */
    struct sw_strand_recent **made = lua_newuserdatauv(L, sizeof *made, 0);
    *made = NULL;
    lua_createtable(L, 0, 1);
    lua_pushcfunction(L, recent_free);
    lua_setfield(L, -2, "__gc");
    lua_setmetatable(L, -2);
    *made = sw_wire_recent_new();
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &recent_key);
  }
  struct sw_strand_recent *recent = *(struct sw_strand_recent **)lua_touserdata(L, -1);
  lua_settop(L, 2);
  return recent;
}

/* Reads the table of arguments and returns the model. Values that the wire keeps have no keys;
 * `model` is required. */
static int read_arguments(lua_State *L, sw_wire_args *args, sw_wire_mesh_args *mesh,
                          double region[2]) {
  lsw_section sections[4] = {{&sw_remodel_params, args}};
  lsw_check_table(L, 2, "wire:remodel");
  region[0] = region[1] = (double)NAN;
  if (lua_getfield(L, 2, "region") != LUA_TNIL) {
    if (!lua_istable(L, -1) || lua_rawlen(L, -1) != 2)
      return luaL_error(L, "wire:remodel: region must be {s1, s2} [m], got %s",
                        lsw_describe(L, -1));
    lsw_only_items(L, -1, "wire:remodel: region");
    for (int k = 0; k < 2; k++) {
      lua_rawgeti(L, -1, k + 1);
      region[k] = lsw_number(L, -1, "wire:remodel: region", "m");
      lua_pop(L, 1);
    }
  }
  if (lua_getfield(L, 2, "model") == LUA_TNIL)
    return luaL_error(L, "wire:remodel: model is required: 'rod', 'string', or a mesh");
  lua_settop(L, 2);
  const int model = lsw_read_model(L, 2);
  const size_t more = lsw_mesh_sections(sw_wire_all()[model], mesh, sections + 1);
  lsw_sections(L, 2, "wire:remodel", sections, 1 + (int)more);
  return model;
}

/* wire:remodel{...} -> { energy_before, energy_after, energy_change [J], about [m], before,
 * after = momentum { linear [N s], angular about the point `about` [N m s] } } */
int lsw_wire_remodel(lua_State *L) {
  sw_wire_args args = {0};
  sw_wire_mesh_args mesh = {0}; /* its bytes are compared */
  sw_remodel_report r;
  double region[2];
  lua_settop(L, 2);
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  args.model = read_arguments(L, &args, &mesh, region);
  if (args.segments == 1)
    return luaL_error(L, "wire:remodel: segments = 1 is not allowed; it must be 2 or more");
  sw_params_default(&sw_section_params, &mesh.section);
  mesh.section.EI2 = (double)NAN;
  mesh.recent = recent_of(L);
  LSW_DO(L, sw_scene_watch_holds, w.scene, w.id);
  LSW_DO(L, sw_scene_remodel, w.scene, w.id, &args, &mesh, isnan(region[0]) ? NULL : region, &r);
  lua_createtable(L, 0, 6);
  lsw_set_number(L, "energy_before", r.energy_before);
  lsw_set_number(L, "energy_after", r.energy_after);
  lsw_set_number(L, "energy_change", r.energy_after - r.energy_before);
  lsw_set_vector(L, "about", r.about);
  lsw_set_momentum(L, "before", r.before);
  lsw_set_momentum(L, "after", r.after);
  return 1;
}
