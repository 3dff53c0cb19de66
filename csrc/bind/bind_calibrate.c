/* SPDX-License-Identifier: GPL-3.0-or-later */
/* core.calibrate: finds springs of a mesh so that it has a wire's stiffness as a beam. core.cell:
 * stiffness as a beam of a mesh with given springs. */
#include <math.h>
#include <string.h>

#include "bind/child.h"

/* Calls push in protected mode, so that the caller can free the core's memory when Lua runs out of
 * memory. push gets p as light userdata and returns one value. */
static int push_protected(lua_State *L, lua_CFunction push, void *p) {
  lua_pushcfunction(L, push);
  lua_pushlightuserdata(L, p);
  return lua_pcall(L, 1, 1, 0);
}

static void set_beam(lua_State *L, const sw_cell_result *r) {
  for (int t = 0; t < SW_TARGETS; t++) lsw_set_number(L, sw_target_names[t], sw_reached(r, t));
  lsw_push_rows(L, r->S, SW_CELL_STRAINS, SW_CELL_STRAINS);
  lua_setfield(L, -2, "matrix");
}

static void set_links(lua_State *L, const sw_lattice *l) {
  lua_createtable(L, (int)l->links, 0);
  for (size_t m = 0; m < l->links; m++) {
    const sw_cell_link *link = l->link + m;
    lua_createtable(L, 0, 6);
    lsw_set_integer(L, "from", link->from + 1);
    lsw_set_integer(L, "to", link->to + 1);
    lsw_set_integer(L, "slices", (size_t)link->slices);
    lsw_set_number(L, "weight", link->weight);
    lsw_set_flag(L, "bend", link->bend);
    lsw_set_text(L, "group", sw_group_names[link->group]);
    lua_rawseti(L, -2, (lua_Integer)m + 1);
  }
  lua_setfield(L, -2, "links");
}

/* Sets the field elements: for each its particles, the slice (0 or 1) of each particle, and its
 * material. */
static void set_elements(lua_State *L, const sw_calibration *c) {
  const sw_lattice *l = &c->lattice;
  lua_createtable(L, (int)l->solids, 0);
  for (size_t m = 0; m < l->solids; m++) {
    const sw_cell_solid *solid = l->solid + m;
    lua_createtable(L, 0, 4);
    lsw_set_number(L, "modulus", c->k[solid->group]);
    lsw_set_number(L, "nu", solid->nu);
    lua_createtable(L, solid->nodes, 0);
    for (int a = 0; a < solid->nodes; a++)
      lsw_put_integer(L, a, (lua_Integer)solid->particle[a] + 1);
    lua_setfield(L, -2, "particles");
    lua_createtable(L, solid->nodes, 0);
    for (int a = 0; a < solid->nodes; a++) lsw_put_integer(L, a, 2 * a >= solid->nodes);
    lua_setfield(L, -2, "slices");
    lua_rawseti(L, -2, (lua_Integer)m + 1);
  }
  lua_setfield(L, -2, "elements");
}

/* Appends the pairs that slide on each other to links, as links without stiffness. */
static void add_slides(lua_State *L, const sw_calibration *c) {
  lua_getfield(L, -1, "links");
  for (size_t m = 0; m < c->composite.slides; m++) {
    const sw_slide *slide = c->composite.slide + m;
    const sw_vec from = sw_vec_at(c->lattice.at, slide->from);
    const sw_vec away = sw_sub(sw_vec_at(c->lattice.at, slide->to), from);
    lua_createtable(L, 0, 9);
    lsw_set_integer(L, "from", slide->from + 1);
    lsw_set_integer(L, "to", slide->to + 1);
    lsw_set_integer(L, "slices", 0);
    lsw_set_number(L, "weight", 0);
    lsw_set_flag(L, "bend", 0);
    lsw_set_flag(L, "slide", 1);
    lsw_set_text(L, "group", sw_group_names[SW_GROUP_BOND]);
    lsw_set_number(L, "gap", slide->gap);
    lsw_set_vector(L, "direction", sw_unit_or(away, sw_v(0, 0, 0)));
    lua_rawseti(L, -2, (lua_Integer)c->lattice.links + (lua_Integer)m + 1);
  }
  lua_pop(L, 1);
}

/* Sets a field of the part's name: its EA, EI and GJ. */
static void set_part(lua_State *L, const char *name, const sw_cell_result *r) {
  lua_createtable(L, 0, 3);
  lsw_set_number(L, "EA", sw_reached(r, SW_TARGET_EA));
  lsw_set_number(L, "EI", sw_reached(r, SW_TARGET_EI));
  lsw_set_number(L, "GJ", sw_reached(r, SW_TARGET_GJ));
  lua_setfield(L, -2, name);
}

/* Sets the places of the parts and the stiffness of each alone. Part 0 is the shell, 1 the first
 * core. */
static void set_composite(lua_State *L, const sw_calibration *c) {
  const sw_composite *place = &c->composite;
  add_slides(L, c);
  set_part(L, "shell", &place->shell);
  set_part(L, "core", &place->core);
  lsw_set_number(L, "bore", place->bore);
  lsw_set_number(L, "core_radius", place->core_radius);
  lsw_set_number(L, "ring_radius", place->ring_radius);
  lsw_set_points(L, "centres", &place->centre->x, place->cores);
  lua_createtable(L, (int)c->lattice.particles, 0);
  for (size_t i = 0; i < c->lattice.particles; i++)
    lsw_put_integer(L, i, (lua_Integer)sw_composite_part(place, i));
  lua_setfield(L, -2, "part");
}

/* Members of group g: springs; in the bond group also the pairs that slide. */
static size_t count_of(const sw_calibration *c, int g) {
  return c->links[g] + (g == SW_GROUP_BOND ? c->composite.slides : 0);
}

static void set_particles(lua_State *L, const sw_calibration *c) {
  const double mass = c->mass_per_length * c->lattice.spacing;
  lsw_set_points(L, "particles", c->lattice.at, c->lattice.particles);
  lsw_set_flat(L, "shares", c->lattice.share, c->lattice.particles);
  if (isnan(mass)) return;
  lua_createtable(L, (int)c->lattice.particles, 0);
  for (size_t i = 0; i < c->lattice.particles; i++)
    lsw_put_number(L, i, mass * c->lattice.share[i]);
  lua_setfield(L, -2, "mass");
}

static int push_calibration(lua_State *L) {
  const sw_calibration *c = lua_touserdata(L, 1);
  lua_createtable(L, 0, 24);
  set_beam(L, &c->reached);
  set_links(L, &c->lattice);
  set_particles(L, c);
  if (c->lattice.solids) {
    set_elements(L, c);
    lsw_set_number(L, "modulus", c->k[SW_GROUP_SOLID]);
    lsw_set_number(L, "nu", c->nu);
    if (c->composite.cores) {
      lsw_set_number(L, "core_modulus", c->k[SW_GROUP_OF_CORE + SW_GROUP_SOLID]);
      lsw_set_number(L, "core_nu", c->core_nu);
    }
    lsw_set_number(L, "scale", c->scale);
  }
  lsw_set_number(L, "spacing", c->lattice.spacing);
  lua_newtable(L);
  for (int t = 0; t < SW_TARGETS; t++) lsw_set_known(L, sw_target_names[t], c->residual[t]);
  lua_setfield(L, -2, "residuals");
  lua_newtable(L);
  for (int g = 0; g < SW_GROUPS; g++)
    if (count_of(c, g) && g != SW_GROUP_SOLID && g != SW_GROUP_OF_CORE + SW_GROUP_SOLID)
      lsw_set_number(L, sw_group_names[g], c->k[g]);
  lua_setfield(L, -2, "springs");
  lua_newtable(L);
  for (int g = 0; g < SW_GROUPS; g++)
    if (count_of(c, g)) lsw_set_integer(L, sw_group_names[g], count_of(c, g));
  lua_setfield(L, -2, "count");
  if (c->composite.cores) set_composite(L, c);
  return 1;
}

/* wire:calibration() -> the table of core.calibrate for its mesh: springs, residuals, ... */
int lsw_wire_calibration(lua_State *L) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const sw_calibration *c = sw_scene_wire_calibration(w.scene, w.id);
  const char *name = sw_scene_wire_name(w.scene, w.id), *model = sw_scene_wire_model(w.scene, w.id);
  if (!name) return luaL_error(L, "wire:calibration: the wire no longer exists");
  if (!c) {
    sw_scene_asks_other_model(w.scene);
    return luaL_error(L,
                      "wire:calibration: wire '%s' is a %s, which has no springs to calibrate; "
                      "this is for meshes of particles",
                      name, model);
  }
  lsw_quiet(L);
  lua_pushcfunction(L, push_calibration);
  lua_pushlightuserdata(L, (void *)c);
  lua_call(L, 1, 1);
  return 1;
}

/* Returns the kind of mesh. It is read before the other keys, which depend on it. */
static int read_mesh(lua_State *L) {
  const sw_param *row = sw_params_find(&sw_calibrate_params, "mesh");
  if (lua_istable(L, 1)) {
    lua_getfield(L, 1, "mesh");
    const char *word = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
    lua_pop(L, 1); /* the table keeps it */
    for (int i = 0; row->choices[i]; i++)
      if (strcmp(word, row->choices[i]) == 0) return i;
  }
  return SW_LATTICE_TUBE; /* reading the keys raises the error */
}

/* calibrate{ mesh =, EA =, EI =, GJ =, radius =, ... } -> springs, residuals, ... */
static int mod_calibrate(lua_State *L) {
  sw_calibrate_args args;
  sw_section section;
  sw_lattice_args mesh;
  sw_calibration c;
  sw_error err = {""};
  lua_settop(L, 1);
  const int kind = read_mesh(L);
  const lsw_section sections[] = {{&sw_calibrate_params, &args},
                                  {&sw_section_params, &section},
                                  {sw_lattice_params(kind), sw_lattice_place(&mesh, kind)}};
  sw_params_default(&sw_cubic_params, &mesh.cubic);
  section.EI2 = (double)NAN; /* has no row */
  lsw_sections(L, 1, "calibrate", sections, 3);
  const sw_status status = sw_calibrate(&args, &section, &mesh, &c, &err);
  const int failed = status == SW_OK && push_protected(L, push_calibration, &c) != LUA_OK;
  sw_calibration_free(&c);
  if (failed) return lua_error(L);
  lsw_must(L, status, &err);
  return 1;
}

/* --- core.cell ----------------------------------------------------------------------- */

/* Returns the flat numbers at index in a new userdata. */
static double *read_flat(lua_State *L, int index, size_t *n) {
  luaL_checktype(L, index, LUA_TTABLE);
  *n = lua_rawlen(L, index);
  double *p = lua_newuserdatauv(L, (*n + 1) * sizeof *p, 0);
  for (size_t i = 0; i < *n; i++) {
    lua_geti(L, index, (lua_Integer)i + 1);
    p[i] = luaL_checknumber(L, -1);
    lua_pop(L, 1);
  }
  return p;
}

enum { LINK_NUMBERS = 6 };

enum { SOLID_NUMBERS = 11, SOLID_GROUP = 9, SOLID_NU = 10 };

/* Returns the elements of the flat list at index in a new userdata. Each is of one of `groups`
 * groups. */
static sw_cell_solid *read_solids(lua_State *L, int index, size_t groups, size_t *n) {
  size_t numbers = 0;
  const double *list = lua_isnoneornil(L, index) ? NULL : read_flat(L, index, &numbers);
  luaL_argcheck(L, numbers % SOLID_NUMBERS == 0, index, "11 numbers an element");
  *n = numbers / SOLID_NUMBERS;
  sw_cell_solid *solid = lua_newuserdatauv(L, (*n + 1) * sizeof *solid, 0);
  for (size_t m = 0; m < *n; m++) {
    const double *l = list + SOLID_NUMBERS * m;
    luaL_argcheck(L, l[SOLID_GROUP] >= 1 && l[SOLID_GROUP] <= (double)groups, index, "no modulus");
    solid[m] = (sw_cell_solid){.nodes = l[0] == 6   ? 6
                                        : l[0] == 8 ? 8
                                                    : 0,
                               .group = (uint32_t)l[SOLID_GROUP] - 1,
                               .nu = l[SOLID_NU]};
    for (int a = 0; a < solid[m].nodes; a++) {
      luaL_argcheck(L, l[1 + a] >= 1 && l[1 + a] < 1e9, index, "a particle is out of range");
      solid[m].particle[a] = (uint32_t)l[1 + a] - 1;
    }
  }
  return solid;
}

/* cell(spacing, particles, links, stiffness [, elements]) -> { EA, EI, EI2, GJ, squeeze, matrix }.
 * particles: flat, 3 numbers each. links: flat, 6 numbers each: from and to (both from 1), slices,
 * group (from 1), weight, 1 for bending or 0. stiffness: one number for each group; for a group of
 * elements its modulus. elements: flat, 11 numbers each: number of particles (6 or 8), 8 places for
 * particles (from 1), group, nu. */
static int mod_cell(lua_State *L) {
  sw_cell_result result;
  size_t places, numbers, groups;
  const double spacing = luaL_checknumber(L, 1);
  const double *at = read_flat(L, 2, &places), *list = read_flat(L, 3, &numbers);
  const double *k = read_flat(L, 4, &groups);
  luaL_argcheck(L, places % 3 == 0, 2, "3 numbers a particle");
  luaL_argcheck(L, numbers % LINK_NUMBERS == 0, 3, "6 numbers a link");
  const size_t links = numbers / LINK_NUMBERS;
  size_t solids;
  const sw_cell_solid *solid = read_solids(L, 5, groups, &solids);
  sw_cell_link *link = lua_newuserdatauv(L, (links + 1) * sizeof *link, 0);
  for (size_t m = 0; m < links; m++) {
    const double *l = list + LINK_NUMBERS * m;
    for (int i = 0; i < LINK_NUMBERS; i++)
      luaL_argcheck(L, l[i] >= 0 && l[i] < 1e9 && (i == 2 || i > 3 || l[i] >= 1), 3,
                    "a link's number is out of range");
    link[m] = (sw_cell_link){(uint32_t)l[0] - 1, (uint32_t)l[1] - 1, (uint32_t)l[3] - 1,
                             (int)l[2],          l[5] != 0,          l[4]};
  }
  const sw_cell cell = {.spacing = spacing,
                        .particles = places / 3,
                        .links = links,
                        .groups = groups,
                        .at = at,
                        .link = link,
                        .solids = solids,
                        .solid = solid};
  LSW_DO(L, sw_cell_stiffness, &cell, k, &result, NULL);
  lua_createtable(L, 0, SW_TARGETS + 1);
  set_beam(L, &result);
  return 1;
}

const luaL_Reg lsw_module_calibrate[] = {
    {"calibrate", mod_calibrate}, {"cell", mod_cell}, {NULL, NULL}};
