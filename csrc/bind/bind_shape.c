/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class shape: core.shape{ shape = "box", size = {1, 2, 3} } [m]. */
#include "bind/bind_shape.h"

#include <stddef.h>

#include "bind/child.h"
#include "bind/mesh_child.h"

typedef struct shape_handle {
  lsw_handle handle; /* object: an sw_shape */
} shape_handle;

extern const lsw_class lsw_class_shape;

/* --- making --------------------------------------------------------------- */

typedef struct kind_args {
  int kind; /* index into sw_shape_kinds() */
} kind_args;

enum { MOST_SECTIONS = 6 }; /* of the kind, its rows, and the caller's at most 4 */

/* Returns the class of the shape that the table at index names. */
static const sw_shape_class *read_kind(lua_State *L, int index, const sw_params *params) {
  kind_args args;
  if (!lua_istable(L, index))
    luaL_error(L, "obstacle: one table of parameters is needed, got %s", luaL_typename(L, index));
  lua_createtable(L, 0, 1);
  lua_getfield(L, index, "shape");
  lua_setfield(L, -2, "shape");
  lsw_arguments(L, -1, params->object, params, &args);
  lua_pop(L, 1);
  return sw_shape_class_find(sw_shape_kinds()[args.kind]);
}

/* Reads the points at the top of the stack: a flat list of numbers, or tables of three. The
 * userdata that owns the doubles replaces them on the stack. */
static void read_points(lua_State *L, const char *object, sw_shape_source *source) {
  if (!lua_istable(L, -1))
    luaL_error(L, "%s: points must be a table of numbers [m], got %s", object,
               luaL_typename(L, -1));
  const int table = lua_gettop(L);
  lsw_only_items(L, table, lua_pushfstring(L, "%s: points", object));
  lua_settop(L, table);
  const lua_Integer items = (lua_Integer)lua_rawlen(L, table);
  const int nested = lua_rawgeti(L, table, 1) == LUA_TTABLE;
  lua_pop(L, 1);
  if (!nested && items % 3 != 0)
    luaL_error(L, "%s: points has %I numbers; it must have three for each point", object, items);
  const size_t n = (size_t)(nested ? items : items / 3);
  double *to = lua_newuserdatauv(L, (3 * n + 1) * sizeof *to, 0);
  for (lua_Integer i = 1; i <= items; i++) {
    lsw_poll(L);
    lua_rawgeti(L, table, i);
    if (!nested && lua_type(L, -1) == LUA_TNUMBER) {
      to[i - 1] = lua_tonumber(L, -1); /* the core checks that it is finite */
    } else {
      const char *what = lua_pushfstring(L, "%s: points, item %I,", object, i);
      if (nested)
        sw_store(to + 3 * (i - 1), lsw_vector(L, -2, what, "m"));
      else
        lsw_number(L, -2, what, "m"); /* raises */
    }
    lua_settop(L, table + 1);
  }
  lua_replace(L, table);
  *source = (sw_shape_source){.points = to, .point_count = n};
}

static void read_bytes(lua_State *L, const char *object, sw_shape_source *source) {
  size_t n = 0;
  if (lua_type(L, -1) != LUA_TSTRING)
    luaL_error(L, "%s: data must be a string, got %s", object, luaL_typename(L, -1));
  const char *bytes = lua_tolstring(L, -1, &n);
  *source = (sw_shape_source){.bytes = bytes, .byte_count = n};
}

/* Reads arguments that rows cannot hold (points, data of a file); pushes one value. */
static void read_source(lua_State *L, int index, const sw_params *params, sw_shape_source *source) {
  *source = (sw_shape_source){0};
  if (sw_params_find(params, "points")) {
    lua_getfield(L, index, "points");
    read_points(L, params->object, source);
  } else if (sw_params_find(params, "data")) {
    lua_getfield(L, index, "data");
    read_bytes(L, params->object, source);
  } else {
    lua_pushnil(L);
  }
}

sw_shape *lsw_shape_from_table(lua_State *L, int index, const lsw_section *extra, int extra_count) {
  const sw_param kind_row = {"shape",
                             SW_PARAM_CHOICE,
                             "-",
                             NAN,
                             -INFINITY,
                             INFINITY,
                             SW_PARAM_REQUIRED,
                             sw_shape_kinds(),
                             offsetof(kind_args, kind),
                             "kind of shape"};
  const sw_params kind_params = {"obstacle", &kind_row, 1};
  lsw_section sections[MOST_SECTIONS];
  sw_shape_args args = {0};
  kind_args kind;
  sw_shape_source source;
  sw_shape *shape = NULL;
  sw_error err = {""};
  index = lua_absindex(L, index);
  const sw_shape_class *class = read_kind(L, index, &kind_params);
  const sw_params *params = sw_shape_class_params(class);
  sections[0] = (lsw_section){&kind_params, &kind};
  sections[1] = (lsw_section){params, &args};
  if (extra_count > MOST_SECTIONS - 2) luaL_error(L, "%s: too many sections", params->object);
  for (int i = 0; i < extra_count; i++) sections[2 + i] = extra[i];
  lsw_sections(L, index, params->object, sections, 2 + extra_count);
  read_source(L, index, params, &source);
  lsw_mesh_child_for(L);
  const sw_status status = sw_shape_new(class, &args, &source, &shape, &err);
  if (status != SW_OK) lsw_raise(L, status, &err);
  lua_pop(L, 1);
  return shape;
}

void lsw_push_shape(lua_State *L, sw_shape *shape) {
  shape_handle *h = lsw_new(L, &lsw_class_shape, 0);
  h->handle.object = sw_shape_retain(shape);
}

static int mod_shape(lua_State *L) {
  shape_handle *h = lsw_new(L, &lsw_class_shape, 0);
  h->handle.object = lsw_shape_from_table(L, 1, NULL, 0);
  return 1;
}

/* core.shape_params(kind): the kind's rows; without a kind, the kinds' names. */
static int mod_shape_params(lua_State *L) {
  const char *const *kinds = sw_shape_kinds();
  if (lua_isnoneornil(L, 1)) {
    lua_newtable(L);
    for (int i = 0; kinds[i]; i++) lua_pushstring(L, kinds[i]), lua_rawseti(L, -2, i + 1);
    return 1;
  }
  const sw_shape_class *class = sw_shape_class_find(luaL_checkstring(L, 1));
  if (!class) return luaL_error(L, "there is no shape '%s'", lua_tostring(L, 1));
  lsw_push_params(L, sw_shape_class_params(class));
  return 1;
}

/* --- asking --------------------------------------------------------------- */

static const sw_shape *check_shape(lua_State *L) {
  const shape_handle *h = lsw_check(L, 1, &lsw_class_shape);
  return h->handle.object;
}

static double optional_length(lua_State *L, int index, const char *what, double otherwise) {
  return lua_isnoneornil(L, index) ? otherwise : lsw_number(L, index, what, "m");
}

static void push_closest(lua_State *L, const sw_closest *c) {
  lua_createtable(L, 0, 5);
  lsw_set_number(L, "gap", c->gap);
  lsw_set_number(L, "at", c->at);
  lsw_set_vector(L, "normal", c->normal);
  lsw_set_vector(L, "point", c->point);
  lua_pushinteger(L, c->feature), lua_setfield(L, -2, "feature");
}

static int meth_kind(lua_State *L) { return lua_pushstring(L, sw_shape_kind(check_shape(L))), 1; }

/* shape:distance(p, reach) -> gap [m], normal, point [m], feature; nothing
 * if the gap is not below reach (default: any distance). */
static int meth_distance(lua_State *L) {
  const sw_shape *shape = check_shape(L);
  sw_closest c;
  const sw_vec p = lsw_vector(L, 2, "shape:distance: point", "m");
  const double reach = optional_length(L, 3, "shape:distance: reach", HUGE_VAL);
  lsw_still_open(L);
  if (!sw_shape_point(shape, p, reach, &c)) return 0;
  lua_pushnumber(L, c.gap);
  lsw_push_vector(L, c.normal);
  lsw_push_vector(L, c.point);
  lua_pushinteger(L, c.feature);
  return 4;
}

/* shape:segment(a, b, reach) -> array of contacts, nearest first. */
static int meth_segment(lua_State *L) {
  const sw_shape *shape = check_shape(L);
  sw_closest found[SW_CLOSEST_MAX];
  const sw_vec a = lsw_vector(L, 2, "shape:segment: first end", "m");
  const sw_vec b = lsw_vector(L, 3, "shape:segment: second end", "m");
  const double reach = optional_length(L, 4, "shape:segment: reach", HUGE_VAL);
  lsw_still_open(L);
  const int count = sw_shape_segment(shape, a, b, reach, found);
  lua_createtable(L, count, 0);
  for (int i = 0; i < count; i++) {
    push_closest(L, &found[i]);
    lua_rawseti(L, -2, i + 1);
  }
  return 1;
}

/* shape:sweep(a0, b0, a1, b1, margin) -> time of the first contact in [0, 1], contact; or nil. */
static int meth_sweep(lua_State *L) {
  const sw_shape *shape = check_shape(L);
  sw_closest c;
  double when;
  const sw_vec a0 = lsw_vector(L, 2, "shape:sweep: first end before", "m");
  const sw_vec b0 = lsw_vector(L, 3, "shape:sweep: second end before", "m");
  const sw_vec a1 = lsw_vector(L, 4, "shape:sweep: first end after", "m");
  const sw_vec b1 = lsw_vector(L, 5, "shape:sweep: second end after", "m");
  const double margin = optional_length(L, 6, "shape:sweep: margin", 0);
  if (margin < 0) return luaL_error(L, "shape:sweep: margin = %f m must be at least 0 m", margin);
  lsw_still_open(L);
  if (!sw_shape_sweep(shape, a0, b0, a1, b1, margin, &c, &when)) return lua_pushnil(L), 1;
  lua_pushnumber(L, when);
  push_closest(L, &c);
  return 2;
}

/* shape:roundness() -> radius that facets approximate, or 0 [m] */
static int meth_roundness(lua_State *L) {
  lua_pushnumber(L, sw_shape_roundness(check_shape(L)));
  return 1;
}

/* shape:bounds() -> lowest and highest corner [m] */
static int meth_bounds(lua_State *L) {
  const sw_bounds b = sw_shape_bounds(check_shape(L));
  lsw_push_vector(L, b.min);
  lsw_push_vector(L, b.max);
  return 2;
}

typedef struct drawn {
  const sw_shape *shape;
  sw_triangles triangles;
} drawn;

static int push_triangles(lua_State *L) {
  const sw_triangles *t = &((const drawn *)lua_touserdata(L, 1))->triangles;
  lsw_push_flat(L, t->vertices, 3 * t->vertex_count);
  lua_createtable(L, (int)(3 * t->triangle_count), 0);
  for (size_t i = 0; i < 3 * t->triangle_count; i++) lsw_put_integer(L, i, t->indices[i] + 1);
  return 2;
}

/* shape:triangles([around]) -> flat vertices [m], flat indices from 1. around: number of vertices
 * round a round shape, a multiple of 4 (default 32). */
static int meth_triangles(lua_State *L) {
  enum { LEAST = 8, MOST = 1024, USUAL = 32 };
  drawn made = {check_shape(L), {0}};
  const double around =
      lua_isnoneornil(L, 2) ? USUAL : lsw_number(L, 2, "shape:triangles: around", "-");
  if (!(around >= LEAST && around <= MOST && fmod(around, 4) == 0))
    return luaL_error(L, "shape:triangles: around = %f must be a multiple of 4 in [%d, %d]", around,
                      LEAST, MOST);
  if (sw_shape_triangles(made.shape, (int)around, &made.triangles) != SW_OK)
    return luaL_error(L, "shape:triangles: out of memory");
  lua_settop(L, 0);
  lua_pushcfunction(L, push_triangles);
  lua_pushlightuserdata(L, &made);
  const int status = lua_pcall(L, 1, 2, 0);
  sw_triangles_free(&made.triangles);
  return status == LUA_OK ? 2 : lua_error(L);
}

static int describe(lua_State *L) { return lsw_say(L, "shape: %s", sw_shape_kind(check_shape(L))); }

static void close(lsw_handle *h) { sw_shape_release(h->object); }

static const luaL_Reg methods[] = {{"kind", meth_kind},           {"distance", meth_distance},
                                   {"segment", meth_segment},     {"sweep", meth_sweep},
                                   {"bounds", meth_bounds},       {"roundness", meth_roundness},
                                   {"triangles", meth_triangles}, {NULL, NULL}};

const lsw_class lsw_class_shape = {.name = "shape",
                                   .size = sizeof(shape_handle),
                                   .methods = methods,
                                   .describe = describe,
                                   .close = close,
                                   .gone = "the shape has been closed"};

const luaL_Reg lsw_module_shape[] = {
    {"shape", mod_shape}, {"shape_params", mod_shape_params}, {NULL, NULL}};
