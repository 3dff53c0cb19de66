/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class particles and scene:particles. */
#include "bind/bind_particles.h"

#include "bind/share.h"

int lsw_scene_particles(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_particles_args args;
  sw_particles_parts parts = {0};
  lua_settop(L, 2);
  lsw_check_table(L, 2, "scene:particles");
  lsw_arguments(L, 2, "particles", &sw_particles_params, &args);
  lsw_read_parts(L, 2, &parts);
  lsw_child *child = lsw_new_child(L, &lsw_class_particles);
  LSW_DO(L, sw_scene_add_particles, scene, &args, &parts, &child->id);
  return 1;
}

/* scene:hold(object, { particles = {i, ...} [, at =, name =] }) -> a clamp */
int lsw_hold_particles(lua_State *L) {
  static const sw_param rows[] = {
      {"particles", SW_PARAM_OTHER, "-", 0, 0, 0, SW_PARAM_REQUIRED, NULL, 0,
       "list of the particles' numbers, from 1 on"},
      {"at", SW_PARAM_VECTOR, "m", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, SW_NAME_SIZE,
       "point to which the hold's pose belongs (default: the middle of the particles)"},
      {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, 0, "name used in messages and series"},
  };
  static const sw_params params = SW_PARAMS("hold", rows);
  struct {
    char name[SW_NAME_SIZE];
    sw_vec at; /* [m] */
  } args;
  _Static_assert(offsetof(__typeof__(args), at) == SW_NAME_SIZE, "as in the row");
  sw_scene *scene = lsw_check_scene(L);
  size_t count;
  lua_settop(L, 3);
  const sw_handle object =
      lsw_check_child_of(L, 2, &lsw_class_particles, scene, "scene:hold: the first argument");
  lsw_arguments(L, 3, "scene:hold", &params, &args);
  lua_getfield(L, 3, "particles");
  const uint32_t *list = lsw_particle_numbers(L, 4, "particles to be held", &count);
  lsw_child *child = lsw_new_child(L, &lsw_class_clamp);
  LSW_DO(L, sw_scene_hold_particles, scene, object, args.name, list, count, args.at, &child->id);
  return 1;
}

/* --- read-outs ---------------------------------------------------------------- */

static sw_particles_info info_of(lua_State *L, lsw_self *of) {
  sw_particles_info info;
  *of = lsw_check_self(L, &lsw_class_particles);
  LSW_DO(L, sw_scene_particles_info, of->scene, of->id, &info);
  return info;
}

static int push_copy(lua_State *L, int velocities) {
  lsw_self p;
  const size_t n = 3 * info_of(L, &p).particles;
  double *x = lua_newuserdatauv(L, n * sizeof *x, 0);
  LSW_DO(L, sw_scene_wire_particle_copy, p.scene, p.id, velocities ? NULL : x, NULL,
         velocities ? x : NULL);
  lsw_push_flat(L, x, n);
  return 1;
}

/* object:positions(), object:velocities() -> flat {x1, y1, z1, x2, ...} of all particles [m],
 * [m/s] */
static int meth_positions(lua_State *L) { return push_copy(L, 0); }
static int meth_velocities(lua_State *L) { return push_copy(L, 1); }

/* object:particle(i) -> position [m], velocity [m/s] */
static int meth_particle(lua_State *L) {
  lsw_self p;
  sw_vec x, v;
  info_of(L, &p);
  int whole;
  const lua_Integer i = lua_tointegerx(L, 2, &whole);
  if (!whole || i < 1)
    return luaL_error(L, "particles:particle takes the number of a particle, from 1 on, got %s",
                      lsw_describe(L, 2));
  LSW_DO(L, sw_scene_particle, p.scene, p.id, (size_t)i - 1, &x, &v);
  lsw_push_vector(L, x);
  lsw_push_vector(L, v);
  return 2;
}

/* object:links() -> three flat lists, one number for each link: pulling force [N], strain [-],
 * plastic strain [-] */
static int meth_links(lua_State *L) {
  lsw_self p;
  const size_t n = info_of(L, &p).links;
  double *values = lua_newuserdatauv(L, (3 * n + 1) * sizeof *values, 0);
  LSW_DO(L, sw_scene_particles_links, p.scene, p.id, values, values + n, values + 2 * n);
  for (size_t k = 0; k < 3; k++) lsw_push_flat(L, values + k * n, n);
  return 3;
}

/* object:energy() -> { kinetic =, stretch =, ... } of this object alone [J] */
static int meth_energy(lua_State *L) {
  lsw_self p;
  sw_energy e;
  info_of(L, &p);
  LSW_DO(L, sw_scene_body_energy, p.scene, p.id, &e);
  lsw_push_energy(L, &e);
  return 1;
}

/* Sets all velocities from the flat list at 2, three numbers for each particle. */
static int set_all(lua_State *L, lsw_self p, size_t count) {
  const size_t n = 3 * count;
  if (lua_rawlen(L, 2) != n)
    return luaL_error(L,
                      "particles:set_velocity takes {vx, vy, vz} or %d numbers, three for each "
                      "particle, got %d",
                      (int)n, (int)lua_rawlen(L, 2));
  lsw_only_items(L, 2, "particles:set_velocity: the list of velocities");
  const double *v = lsw_numbers(L, 2, n, "particles:set_velocity: an item", "m/s");
  LSW_DO(L, sw_scene_particles_set_velocities, p.scene, p.id, v);
  return 0;
}

/* object:set_velocity(v [, omega [, about]]) moves the object as a rigid body;
 * object:set_velocity(flat list) sets the velocity of each particle [m/s]. */
static int meth_set_velocity(lua_State *L) {
  lsw_self p;
  const size_t count = info_of(L, &p).particles;
  if (lua_istable(L, 2) && lua_rawlen(L, 2) > 3) return set_all(L, p, count);
  return lsw_set_velocity(L, &lsw_class_particles);
}

/* --- the class ------------------------------------------------------------------ */

static sw_particles_info info(lua_State *L) {
  lsw_self p;
  return info_of(L, &p);
}

static int prop_count(lua_State *L) {
  return lua_pushinteger(L, (lua_Integer)info(L).particles), 1;
}
static int prop_mass(lua_State *L) { return lua_pushnumber(L, info(L).mass), 1; }
static int prop_radius(lua_State *L) { return lua_pushnumber(L, info(L).radius), 1; }

static int describe(lua_State *L) {
  lsw_self p;
  sw_error err;
  sw_particles_info info;
  if (!lsw_find_self(L, &lsw_class_particles, &p)) return 1;
  const char *gone = sw_scene_gone_name(p.scene, p.id, &info.mass);
  if (gone) return lsw_say(L, "particles '%s' (taken away)", gone);
  if (sw_scene_particles_info(p.scene, p.id, &info, &err) != SW_OK)
    return lsw_say(L, "particles (gone)");
  return lsw_say(L, "particles '%s': %zu of them, %zu links, %zu folds, %zu elements, %.6g kg",
                 sw_scene_wire_name(p.scene, p.id), info.particles, info.links, info.folds,
                 info.elements, info.mass);
}

static const luaL_Reg methods[] = {{"positions", meth_positions},
                                   {"velocities", meth_velocities},
                                   {"particle", meth_particle},
                                   {"links", meth_links},
                                   {"energy", meth_energy},
                                   {"set_velocity", meth_set_velocity},
                                   {NULL, NULL}};
static const luaL_Reg properties[] = {{"name", lsw_prop_name}, {"present", lsw_prop_alive},
                                      {"count", prop_count},   {"mass", prop_mass},
                                      {"radius", prop_radius}, {NULL, NULL}};

const lsw_class lsw_class_particles = {.name = "particles",
                                       .kind = SW_OF_BODY,
                                       .size = sizeof(lsw_child),
                                       .methods = methods,
                                       .describe = describe,
                                       .properties = properties,
                                       .gone = "these particles were never made"};
