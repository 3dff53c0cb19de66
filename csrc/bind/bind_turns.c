/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What grip/untwisted.lua reads of a wire after steps. */
#include "bind/child.h"

static double *places_of(lua_State *L, size_t *n) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  double *x = lsw_room(L, w, sw_scene_wire_nodes, 4, n);
  LSW_DO(L, sw_scene_wire_copy, w.scene, w.id, x, x + 3 * *n, NULL);
  return x;
}

/* core.nearest_place(wire, point [m]) -> arc length of the nearest place, its distance [m] */
static int mod_nearest_place(lua_State *L) {
  const sw_vec at = lsw_vector(L, 2, "nearest_place: point", "m");
  size_t n;
  const double *x = places_of(L, &n), *s = x + 3 * n;
  double best = HUGE_VAL, place = 0;
  for (size_t i = 0; i + 1 < n; i++) {
    const sw_vec a = sw_vec_at(x, i), edge = sw_sub(sw_vec_at(x, i + 1), a);
    const double e = sw_norm2(edge), along = sw_dot(edge, sw_sub(at, a));
    const double t = e > 0 ? fmax(0.0, fmin(1.0, along / e)) : 0.0;
    const double d = sw_norm2(sw_sub(at, sw_madd(a, edge, t)));
    if (d < best) best = d, place = s[i] + t * (s[i + 1] - s[i]);
  }
  lua_pushnumber(L, place), lua_pushnumber(L, sqrt(best));
  return 2;
}

static sw_vec across(sw_vec u, sw_vec t) { return sw_madd(u, t, -sw_dot(u, t)); }

/* core.carried(wire, s1, s2, u) -> u without its part along the wire at s1, carried to s2 without
 * twist; the unit tangent of the last edge. Nothing if s1 = s2. */
static int mod_carried(lua_State *L) {
  const double s1 = lsw_number(L, 2, "carried: s1", "m"), s2 = lsw_number(L, 3, "carried: s2", "m");
  sw_vec u = lsw_vector(L, 4, "carried: u", "-"), before = sw_v(0, 0, 0);
  size_t n, seen = 0;
  const double *x = places_of(L, &n), *s = x + 3 * n;
  for (size_t k = 0; k + 1 < n; k++) {
    const size_t i = s1 > s2 ? n - 2 - k : k;
    if (!(s[i + 1] > fmin(s1, s2) && s[i] < fmax(s1, s2))) continue;
    const sw_vec t =
        sw_unit_or(sw_sub(sw_vec_at(x, i + 1), sw_vec_at(x, i)), seen ? before : sw_v(1, 0, 0));
    if (seen++) {
      const double turns = sw_dot(u, t) / fmax(1e-9, 1.0 + sw_dot(before, t));
      u = sw_madd(u, sw_add(before, t), -turns);
    } else {
      u = across(u, t);
    }
    before = t;
  }
  if (!seen) return 0;
  lsw_push_vector(L, u), lsw_push_vector(L, before);
  return 2;
}

const luaL_Reg lsw_module_turns[] = {
    {"nearest_place", mod_nearest_place}, {"carried", mod_carried}, {NULL, NULL}};
