/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene:evaluate: energy, force and stiffness of each kind of force on a wire. */
#include <stddef.h>

#include "bind/child.h"

typedef struct probe_args {
  double rate;
  int statics;
} probe_args;

#define FLAT(name, unit, doc) \
  { name, SW_PARAM_OTHER, unit, 0, 0, 0, 0, NULL, 0, doc }

static const sw_param rows[] = {
    FLAT("positions", "m", "flat node positions (default: the wire's own)"),
    FLAT("velocities", "m/s", "flat node velocities (default: the wire's own)"),
    FLAT("direction", "m", "flat array to be multiplied by the stiffness"),
    {"rate", SW_PARAM_NUMBER, "1/s", 0, 0, HUGE_VAL, 0, NULL, offsetof(probe_args, rate),
     "adds rate times the damping to the stiffness, as a time step of 1/rate does"},
    {"statics", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, offsetof(probe_args, statics),
     "false leaves out the geometric stiffness of edges under pressure, as time steps do"},
};
static const sw_params params = SW_PARAMS("scene:evaluate", rows);

/* Returns the numbers under key as an array that a new userdata owns; NULL without the
 * key. Leaves the userdata (or nil) on the stack. */
static const double *read_flat(lua_State *L, int table, const char *key, size_t n) {
  if (table == 0 || lua_getfield(L, table, key) == LUA_TNIL) return NULL;
  if (!lua_istable(L, -1) || lua_rawlen(L, -1) != n)
    luaL_error(L, "scene:evaluate: %s must be an array of %d numbers, three for each node", key,
               (int)n);
  const double *values = lsw_numbers(L, -1, n, "scene:evaluate: an item", "-");
  lua_remove(L, -2);
  return values;
}

static void push_result(lua_State *L, const sw_probe *at, const sw_probe_result *r, size_t n) {
  lua_createtable(L, 0, 4);
  lsw_set_integer(L, "count", r->terms);
  lsw_set_number(L, "energy", r->energy);
  lsw_set_flat(L, "force", r->force, n);
  if (!at->direction) return;
  lsw_set_flat(L, "product", r->product, n);
}

/* Raises unless the wire still has n coordinates: a metamethod of an argument or a finaliser may
 * have changed it, and the arrays are of the old size. */
static void check_size(lua_State *L, lsw_self w, size_t n) {
  size_t nodes;
  LSW_DO(L, sw_scene_wire_particles, w.scene, w.id, &nodes);
  if (3 * nodes != n) luaL_error(L, "scene:evaluate: the wire was changed meanwhile");
}

/* scene:evaluate(wire, {...}) -> { kind = { count, energy [J], force [N],
 * product [N] } } for every kind of force on the wire; changes nothing. */
int lsw_scene_evaluate(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  size_t nodes;
  probe_args args;
  lua_settop(L, 3);
  const lsw_self w = {scene, lsw_check_body_of(L, 2, scene, "scene:evaluate: wire")};
  lsw_arguments(L, 3, "scene:evaluate", &params, &args);
  LSW_DO(L, sw_scene_wire_particles, scene, w.id, &nodes);
  const size_t n = 3 * nodes;
  const int table = lua_isnil(L, 3) ? 0 : 3;
  const sw_probe at = {.positions = read_flat(L, table, "positions", n),
                       .velocities = read_flat(L, table, "velocities", n),
                       .direction = read_flat(L, table, "direction", n),
                       .rate = args.rate,
                       .statics = args.statics};
  sw_probe_result r = {.force = lua_newuserdatauv(L, 2 * n * sizeof *r.force, 0)};
  r.product = r.force + n;
  lua_newtable(L);
  for (size_t i = 0; sw_force_all()[i]; i++) {
    const sw_force_class *cls = sw_force_all()[i];
    check_size(L, w, n);
    LSW_DO_FORCES(L, sw_scene_probe, scene, w.id, cls, &at, &r);
    if (r.terms == 0) continue;
    push_result(L, &at, &r, n);
    lua_setfield(L, -2, cls->name);
  }
  return 1;
}
