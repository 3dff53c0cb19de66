/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arguments, checks and result tables of objects that belong to a scene. */
#include "bind/child.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "bind/bind_motion.h"

sw_scene *lsw_check_scene(lua_State *L) {
  return ((lsw_handle *)lsw_check(L, 1, &lsw_class_scene))->object;
}

lsw_child *lsw_new_child(lua_State *L, const lsw_class *c) {
  lsw_child *child = lsw_new(L, c, 2);
  child->h.object = lsw_check(L, 1, &lsw_class_scene);
  lua_pushvalue(L, 1);
  lua_setiuservalue(L, -2, 1);
  return child;
}

static lsw_self check_at(lua_State *L, int index, const lsw_class *c) {
  lsw_child *child = lsw_check(L, index, c);
  const lsw_scene_handle *owner = child->h.object;
  sw_scene *scene = owner->h.object;
  if (!scene) luaL_error(L, "the scene of this %s has been closed", c->name);
  if (c->kind == SW_OF_BODY) /* slots of bodies change when a body leaves */
    child->id = sw_scene_body_now(scene, child->id);
  return (lsw_self){scene, child->id};
}

lsw_self lsw_check_self(lua_State *L, const lsw_class *c) { return check_at(L, 1, c); }

/* Raises an error: the value at index has the wrong type. what: a method and its argument. */
static void refuse(lua_State *L, int index, const char *wanted, const char *what) {
  luaL_error(L, "%s must be %s, got %s", what, wanted, lsw_describe(L, index));
}

sw_handle lsw_check_child_of(lua_State *L, int index, const lsw_class *c, const sw_scene *scene,
                             const char *what) {
  index = lua_absindex(L, index);
  if (!lsw_test(L, index, c)) {
    const char *article = c == &lsw_class_particles ? "" : strchr("aeiou", *c->name) ? "an " : "a ";
    refuse(L, index,
           lua_pushfstring(L, "%s%s of the scene (from scene:%s)", article, c->name, c->name),
           what);
  }
  const lsw_self child = check_at(L, index, c);
  if (child.scene != scene) luaL_error(L, "%s: this %s belongs to another scene", what, c->name);
  return child.id;
}

sw_handle lsw_check_body_of(lua_State *L, int index, const sw_scene *scene, const char *what) {
  const int loose = lsw_test(L, index, &lsw_class_particles) != NULL;
  if (!loose && !lsw_test(L, index, &lsw_class_wire))
    refuse(L, index, "a wire (from scene:wire) or particles (from scene:particles) of the scene",
           what);
  return lsw_check_child_of(L, index, loose ? &lsw_class_particles : &lsw_class_wire, scene, what);
}

int lsw_find_self(lua_State *L, const lsw_class *c, lsw_self *out) {
  const lsw_child *child = lsw_test(L, 1, c);
  const lsw_scene_handle *owner = child ? child->h.object : NULL;
  if (owner && owner->h.object) {
    *out = lsw_check_self(L, c);
    return 1;
  }
  lua_pushfstring(L, "%s (its scene has been closed)", c->name);
  return 0;
}

int lsw_say(lua_State *L, const char *format, ...) {
  char text[512];
  va_list values;
  va_start(values, format);
  vsnprintf(text, sizeof text, format, values);
  va_end(values);
  lua_pushstring(L, text);
  return 1;
}

int lsw_say_taken_back(lua_State *L, const lsw_class *c) {
  return lsw_say(L, "%s (taken back when a snapshot was restored)", c->name);
}

int lsw_not_there(lua_State *L, const lsw_class *c, const sw_scene *scene) {
  char name[SW_NAME_SIZE]; /* an error first makes a value, which may run a finaliser */
  snprintf(name, sizeof name, "%s", sw_scene_name(scene));
  return luaL_error(L, "this %s is no longer in scene '%s'", c->name, name);
}

void lsw_check_table(lua_State *L, int index, const char *what) {
  if (!lua_istable(L, index))
    luaL_error(L, "%s takes one table of parameters, got %s", what, lsw_describe(L, index));
}

int lsw_is_open(lua_State *L) {
  const lsw_class *c = lsw_class_of(L, 1);
  if (!c) return 1;
  const lsw_handle *h = lua_touserdata(L, 1);
  if (!h->object || c->kind == SW_OF_NONE) return h->object != NULL;
  const lsw_handle *scene = h->object;
  return scene->object != NULL;
}

void lsw_still_open(lua_State *L) {
  if (lsw_is_open(L)) return;
  const lsw_class *c = lsw_class_of(L, 1);
  if (c->kind == SW_OF_NONE) luaL_error(L, "%s", c->gone);
  luaL_error(L, "the scene of this %s has been closed", c->name);
}

void lsw_must(lua_State *L, sw_status status, const sw_error *err) {
  if (status != SW_OK) lsw_motion_rethrow(L, status, err);
}

double *lsw_room(lua_State *L, lsw_self w, lsw_counter counter, size_t each, size_t *count) {
  for (;;) {
    size_t now;
    LSW_DO(L, counter, w.scene, w.id, count);
    double *room = lua_newuserdatauv(L, (each * *count + 1) * sizeof *room, 0);
    LSW_DO(L, counter, w.scene, w.id, &now);
    if (now == *count) return room;
    lua_pop(L, 1);
  }
}

void lsw_push_flat(lua_State *L, const double *values, size_t n) {
  lua_createtable(L, n < INT_MAX ? (int)n : 0, 0);
  for (size_t i = 0; i < n; i++) lsw_put_number(L, i, values[i]);
}

void lsw_push_rows(lua_State *L, const double *values, size_t rows, size_t width) {
  lua_createtable(L, (int)rows, 0);
  for (size_t i = 0; i < rows; i++) {
    lsw_push_flat(L, values + i * width, width);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

void lsw_read_flat(lua_State *L, int index, double *out, size_t n) {
  index = lua_absindex(L, index);
  luaL_checktype(L, index, LUA_TTABLE);
  if (lua_rawlen(L, index) != n)
    luaL_error(L, "the list must have %d numbers, got %d", (int)n, (int)lua_rawlen(L, index));
  for (size_t i = 0; i < n; i++) {
    lua_rawgeti(L, index, (lua_Integer)i + 1);
    out[i] = lua_tonumber(L, -1);
    if (lua_type(L, -1) != LUA_TNUMBER || !isfinite(out[i]))
      luaL_error(L, "number %d of the list must be a finite number", (int)i + 1);
    lua_pop(L, 1);
  }
}

double *lsw_numbers(lua_State *L, int index, size_t n, const char *what, const char *unit) {
  index = lua_absindex(L, index);
  double *out = lua_newuserdatauv(L, n * sizeof *out, 0);
  for (size_t i = 0; i < n; i++) {
    lua_rawgeti(L, index, (lua_Integer)i + 1);
    out[i] = lsw_number(L, -1, what, unit);
    lua_pop(L, 1);
  }
  return out;
}

void lsw_set_text(lua_State *L, const char *name, const char *text) {
  lua_pushstring(L, text), lua_setfield(L, -2, name);
}

void lsw_set_flag(lua_State *L, const char *name, int flag) {
  lua_pushboolean(L, flag), lua_setfield(L, -2, name);
}

void lsw_set_number(lua_State *L, const char *name, double value) {
  lua_pushnumber(L, value), lua_setfield(L, -2, name);
}

void lsw_set_known(lua_State *L, const char *name, double value) {
  if (!isnan(value)) lsw_set_number(L, name, value);
}

void lsw_set_integer(lua_State *L, const char *name, size_t value) {
  lua_pushinteger(L, (lua_Integer)value), lua_setfield(L, -2, name);
}

void lsw_set_vector(lua_State *L, const char *name, sw_vec value) {
  lsw_push_vector(L, value), lua_setfield(L, -2, name);
}

void lsw_set_flat(lua_State *L, const char *name, const double *values, size_t n) {
  lsw_push_flat(L, values, n), lua_setfield(L, -2, name);
}

void lsw_set_points(lua_State *L, const char *name, const double *at, size_t count) {
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; i < count; i++) {
    lsw_push_vector(L, sw_vec_at(at, i));
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_setfield(L, -2, name);
}

void lsw_set_momentum(lua_State *L, const char *name, const double p[6]) {
  lua_createtable(L, 0, 2);
  lsw_set_vector(L, "linear", sw_load(p));
  lsw_set_vector(L, "angular", sw_load(p + 3));
  lua_setfield(L, -2, name);
}

void lsw_push_energy(lua_State *L, const sw_energy *e) {
  double total = 0;
  lua_createtable(L, 0, (int)e->count + 2);
  for (size_t i = 0; i < e->count; i++) {
    lsw_set_number(L, e->kind[i], e->value[i]);
    total += e->value[i];
  }
  lsw_set_number(L, "total", total);
  if (e->has_dissipated) lsw_set_number(L, "dissipated", e->dissipated); /* not in total */
}
