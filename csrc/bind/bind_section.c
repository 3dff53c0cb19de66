/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of wires that are meshes of particles: wire:section, wire:width,
 * wire:contact_pressure, wire:von_mises. */
#include <math.h>

#include "bind/child.h"

/* Sets the field stress: E times each strain [Pa]. */
static void set_stress(lua_State *L, double E, const double *strain, size_t count) {
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; i < count; i++) lsw_put_number(L, i, E * strain[i]);
  lua_setfield(L, -2, "stress");
}

/* Sets the field height: the width along the vertical, unless the wire itself is vertical. */
static void set_height(lua_State *L, lsw_self w, double s, sw_vec tangent) {
  lsw_still_open(L);
  const sw_vec g = sw_scene_gravity(w.scene);
  const sw_vec up = sw_unit_or(sw_neg(g), sw_v(0, 0, 1));
  double height;
  if (fabs(sw_dot(up, tangent)) > 0.999) return; /* no direction across the wire points up */
  LSW_DO(L, sw_scene_wire_width, w.scene, w.id, s, up, &height);
  lsw_set_number(L, "height", height);
}

static void push_section(lua_State *L, const sw_section_shape *p) {
  lua_createtable(L, 0, 24);
  lsw_set_vector(L, "middle", p->middle);
  lsw_set_vector(L, "tangent", p->tangent);
  lsw_set_vector(L, "axis", p->axis);
  lsw_set_points(L, "outline", p->surface, p->count);
  lsw_set_points(L, "particles", p->particles, p->count);
  lsw_set_number(L, "skin", p->skin);
  lsw_set_number(L, "least_width", p->least);
  lsw_set_vector(L, "least_direction", p->least_way);
  lsw_set_number(L, "largest_width", p->largest);
  lsw_set_vector(L, "largest_direction", p->largest_way);
  lsw_set_number(L, "ovalisation", p->ovalisation);
  lsw_set_number(L, "area", p->area);
  lsw_set_number(L, "torsion", p->turn);
  lsw_set_number(L, "twist_rate", p->twist_rate);
  lsw_set_flat(L, "axial_strain", p->axial, p->count);
  lsw_set_flat(L, "hoop_strain", p->hoop, p->count);
}

/* wire:section(s) -> table */
int lsw_wire_section(lua_State *L) {
  sw_beam beam;
  size_t n;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const double s = lsw_number(L, 2, "wire:section: s", "m");
  LSW_DO(L, sw_scene_wire_beam, w.scene, w.id, &beam);
  double *room = lsw_room(L, w, sw_scene_wire_outline, 8, &n);
  sw_section_shape p = {
      .particles = room, .surface = room + 3 * n, .axial = room + 6 * n, .hoop = room + 7 * n};
  LSW_DO(L, sw_scene_wire_section, w.scene, w.id, s, &p);
  push_section(L, &p);
  lsw_set_number(L, "s", s);
  set_stress(L, beam.E, p.axial, n);
  set_height(L, w, s, p.tangent);
  return 1;
}

/* wire:width(s, direction) [m] */
int lsw_wire_width(lua_State *L) {
  double width;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const double s = lsw_number(L, 2, "wire:width: s", "m");
  const sw_vec direction = lsw_vector(L, 3, "wire:width: direction", "-");
  LSW_DO(L, sw_scene_wire_width, w.scene, w.id, s, direction, &width);
  lua_pushnumber(L, width);
  return 1;
}

/* Returns the arc length at index 2, which must be on the wire; NAN if none is given. */
static double read_place(lua_State *L, lsw_self w, const char *what) {
  sw_point_state any;
  if (lua_isnoneornil(L, 2)) return (double)NAN;
  const double s = lsw_number(L, 2, what, "m");
  LSW_DO(L, sw_scene_wire_at, w.scene, w.id, s, &any);
  return s;
}

/* --- contact ------------------------------------------------------------------------- */

typedef struct pressed {
  size_t n;
  double *x, *arc, *force, *normal, *area; /* [m], [m], [N], [N], [m2] */
} pressed;

/* Returns the contact forces on all particles; pushes the userdata that owns the arrays. */
static pressed read_pressed(lua_State *L, lsw_self w) {
  pressed p;
  p.x = lsw_room(L, w, sw_scene_wire_particles, 9, &p.n);
  p.force = p.x + 3 * p.n, p.arc = p.force + 3 * p.n;
  p.normal = p.arc + p.n, p.area = p.normal + p.n;
  LSW_DO(L, sw_scene_wire_pressed, w.scene, w.id, p.force, p.normal, p.area, p.arc);
  LSW_DO(L, sw_scene_wire_particle_copy, w.scene, w.id, p.x, p.arc, NULL);
  return p;
}

/* Arc length of the particle nearest to s [m]. */
static double nearest(const pressed *p, double s) {
  double best = p->arc[0];
  for (size_t i = 1; i < p->n; i++)
    if (fabs(p->arc[i] - s) < fabs(best - s)) best = p->arc[i];
  return best;
}

static void push_particle(lua_State *L, const pressed *p, size_t i) {
  lua_createtable(L, 0, 7);
  lsw_set_integer(L, "particle", i + 1);
  lsw_set_number(L, "s", p->arc[i]);
  lsw_set_vector(L, "at", sw_vec_at(p->x, i));
  lsw_set_vector(L, "force", sw_vec_at(p->force, i));
  lsw_set_number(L, "normal_force", p->normal[i]);
  lsw_set_number(L, "area", p->area[i]);
  lsw_set_number(L, "pressure", p->normal[i] / p->area[i]);
}

/* wire:contact_pressure([s]) -> list of the particles that obstacles press; .largest pressure [Pa],
 * .force: sum of the forces [N] */
int lsw_wire_contact_pressure(lua_State *L) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const double s = read_place(L, w, "wire:contact_pressure: s");
  const pressed p = read_pressed(L, w);
  const double only = isnan(s) ? s : nearest(&p, s);
  double largest = 0;
  lua_Integer count = 0;
  sw_vec force = sw_v(0, 0, 0);
  lua_newtable(L);
  for (size_t i = 0; i < p.n; i++) {
    if (!(p.normal[i] > 0) || !(p.area[i] > 0) || (!isnan(s) && p.arc[i] != only)) continue;
    largest = fmax(largest, p.normal[i] / p.area[i]);
    force = sw_add(force, sw_vec_at(p.force, i));
    push_particle(L, &p, i);
    lua_rawseti(L, -2, ++count);
  }
  lsw_set_number(L, "largest", largest);
  lsw_set_vector(L, "force", force);
  return 1;
}

/* --- solid elements -------------------------------------------------------------------- */

/* wire:von_mises([s]) -> list of the elements' stress; .largest [Pa], .s and .at: where [m] */
int lsw_wire_von_mises(lua_State *L) {
  size_t n, best = 0;
  lua_Integer count = 0;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  LSW_DO(L, sw_scene_wire_elements, w.scene, w.id, &n); /* refuses a wire without elements first */
  const double s = read_place(L, w, "wire:von_mises: s");
  double *mises = lsw_room(L, w, sw_scene_wire_elements, 6, &n);
  double *middle = mises + n, *arc = middle + 3 * n;
  LSW_DO(L, sw_scene_wire_mises, w.scene, w.id, mises, middle, arc);
  lua_newtable(L);
  for (size_t i = 0; i < n; i++) {
    if (!isnan(s) && (s < arc[2 * i] || s > arc[2 * i + 1])) continue;
    if (count == 0 || mises[i] > mises[best]) best = i;
    lua_createtable(L, 0, 3);
    lsw_set_number(L, "stress", mises[i]);
    lsw_set_number(L, "s", 0.5 * (arc[2 * i] + arc[2 * i + 1]));
    lsw_set_vector(L, "at", sw_vec_at(middle, i));
    lua_rawseti(L, -2, ++count);
  }
  if (count == 0) return 1;
  lsw_set_number(L, "largest", mises[best]);
  lsw_set_number(L, "s", 0.5 * (arc[2 * best] + arc[2 * best + 1]));
  lsw_set_vector(L, "at", sw_vec_at(middle, best));
  return 1;
}
