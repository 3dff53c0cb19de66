/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class wire and scene:wire. */
#include <string.h>

#include "bind/child.h"
#include "bind/share.h"

int lsw_read_model(lua_State *L, int table) {
  const char *names[32];
  size_t count = 0;
  while (count < 32 && sw_wire_all()[count]) names[count] = sw_wire_all()[count]->name, count++;
  if (lua_getfield(L, table, "model") == LUA_TNIL) lua_pushliteral(L, "rod");
  return (int)lsw_word(L, "wire: there is no model", "", names, count);
}

/* EI = {EI1, EI2}: returns EI2 and replaces the arguments by a copy of the table
 * with EI = EI1. Returns NAN if EI is one number. */
static double split_stiffness(lua_State *L) {
  if (lua_getfield(L, 2, "EI") != LUA_TTABLE) {
    lua_settop(L, 2);
    return NAN;
  }
  double EI[2] = {0, 0};
  lsw_only_items(L, 3, "wire: EI");
  for (int k = 0; k < 2 && lua_rawlen(L, 3) == 2; k++) {
    lua_geti(L, 3, k + 1);
    EI[k] = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : 0;
    lua_pop(L, 1);
  }
  for (int k = 0; k < 2; k++) {
    if (!(EI[k] > 0))
      luaL_error(L, "wire: EI must be a number [N m2] or {EI1, EI2}, both above 0, got table");
    if (!(EI[k] <= SW_EI_MOST))
      luaL_error(L, "wire: EI%d = %f N m2 is not allowed; it must be in (0, %f] N m2", k + 1, EI[k],
                 SW_EI_MOST);
  }
  lua_newtable(L);
  for (lua_pushnil(L); lua_next(L, 2);) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, 4);
  }
  lsw_set_number(L, "EI", EI[0]);
  lua_replace(L, 2);
  lua_settop(L, 2);
  return EI[1];
}

size_t lsw_mesh_sections(const sw_wire_class *cls, sw_wire_mesh_args *mesh, lsw_section *out) {
  sw_params_default(&sw_wire_mesh_params, mesh);
  sw_params_default(&sw_tube_params, &mesh->lattice.tube);
  sw_params_default(&sw_radial_params, &mesh->lattice.radial);
  sw_params_default(&sw_cubic_params, &mesh->lattice.cubic);
  sw_params_default(&sw_composite_params, &mesh->lattice.composite);
  mesh->recent = NULL;
  if (!cls->mesh) return 0;
  const int kind = sw_calibrate_mesh(cls->mesh);
  out[0] = (lsw_section){&sw_wire_mesh_params, mesh};
  out[1] = (lsw_section){sw_lattice_params(kind), sw_lattice_place(&mesh->lattice, kind)};
  return 2;
}

int lsw_scene_wire(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_wire_args args;
  sw_section section;
  sw_beam beam;
  size_t count;
  sw_wire_mesh_args mesh;
  lsw_section sections[4] = {{&sw_wire_params, &args}, {&sw_section_params, &section}};
  lua_settop(L, 2);
  lsw_check_table(L, 2, "scene:wire");
  const double EI2 = split_stiffness(L);
  const int model = lsw_read_model(L, 2);
  const size_t more = lsw_mesh_sections(sw_wire_all()[model], &mesh, sections + 2);
  lsw_sections(L, 2, "wire", sections, 2 + more);
  args.model = model;
  section.EI2 = EI2;
  const char *object = args.name[0] ? lua_pushfstring(L, "wire '%s'", args.name) : "wire";
  if (section.spin_inertia > 0 && !args.rolls)
    luaL_error(L, "%s: spin_inertia goes with rolls = true", object);
  mesh.section = section;
  if (more) {
    const int kind = sw_calibrate_mesh(sw_wire_all()[model]->mesh);
    LSW_DO(L, sw_calibrate_materials, object, kind, mesh.body, &mesh.lattice, &section);
  }
  LSW_DO(L, sw_section_beam, object, &section, &beam);
  if (beam.EI == 0 && strcmp(sw_wire_all()[args.model]->name, "string") != 0)
    luaL_error(L, "%s: EI = 0 N m2 is allowed with model = 'string' only", object);
  const double *points = lsw_read_points(L, 2, "path", "wire", &count);
  if (points && (isfinite(args.from.x) || isfinite(args.to.x)))
    luaL_error(L, "%s: give either path or from and to, not both", object);
  lsw_child *child = lsw_new_child(L, &lsw_class_wire);
  LSW_DO(L, sw_scene_add_wire, scene, &args, &beam, &mesh, points, count, &child->id);
  return 1;
}

/* --- read-outs ---------------------------------------------------------------- */

static sw_point_state state_at(lua_State *L, sw_status (*read)(sw_scene *, sw_handle, double,
                                                               sw_point_state *, sw_error *)) {
  sw_point_state p;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const double s = lsw_number(L, 2, "wire: s", "m");
  LSW_DO(L, read, w.scene, w.id, s, &p);
  return p;
}

static sw_point_state motion(lua_State *L) { return state_at(L, sw_scene_wire_motion); }

static int meth_position(lua_State *L) { return lsw_push_vector(L, motion(L).position), 1; }
static int meth_tangent(lua_State *L) { return lsw_push_vector(L, motion(L).tangent), 1; }
static int meth_velocity(lua_State *L) { return lsw_push_vector(L, motion(L).velocity), 1; }

static int push_readout(lua_State *L, const sw_readout *r) {
  double value;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const double s = r->at_place ? lsw_number(L, 2, "wire: s", "m") : 0.0;
  LSW_DO(L, r->read, w.scene, w.id, s, &value);
  return lua_pushnumber(L, value), 1;
}

#define READOUT(name) \
  static int read_##name(lua_State *L) { return push_readout(L, &sw_readout_##name); }
SW_READOUTS(READOUT)
#undef READOUT

static double modulus(lua_State *L) {
  sw_beam b;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  LSW_DO(L, sw_scene_wire_beam, w.scene, w.id, &b);
  return b.E;
}

static int push_fibres(lua_State *L, double factor) {
  const sw_point_state p = state_at(L, sw_scene_wire_at);
  lua_pushnumber(L, factor * p.strain);
  lua_pushnumber(L, factor * p.least_strain);
  return 2;
}

/* wire:strain(s) [-], wire:stress(s) [Pa] of the fibres outside and inside the bend */
static int meth_strain(lua_State *L) { return push_fibres(L, 1.0); }
static int meth_stress(lua_State *L) { return push_fibres(L, modulus(L)); }

static size_t node_count(lua_State *L, lsw_self w) {
  size_t n;
  LSW_DO(L, sw_scene_wire_nodes, w.scene, w.id, &n);
  return n;
}

/* Pushes places (count x 3) and their arc lengths [m]. */
static int push_places(lua_State *L, lsw_counter count, __typeof__(&sw_scene_wire_copy) copy) {
  size_t n;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  double *x = lsw_room(L, w, count, 4, &n);
  LSW_DO(L, copy, w.scene, w.id, x, x + 3 * n, NULL);
  lsw_push_flat(L, x, 3 * n);
  lsw_push_flat(L, x + 3 * n, n);
  return 2;
}

/* wire:positions() -> flat {x1, y1, z1, x2, ...} of all nodes [m], their arc lengths [m] */
static int meth_positions(lua_State *L) {
  return push_places(L, sw_scene_wire_nodes, sw_scene_wire_copy);
}

/* wire:particles() -> flat {x1, y1, z1, x2, ...} of all particles of a mesh, ring by ring, their
 * arc lengths; for any other wire the same of its nodes [m] */
static int meth_particles(lua_State *L) {
  return push_places(L, sw_scene_wire_particles, sw_scene_wire_particle_copy);
}

static int meth_velocities(lua_State *L) {
  size_t n;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  double *v = lsw_room(L, w, sw_scene_wire_nodes, 3, &n);
  LSW_DO(L, sw_scene_wire_copy, w.scene, w.id, NULL, NULL, v);
  lsw_push_flat(L, v, 3 * n);
  return 1;
}

/* wire:set_velocity(v [, omega [, about]]) */
static int meth_set_velocity(lua_State *L) { return lsw_set_velocity(L, &lsw_class_wire); }

/* Returns the run's extremes; with the options table { now = true } the present values. method: its
 * name, for messages. */
static sw_wire_extremes read_extremes(lua_State *L, const char *method) {
  sw_wire_extremes present, run;
  int now = 0;
  static const sw_param rows[] = {{"now", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, 0,
                                   "present value instead of the run's extreme"}};
  static const sw_params params = SW_PARAMS("wire", rows);
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  lsw_arguments(L, 2, method, &params, &now);
  LSW_DO(L, sw_scene_wire_extremes, w.scene, w.id, &present, &run);
  return now ? present : run;
}

static int push_extreme(lua_State *L, double value, const sw_extreme *e) {
  lua_pushnumber(L, value);
  lua_pushnumber(L, e->s);
  lua_pushnumber(L, e->time);
  return 3;
}

/* Smallest bend radius [m], where [m], when [s]; math.huge for a straight wire. */
static int meth_min_bend_radius(lua_State *L) {
  const sw_extreme x = read_extremes(L, "wire:min_bend_radius").curvature;
  return push_extreme(L, x.value > 0 ? 1.0 / x.value : HUGE_VAL, &x);
}

/* How sharp that bend is for the wire's edges, see sw_sharpness: shares of its bend [-].
 */
static int meth_bend_sharpness(lua_State *L) {
  const sw_wire_extremes e = read_extremes(L, "wire:bend_sharpness");
  lua_pushnumber(L, e.sharp.uneven);
  lua_pushnumber(L, e.sharp.swings);
  lua_pushnumber(L, e.sharp.more);
  lua_pushnumber(L, e.sharp.less);
  lua_pushnumber(L, e.sharp.round);
  return 5;
}

typedef struct tension_args {
  int now, raw;
  double window; /* [s] */
} tension_args;

static const sw_param tension_rows[] = {
    {"now", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(tension_args, now),
     "present value instead of the run's extreme"},
    {"raw", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(tension_args, raw),
     "true: value of single steps instead of means over the run's window"},
    {"window", SW_PARAM_NUMBER, "s", NAN, 0, 1e9, 0, NULL, offsetof(tension_args, window),
     "0: raw values; else the window of the run, since only its means are kept"}};
static const sw_params tension_params = SW_PARAMS("wire:max_tension", tension_rows);

/* Largest tension [N], where [m], when [s], as a mean over the run's window. { raw = true } or
 * { window = 0 }: of single steps; then the fourth value is that step's length [s]. */
static int meth_max_tension(lua_State *L) {
  sw_wire_extremes now, run;
  tension_args args;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  lsw_arguments(L, 2, "wire:max_tension", &tension_params, &args);
  const double kept = sw_scene_window(w.scene);
  if (args.window > 0 && fabs(args.window - kept) > 1e-9 * kept)
    luaL_error(L,
               "wire:max_tension: window = %f s is not available: this run has means over %f s, "
               "and raw values (window = 0); for others give scene:run{ window = }",
               args.window, kept);
  LSW_DO(L, sw_scene_wire_extremes, w.scene, w.id, &now, &run);
  if (args.now) return push_extreme(L, now.tension.value, &now.tension);
  if (!args.raw && args.window != 0) return push_extreme(L, run.tension.value, &run.tension);
  push_extreme(L, run.raw.value, &run.raw);
  lua_pushnumber(L, run.raw_span);
  return 4;
}

/* Largest strain of an outermost fibre [-], where [m], when [s]. */
static int meth_max_strain(lua_State *L) {
  const sw_extreme x = read_extremes(L, "wire:max_strain").strain;
  return push_extreme(L, x.value, &x);
}

/* Largest stress of an outermost fibre [Pa], where [m], when [s]. */
static int meth_max_stress(lua_State *L) {
  const sw_extreme x = read_extremes(L, "wire:max_stress").strain;
  return push_extreme(L, x.value * modulus(L), &x);
}

/* Largest torsion M_t / GJ [rad/m], where [m], when [s]. */
static int meth_max_torsion(lua_State *L) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const sw_extreme x = read_extremes(L, "wire:max_torsion").torsion;
  if (isfinite(x.value)) return push_extreme(L, x.value, &x);
  sw_scene_asks_other_model(w.scene);
  return luaL_error(
      L,
      "wire:max_torsion: wire '%s' is a %s, which bears no twist or has no GJ, so its "
      "torsion is not known; it is for rods and meshes",
      sw_scene_wire_name(w.scene, w.id), sw_scene_wire_model(w.scene, w.id));
}

/* Largest ovalisation of a section while the wire was a mesh [-], where [m], when [s]. */
static int meth_max_ovalisation(lua_State *L) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const sw_extreme x = read_extremes(L, "wire:max_ovalisation").ovalisation;
  if (sw_scene_wire_calibration(w.scene, w.id) || x.value > 0) return push_extreme(L, x.value, &x);
  sw_scene_asks_other_model(w.scene);
  return luaL_error(L,
                    "wire:max_ovalisation: wire '%s' is a %s, whose section does not change; this "
                    "is for meshes of particles",
                    sw_scene_wire_name(w.scene, w.id), sw_scene_wire_model(w.scene, w.id));
}

/* Where [m] and when [s] a section of springs first folded through itself in the run; its forces
 * are wrong from then on. Nothing if no section has. */
static int meth_folded(lua_State *L) {
  const sw_extreme x = read_extremes(L, "wire:folded").folding;
  if (!(x.value > 0)) return 0;
  lua_pushnumber(L, x.s);
  lua_pushnumber(L, x.time);
  return 2;
}

/* wire:log() -> flat rows of 3: t [s], largest tension [N], largest curvature [1/m]; number of rows
 */
static int meth_log(lua_State *L) { return lsw_log(L, &lsw_class_wire, SW_LOG_WIRE_SIZE); }

static int prop_length(lua_State *L) {
  double length;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  LSW_DO(L, sw_scene_wire_length, w.scene, w.id, &length);
  lua_pushnumber(L, length);
  return 1;
}

static int prop_segments(lua_State *L) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  lua_pushinteger(L, (lua_Integer)node_count(L, w) - 1);
  return 1;
}

static int push_beam(lua_State *L) {
  sw_beam b;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  LSW_DO(L, sw_scene_wire_beam, w.scene, w.id, &b);
  lua_createtable(L, 0, 5);
  lsw_set_number(L, "EA", b.EA);
  lsw_set_number(L, "EI", b.EI);
  if (b.EI_axis[0] != b.EI_axis[1]) lsw_set_flat(L, "EI", b.EI_axis, 2);
  lsw_set_number(L, "GJ", b.GJ);
  lsw_set_number(L, "mass_per_length", b.mass);
  lsw_set_number(L, "radius", b.radius);
  if (b.rolls) lsw_set_number(L, "spin_inertia", b.spin_inertia);
  return 1;
}

static int prop_radius(lua_State *L) {
  push_beam(L);
  lua_getfield(L, -1, "radius");
  return 1;
}

static int describe(lua_State *L) {
  lsw_self w;
  sw_error err;
  double length = 0;
  size_t nodes = 1;
  if (!lsw_find_self(L, &lsw_class_wire, &w)) return 1;
  const char *name = sw_scene_wire_name(w.scene, w.id);
  const char *gone = name ? NULL : sw_scene_gone_name(w.scene, w.id, &length);
  if (gone) return lsw_say(L, "wire '%s' (taken away)", gone);
  if (sw_scene_wire_length(w.scene, w.id, &length, &err) != SW_OK ||
      sw_scene_wire_nodes(w.scene, w.id, &nodes, &err) != SW_OK)
    return lsw_say(L, "wire (gone)");
  return lsw_say(L, "wire '%s': %.6g m, %zu segment%s, t = %.6g s", name, length, nodes - 1,
                 nodes == 2 ? "" : "s", sw_scene_time(w.scene));
}

#define READOUT(name) {#name, read_##name},
static const luaL_Reg methods[] = {{"position", meth_position},
                                   {"tangent", meth_tangent},
                                   {"velocity", meth_velocity},
                                   {"positions", meth_positions},
                                   {"particles", meth_particles},
                                   {"velocities", meth_velocities},
                                   {"set_velocity", meth_set_velocity},
                                   {"min_bend_radius", meth_min_bend_radius},
                                   {"bend_sharpness", meth_bend_sharpness},
                                   {"max_tension", meth_max_tension},
                                   {"strain", meth_strain},
                                   {"stress", meth_stress},
                                   {"max_strain", meth_max_strain},
                                   {"max_stress", meth_max_stress},
                                   {"max_torsion", meth_max_torsion},
                                   {"max_ovalisation", meth_max_ovalisation},
                                   {"folded", meth_folded},
                                   {"log", meth_log},
                                   {"section", lsw_wire_section},
                                   {"width", lsw_wire_width},
                                   {"contact_pressure", lsw_wire_contact_pressure},
                                   {"von_mises", lsw_wire_von_mises},
                                   {"calibration", lsw_wire_calibration},
                                   {"frequencies", lsw_wire_frequencies},
                                   {"remodel", lsw_wire_remodel},
                                   SW_READOUTS(READOUT){NULL, NULL}};
static const luaL_Reg properties[] = {{"length", prop_length},  {"segments", prop_segments},
                                      {"beam", push_beam},      {"radius", prop_radius},
                                      {"name", lsw_prop_name},  {"present", lsw_prop_alive},
                                      {"model", lsw_prop_kind}, {NULL, NULL}};

const lsw_class lsw_class_wire = {.name = "wire",
                                  .kind = SW_OF_BODY,
                                  .size = sizeof(lsw_child),
                                  .methods = methods,
                                  .describe = describe,
                                  .properties = properties,
                                  .gone = "this wire was never made"};
