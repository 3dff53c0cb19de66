/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common methods: name, kind, pose, velocity, following another object, log. */
#include "bind/share.h"

#include <stdio.h>

#include "bind/bind_motion.h"

int lsw_order(lua_State *L, const lsw_class *c,
              sw_status (*order)(sw_scene *scene, sw_handle id, sw_error *err)) {
  const lsw_self self = lsw_check_self(L, c);
  LSW_DO(L, order, self.scene, self.id);
  return 0;
}

static sw_identity identify(lua_State *L, int must) {
  const lsw_class *c = lsw_class_of(L, 1);
  const lsw_self self = lsw_check_self(L, c);
  const sw_identity is = sw_scene_identify(self.scene, c->kind, self.id);
  if (must && !is.name) lsw_not_there(L, c, self.scene);
  return is;
}

int lsw_prop_name(lua_State *L) { return lua_pushstring(L, identify(L, 1).name), 1; }
int lsw_prop_kind(lua_State *L) { return lua_pushstring(L, identify(L, 1).kind), 1; }
int lsw_prop_alive(lua_State *L) { return lua_pushboolean(L, identify(L, 0).alive), 1; }

int lsw_set_velocity(lua_State *L, const lsw_class *c) {
  static const char *const words[] = {"velocity", "omega", "about"};
  static const char *const units[] = {"m/s", "rad/s", "m"};
  sw_vec v[3] = {{0}};
  char what[64];
  const lsw_self b = lsw_check_self(L, c);
  for (int k = 0; k < 3; k++) {
    if (k > 0 && lua_isnoneornil(L, 2 + k)) continue;
    snprintf(what, sizeof what, "%s:set_velocity: %s", c->name, words[k]);
    v[k] = lsw_vector(L, 2 + k, what, units[k]);
  }
  LSW_DO(L, sw_scene_wire_set_velocity, b.scene, b.id, v[0], v[1], v[2]);
  return 0;
}

int lsw_pose(lua_State *L, const lsw_class *cls) {
  sw_pose pose;
  const lsw_self c = lsw_check_self(L, cls);
  if (lua_gettop(L) > 1) {
    lua_settop(L, 3);
    const sw_vec to = lsw_place(L, 2, lua_pushfstring(L, "%s:pose: position", cls->name));
    LSW_DO(L, sw_scene_editable, c.scene);
    if (lua_isnil(L, 3))
      LSW_DO(L, sw_scene_object_pose, c.scene, cls->kind, c.id, &pose);
    else
      pose.q = lsw_rotation(L, 3, lua_pushfstring(L, "%s:pose: rotation", cls->name));
    pose.p = to;
    LSW_DO(L, sw_scene_object_put, c.scene, cls->kind, c.id, pose);
    return 0;
  }
  LSW_DO(L, sw_scene_object_pose, c.scene, cls->kind, c.id, &pose);
  lsw_push_vector(L, pose.p);
  lsw_push_quaternion(L, pose.q);
  return 2;
}

int lsw_follow(lua_State *L, const lsw_class *cls, const char *mover) {
  sw_error err = {""};
  const lsw_self c = lsw_check_self(L, cls);
  sw_status status = SW_EINVAL;
  if (lua_isnone(L, 2))
    return luaL_error(L, "%s:follow: a trajectory is needed, or nil to stop", cls->name);
  sw_motion *motion = lua_isnil(L, 2) ? NULL : lsw_motion_from(L, 2, mover);
  if (lsw_is_open(L)) status = sw_scene_object_follow(c.scene, cls->kind, c.id, motion, 0, &err);
  lua_pushnumber(L, motion ? sw_motion_end(motion) : 0.0);
  sw_motion_release(motion);
  lsw_still_open(L);
  lsw_must(L, status, &err);
  return 1;
}

/* Number of rows with times up to t, or, if before, below t. The rows are sorted by time. */
static size_t rows_until(const double *rows, size_t count, size_t size, double t, int before) {
  size_t low = 0, high = count;
  while (low < high) {
    const size_t middle = low + (high - low) / 2;
    const double at = rows[middle * size];
    if (before ? at < t : at <= t)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static double time_at(lua_State *L, int at, const lsw_class *c, double usual) {
  if (lua_isnoneornil(L, at)) return usual;
  const double t = lua_isnumber(L, at) ? lua_tonumber(L, at) : (double)NAN;
  if (isnan(t))
    luaL_error(L, "%s:log: t%d must be a time [s], got %s", c->name, at - 1, lsw_describe(L, at));
  return t;
}

size_t lsw_log_rows(lua_State *L, const lsw_class *c, size_t size, const double **rows) {
  size_t count;
  const lsw_self child = lsw_check_self(L, c);
  const double from = time_at(L, 2, c, -HUGE_VAL), to = time_at(L, 3, c, HUGE_VAL);
  LSW_DO(L, sw_scene_log, child.scene, c->kind, child.id, rows, &count);
  lsw_quiet(L); /* the rows are the scene's */
  if (!count) return 0;
  const size_t first = rows_until(*rows, count, size, from, 1), skip = first ? first - 1 : 0;
  const size_t end = rows_until(*rows, count, size, to, 0);
  *rows += skip * size;
  if (end < count) count = end + 1;
  return count > skip ? count - skip : 0;
}

int lsw_log(lua_State *L, const lsw_class *c, size_t size) {
  const double *rows;
  const size_t count = lsw_log_rows(L, c, size, &rows);
  lsw_push_flat(L, rows, count * size);
  lua_pushinteger(L, (lua_Integer)count);
  return 2;
}
