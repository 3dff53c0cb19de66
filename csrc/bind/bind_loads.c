/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks and loads of recorded steps. Lists are flat. */
#include <stdint.h>

#include "bind/child.h"
#include "bind/class.h"

static double item(lua_State *L, int index, size_t i) {
  int known;
  lua_rawgeti(L, index, (lua_Integer)i + 1);
  const double x = lua_tonumberx(L, -1, &known);
  if (!known)
    luaL_error(L, "list %d: item %I must be a number, got %s", index, (LUAI_UACINT)i + 1,
               luaL_typename(L, -1));
  lua_pop(L, 1);
  return x;
}

/* The length of a list with holes may be any number. */
static void *room(lua_State *L, size_t count, size_t size) {
  if (count > SIZE_MAX / size) luaL_error(L, "the list is too long");
  return lua_newuserdatauv(L, (count ? count : 1) * size, 0);
}

static size_t groups_at(lua_State *L, int index, size_t each) {
  luaL_checktype(L, index, LUA_TTABLE);
  return lua_rawlen(L, index) / each;
}

static void set_known(lua_State *L, const char *name, double value) {
  if (!isnan(value)) lsw_set_number(L, name, value);
}

static void push_peak(lua_State *L, const sw_peak *p, double width) {
  lua_createtable(L, 0, 9);
  lsw_set_number(L, "value", p->value), set_known(L, "time", p->time);
  lsw_set_number(L, "raw", p->raw), set_known(L, "raw_time", p->raw_time);
  lsw_set_number(L, "raw_span", p->raw_span), lsw_set_number(L, "width", width);
  set_known(L, "whole", p->whole), set_known(L, "span", p->span);
  if (!p->coarse) return;
  lua_pushboolean(L, 1);
  lua_setfield(L, -2, "coarse");
}

/* Returns a flat list of t0, t1, x, y, z as spans; pushes their room. */
static sw_lapses spans_at(lua_State *L, int index) {
  const size_t n = groups_at(L, index, 5);
  sw_lapse *span = room(L, n, sizeof *span);
  for (size_t i = 0; i < n; i++) {
    const size_t at = 5 * i;
    span[i] = (sw_lapse){item(L, index, at),
                         item(L, index, at + 1),
                         {item(L, index, at + 2), item(L, index, at + 3), item(L, index, at + 4)}};
  }
  return (sw_lapses){span, room(L, n, sizeof(double[3])), n};
}

/* core.peak({ t0, t1, x, y, z, ... }, width) -> { value, time, raw, raw_time, raw_span, width,
 * whole, span, coarse }, see sw_peak */
static int mod_peak(lua_State *L) {
  const double width = luaL_checknumber(L, 2);
  const sw_lapses s = spans_at(L, 1);
  const sw_peak p = sw_peak_of(&s, width);
  push_peak(L, &p, width);
  return 1;
}

/* core.longest_span({ t0, t1, x, y, z, ... }, time, width) -> longest step in the window that ends
 * at a time [s] */
static int mod_longest_span(lua_State *L) {
  const double time = luaL_checknumber(L, 2), width = luaL_checknumber(L, 3);
  const sw_lapses s = spans_at(L, 1);
  lua_pushnumber(L, sw_peak_longest(&s, time, width));
  return 1;
}

/* core.is_coarse({ t0, t1, x, y, z, ... }, width, value, time, span) -> true for a blow that lasts
 * few steps */
static int mod_is_coarse(lua_State *L) {
  const double width = luaL_checknumber(L, 2);
  const sw_peak p = {.value = luaL_checknumber(L, 3),
                     .time = luaL_checknumber(L, 4),
                     .span = luaL_checknumber(L, 5)};
  const sw_lapses s = spans_at(L, 1);
  lua_pushboolean(L, sw_peak_is_coarse(&s, &p, width));
  return 1;
}

/* --- loads -------------------------------------------------------------------------------- */

enum { ROWS = 1, SPANS, FROM, TO, WIDTH, POINT, HELD };
enum { HOLD_ROW = SW_LOG_SPAN }; /* numbers of a row whose span is in another list */

static sw_vec vector_in(lua_State *L, size_t at) {
  return sw_v(item(L, ROWS, at), item(L, ROWS, at + 1), item(L, ROWS, at + 2));
}

static int is_zero(sw_vec v) { return v.x == 0 && v.y == 0 && v.z == 0; }

static int bears_nothing(const sw_load_row *r) {
  return is_zero(r->force) && is_zero(r->moment) && r->squeeze == 0 && isnan(r->margin);
}

/* Reads the row that begins at a place of the list. about: point for moments, or NULL. */
static sw_load_row row_at(lua_State *L, size_t at, const sw_vec *about) {
  sw_load_row r = {.t = item(L, ROWS, at), .squeeze = NAN, .margin = NAN, .slip = NAN};
  r.force = vector_in(L, at + 1), r.moment = vector_in(L, at + 4);
  if (about) {
    const sw_vec arm = sw_sub(vector_in(L, at + 7), *about);
    r.moment = sw_add(r.moment, sw_cross(arm, r.force));
  }
  return r;
}

static void read_pads(lua_State *L, size_t at, sw_load_row *r) {
  r->squeeze = item(L, ROWS, at + SW_LOG_SQUEEZE);
  r->margin = item(L, ROWS, at + SW_LOG_MARGIN), r->slip = item(L, ROWS, at + SW_LOG_SLIP);
}

/* Returns the rows of a hold's log, or of a tool's (no list of spans); pushes their room. */
static sw_load_row *rows_at(lua_State *L, size_t *count) {
  const int pads = lua_isnoneornil(L, SPANS);
  const size_t each = pads ? SW_LOG_TOOL_SIZE : HOLD_ROW, n = groups_at(L, ROWS, each);
  sw_vec about = sw_v(0, 0, 0);
  const int given = !lua_isnoneornil(L, POINT);
  if (!pads && groups_at(L, SPANS, 1) < n) luaL_argerror(L, SPANS, "a span for each row is wanted");
  if (given && groups_at(L, POINT, 3) == 1)
    about = sw_v(item(L, POINT, 0), item(L, POINT, 1), item(L, POINT, 2));
  sw_load_row *out = room(L, n, sizeof *out);
  for (size_t i = 0; i < n; i++) {
    const size_t at = each * i;
    out[i] = row_at(L, at, given ? &about : NULL);
    out[i].span = pads ? item(L, ROWS, at + SW_LOG_SPAN) : item(L, SPANS, i);
    if (pads) read_pads(L, at, &out[i]);
    out[i].idle = pads && bears_nothing(&out[i]);
  }
  *count = n;
  return out;
}

static double *held_at(lua_State *L, size_t *spans) {
  *spans = groups_at(L, HELD, 2);
  double *out = room(L, *spans, 2 * sizeof *out);
  for (size_t i = 0; i < 2 * *spans; i++) out[i] = item(L, HELD, i);
  return out;
}

static void push_loads(lua_State *L, const sw_loads *m, double width) {
  lua_createtable(L, 0, 10);
  lsw_set_number(L, "duration", m->duration);
  lsw_set_number(L, "mean_force", m->mean_force), lsw_set_number(L, "mean_moment", m->mean_moment);
  set_known(L, "squeeze", m->squeeze), set_known(L, "slip", m->slip);
  lsw_push_vector(L, m->impulse), lua_setfield(L, -2, "impulse");
  push_peak(L, &m->force, width), lua_setfield(L, -2, "force");
  push_peak(L, &m->moment, width), lua_setfield(L, -2, "moment");
  if (m->holds) push_peak(L, &m->margin, width), lua_setfield(L, -2, "margin");
}

/* core.loads(rows, spans, t1, t2, width [, point [, { from, to, ... }]]) -> { duration, impulse,
 * mean_force, mean_moment, force, moment, margin = peaks, squeeze, slip } of rows as clamp:log and
 * tool:log (spans nil) give them. point: moments are about it; from, to: times in which something
 * was held. See sw_loads. */
static int mod_loads(lua_State *L) {
  sw_loads_args a = {.t1 = luaL_checknumber(L, FROM),
                     .t2 = luaL_checknumber(L, TO),
                     .width = luaL_checknumber(L, WIDTH)};
  size_t n;
  lua_settop(L, HELD);
  if (!lua_isnil(L, HELD)) a.held = held_at(L, &a.spans);
  const sw_load_row *rows = rows_at(L, &n);
  sw_lapse *spans = room(L, n, sizeof *spans);
  double(*sums)[3] = room(L, n, sizeof *sums);
  const sw_loads m = sw_loads_over(rows, n, &a, spans, sums);
  push_loads(L, &m, a.width);
  return 1;
}

const luaL_Reg lsw_module_loads[] = {{"peak", mod_peak},
                                     {"longest_span", mod_longest_span},
                                     {"is_coarse", mod_is_coarse},
                                     {"loads", mod_loads},
                                     {NULL, NULL}};
