/* SPDX-License-Identifier: GPL-3.0-or-later */
/* core.registry() -> all registries and parameter tables as Lua tables, for help,
 * the reference pages and the contract specs. */
#include "bind/child.h"

static void set_params(lua_State *L, const sw_params *params) {
  lsw_push_params(L, params);
  lua_setfield(L, -2, "params");
}

static void push_entry(lua_State *L, const char *name, const char *summary) {
  lua_createtable(L, 0, 8);
  lsw_set_text(L, "name", name);
  lsw_set_text(L, "summary", summary);
}

static void integrators(lua_State *L) {
  for (int i = 0; sw_integrator_all()[i]; i++) {
    const sw_integrator *m = sw_integrator_all()[i];
    push_entry(L, m->name, m->summary);
    lsw_set_integer(L, "order", (size_t)m->order);
    lsw_set_flag(L, "implicit", (m->flags & SW_INTEGRATOR_IMPLICIT) != 0);
    lsw_set_flag(L, "adaptive", (m->flags & SW_INTEGRATOR_EMBEDDED) != 0);
    lsw_set_flag(L, "no_contact", (m->flags & SW_INTEGRATOR_NO_CONTACT) != 0);
    lsw_set_number(L, "leapfrog_limit", m->leapfrog_limit);
    lsw_set_number(L, "at_infinity", m->at_infinity);
    lua_rawseti(L, -2, i + 1);
  }
}

static void forces(lua_State *L) {
  static const struct {
    const char *name;
    unsigned bit;
  } flags[] = {{"inner", SW_FORCE_INNER},       {"explicit", SW_FORCE_EXPLICIT},
               {"at_place", SW_FORCE_AT_PLACE}, {"dissipative", SW_FORCE_DISSIPATIVE},
               {"frozen", SW_FORCE_FROZEN},     {"of_web", SW_FORCE_OF_WEB},
               {"on_some", SW_FORCE_ON_SOME},   {"driven", SW_FORCE_DRIVEN}};
  for (int i = 0; sw_force_all()[i]; i++) {
    const sw_force_class *f = sw_force_all()[i];
    push_entry(L, f->name, f->summary);
    for (size_t k = 0; k < sizeof flags / sizeof flags[0]; k++)
      lsw_set_flag(L, flags[k].name, (f->flags & flags[k].bit) != 0);
    lsw_set_flag(L, "history", f->state_size != NULL);
    set_params(L, &f->params);
    lua_rawseti(L, -2, i + 1);
  }
}

static void models(lua_State *L) {
  for (int i = 0; sw_wire_all()[i]; i++) {
    push_entry(L, sw_wire_all()[i]->name, sw_wire_all()[i]->summary);
    lsw_set_flag(L, "mesh", sw_wire_all()[i]->mesh != NULL);
    lua_rawseti(L, -2, i + 1);
  }
}

static void holds(lua_State *L) {
  for (int i = 0, n = 0; sw_link_all()[i]; i++) {
    if (!sw_link_all()[i]->hold) continue;
    push_entry(L, sw_link_all()[i]->name, sw_link_all()[i]->summary);
    set_params(L, &sw_link_all()[i]->params);
    lua_rawseti(L, -2, ++n);
  }
}

static void set_wrong(lua_State *L, const sw_shape_wrong *wrong) {
  lua_newtable(L);
  for (int i = 0; wrong[i].args; i++) {
    lua_createtable(L, 0, 2);
    lsw_set_text(L, "args", wrong[i].args);
    lsw_set_text(L, "message", wrong[i].message);
    lua_rawseti(L, -2, i + 1);
  }
  lua_setfield(L, -2, "wrong");
}

static void shapes(lua_State *L) {
  for (int i = 0; sw_shape_kinds()[i]; i++) {
    const sw_shape_class *c = sw_shape_class_find(sw_shape_kinds()[i]);
    const unsigned traits = sw_shape_class_traits(c);
    push_entry(L, sw_shape_kinds()[i], sw_shape_class_summary(c));
    lsw_set_text(L, "sample", sw_shape_class_sample(c));
    set_wrong(L, sw_shape_class_wrong(c));
    lsw_set_flag(L, "flat", (traits & SW_SHAPE_FLAT) != 0);
    lsw_set_flag(L, "faced", (traits & SW_SHAPE_FACED) != 0);
    lsw_set_flag(L, "listed", (traits & SW_SHAPE_LISTED) != 0);
    lsw_set_flag(L, "convex", sw_shape_class_convex(c));
    set_params(L, sw_shape_class_params(c));
    lua_rawseti(L, -2, i + 1);
  }
}

static void readouts(lua_State *L) {
  for (int i = 0; sw_readout_all()[i]; i++) {
    const sw_readout *r = sw_readout_all()[i];
    push_entry(L, r->name, r->summary);
    lsw_set_text(L, "unit", r->unit);
    lsw_set_flag(L, "at_place", r->at_place);
    lua_rawseti(L, -2, i + 1);
  }
}

static void params(lua_State *L) {
  const struct {
    const char *name;
    const sw_params *params;
  } tables[] = {{"scene", &sw_scene_params},
                {"wire", &sw_wire_params},
                {"wire_mesh", &sw_wire_mesh_params},
                {"remodel", &sw_remodel_params},
                {"section", &sw_section_params},
                {"obstacle", &sw_obstacle_params},
                {"run", &sw_run_params},
                {"settle", &sw_settle_params},
                {"frequencies", &sw_modes_params},
                {"wire_contact", &sw_wire_contact_params},
                {"join", &sw_link_find("join")->params},
                {"minimise", &sw_minimise_params},
                {"particles", &sw_particles_params},
                {"repel", &sw_repel_pairs_params},
                {"calibrate", &sw_calibrate_params},
                {"calibrate_tube", &sw_tube_params},
                {"calibrate_radial", &sw_radial_params},
                {"calibrate_cubic", &sw_cubic_params},
                {"calibrate_composite", &sw_composite_params}};
  for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
    lsw_push_params(L, tables[i].params);
    lua_setfield(L, -2, tables[i].name);
  }
}

static int mod_registry(lua_State *L) {
  static const struct {
    const char *name;
    void (*fill)(lua_State *L);
  } parts[] = {
      {"integrators", integrators}, {"forces", forces},     {"models", models}, {"holds", holds},
      {"shapes", shapes},           {"readouts", readouts}, {"params", params}};
  lua_newtable(L);
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
    lua_newtable(L);
    parts[i].fill(L);
    lua_setfield(L, -2, parts[i].name);
  }
  return 1;
}

const luaL_Reg lsw_module_registry[] = {{"registry", mod_registry}, {NULL, NULL}};
