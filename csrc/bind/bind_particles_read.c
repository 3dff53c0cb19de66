/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the lists of scene:particles. An entry is a single part, as { i, j, k = 100 }, or a group
 * of parts, as { pairs = { i1, j1, i2, j2, ... }, k = 100 }. Groups make large objects fast to
 * read. */
#include <math.h>
#include <string.h>

#include "bind/bind_particles.h"

static const size_t MOST_NUMBERS = 800000000; /* in one list [-] */

/* Returns a new array; pushes the userdata that owns it. */
static void *new_array(lua_State *L, size_t count, size_t size) {
  return lua_newuserdatauv(L, count * size + 1, 0);
}

static size_t length_of(lua_State *L, int index, const char *what) {
  if (!lua_istable(L, index))
    luaL_error(L, "particles: %s must be a list, got %s", what, lsw_describe(L, index));
  const size_t n = lua_rawlen(L, index);
  if (n > MOST_NUMBERS)
    luaL_error(L, "particles: %s has %f items; at most %f", what, (double)n, (double)MOST_NUMBERS);
  return n;
}

/* The same for a list that has no names. */
static size_t items_of(lua_State *L, int index, const char *what) {
  const size_t n = length_of(L, index, what);
  lsw_only_items(L, index, lua_pushfstring(L, "particles: %s", what));
  lua_pop(L, 1);
  return n;
}

/* Returns item i (from 0) of the list at index; raises unless it is a finite number. */
static double number_at(lua_State *L, int index, size_t i, const char *what) {
  lsw_poll(L);
  lua_rawgeti(L, index, (lua_Integer)i + 1);
  if (lua_type(L, -1) != LUA_TNUMBER)
    luaL_error(L, "particles: %s, item %d, must be a number, got %s", what, (int)i + 1,
               lsw_describe(L, -1));
  const double value = lua_tonumber(L, -1);
  if (!isfinite(value))
    luaL_error(L, "particles: %s, item %d, = %f is not allowed; it must be finite", what,
               (int)i + 1, value);
  lua_pop(L, 1);
  return value;
}

/* Returns item i of the list as the number of a particle, from 0. */
static uint32_t particle_at(lua_State *L, int index, size_t i, const char *what) {
  int whole;
  lsw_poll(L);
  lua_rawgeti(L, index, (lua_Integer)i + 1);
  const lua_Integer value = lua_tointegerx(L, -1, &whole);
  if (!whole || lua_type(L, -1) != LUA_TNUMBER || value < 1 || value > (lua_Integer)UINT32_MAX)
    luaL_error(L, "particles: %s, item %d, must be the number of a particle, from 1 on, got %s",
               what, (int)i + 1, lsw_describe(L, -1));
  lua_pop(L, 1);
  return (uint32_t)(value - 1);
}

uint32_t *lsw_particle_numbers(lua_State *L, int index, const char *what, size_t *count) {
  index = lua_absindex(L, index);
  *count = items_of(L, index, what);
  uint32_t *out = new_array(L, *count, sizeof *out);
  for (size_t i = 0; i < *count; i++) out[i] = particle_at(L, index, i, what);
  return out;
}

/* --- positions and masses -------------------------------------------------------------- */

static const double *read_positions(lua_State *L, int table, size_t *count) {
  lua_getfield(L, table, "positions");
  const int list = lua_gettop(L);
  const size_t n = items_of(L, list, "positions");
  lua_rawgeti(L, list, 1);
  const int points = lua_istable(L, -1);
  lua_pop(L, 1);
  if (!points && n % 3)
    luaL_error(L, "particles: positions has %d number%s, which is not a multiple of 3", (int)n,
               n == 1 ? "" : "s");
  *count = points ? n : n / 3;
  double *out = new_array(L, 3 * *count, sizeof *out);
  for (size_t i = 0; i < n; i++) {
    if (!points) {
      out[i] = number_at(L, list, i, "positions");
      continue;
    }
    lua_rawgeti(L, list, (lua_Integer)i + 1);
    if (!lua_istable(L, -1) || lua_rawlen(L, -1) != 3)
      luaL_error(L, "particles: positions, item %d, must be {x, y, z} [m], got %s", (int)i + 1,
                 lsw_describe(L, -1));
    lsw_only_items(L, lua_gettop(L), "particles: a position");
    for (size_t k = 0; k < 3; k++) out[3 * i + k] = number_at(L, lua_gettop(L), k, "a position");
    lua_pop(L, 1);
  }
  return out;
}

static const double *read_masses(lua_State *L, int table, size_t count) {
  lua_getfield(L, table, "masses");
  const int list = lua_gettop(L), one = lua_type(L, list) == LUA_TNUMBER;
  if (!one && items_of(L, list, "masses") != count)
    luaL_error(L, "particles: masses has %d item%s for %d particle%s", (int)lua_rawlen(L, list),
               lua_rawlen(L, list) == 1 ? "" : "s", (int)count, count == 1 ? "" : "s");
  double *out = new_array(L, count, sizeof *out);
  for (size_t i = 0; i < count; i++)
    out[i] = one ? lua_tonumber(L, list) : number_at(L, list, i, "masses");
  return out;
}

/* --- lists of parts --------------------------------------------------------------------- */

/* A kind of entry: numbers of particles at 1, 2, ... or a group under a key, and values. */
typedef struct kind {
  const char *what;      /* "links" */
  const char *group[2];  /* keys of groups */
  size_t size[2];        /* particles of a part in each group */
  const char *values[5]; /* keys of values */
  double usual[4];       /* NAN: may be missing, HUGE_VAL: required */
  void (*store)(void *out, size_t i, const uint32_t *node, size_t count, const double *values);
} kind;

enum { MOST_VALUES = 4 };

static void check_keys(lua_State *L, const kind *k, int entry, size_t number) {
  const char *names[8];
  size_t count = 0;
  for (int g = 0; g < 2 && k->group[g]; g++) names[count++] = k->group[g];
  for (int v = 0; v < MOST_VALUES && k->values[v]; v++) names[count++] = k->values[v];
  for (lua_pushnil(L); lua_next(L, entry); lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING) continue;
    const char *key = lua_tostring(L, -2);
    size_t i = 0;
    while (i < count && strcmp(names[i], key) != 0) i++;
    if (i < count) continue;
    const char *near = sw_nearest_name(key, names, sizeof names[0], count);
    luaL_error(L, "particles: %s, entry %d, has no '%s'%s%s%s", k->what, (int)number + 1, key,
               near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
  }
}

/* Returns the number of the entry's group and pushes the group's list; for a single part returns -1
 * and pushes the entry. */
static int group_of(lua_State *L, const kind *k, int entry) {
  for (int g = 0; g < 2 && k->group[g]; g++) {
    if (lua_getfield(L, entry, k->group[g]) != LUA_TNIL) return g;
    lua_pop(L, 1);
  }
  lua_pushvalue(L, entry);
  return -1;
}

/* Returns the number of parts in an entry; *size: particles of each. Pushes the list of
 * group_of. */
static size_t parts_of(lua_State *L, const kind *k, int entry, size_t number, size_t *size) {
  if (!lua_istable(L, entry))
    luaL_error(L, "particles: %s, entry %d, must be a table, got %s", k->what, (int)number + 1,
               lsw_describe(L, entry));
  const int group = group_of(L, k, entry);
  const char *what = group < 0 ? k->what : k->group[group];
  const int list = lua_gettop(L);
  const size_t n = group < 0 ? length_of(L, list, what) : items_of(L, list, what);
  if (group < 0 && n != k->size[0] && n != k->size[1])
    luaL_error(
        L, "particles: %s, entry %d, must name %d%s particles, or have a list '%s'; it names %d",
        k->what, (int)number + 1, (int)k->size[0],
        k->size[1] > k->size[0] ? lua_pushfstring(L, " or %d", (int)k->size[1]) : "", k->group[0],
        (int)n);
  *size = group < 0 ? n : k->size[group];
  if (n % *size)
    luaL_error(L, "particles: %s, entry %d: %s has %d number%s, which is not a multiple of %d",
               k->what, (int)number + 1, what, (int)n, n == 1 ? "" : "s", (int)*size);
  return n / *size;
}

/* Pushes the value under each key of the entry: a number, a list of count numbers, or nil. */
static void open_values(lua_State *L, const kind *k, int entry, size_t number, size_t count) {
  for (int v = 0; v < MOST_VALUES && k->values[v]; v++) {
    const int type = lua_getfield(L, entry, k->values[v]);
    if (type == LUA_TNIL && k->usual[v] >= HUGE_VAL)
      luaL_error(L, "particles: %s, entry %d: %s is required", k->what, (int)number + 1,
                 k->values[v]);
    if (type == LUA_TNIL || type == LUA_TNUMBER) continue;
    if (type != LUA_TTABLE)
      luaL_error(L, "particles: %s, entry %d: %s must be a number or a list of them, got %s",
                 k->what, (int)number + 1, k->values[v], lsw_describe(L, -1));
    if (lua_rawlen(L, -1) != count)
      luaL_error(L, "particles: %s, entry %d: %s must have %d item%s, got %d", k->what,
                 (int)number + 1, k->values[v], (int)count, count == 1 ? "" : "s",
                 (int)lua_rawlen(L, -1));
    items_of(L, lua_gettop(L), k->values[v]);
  }
}

static void read_entry(lua_State *L, const kind *k, int entry, size_t number, void *out,
                       size_t *at) {
  size_t size;
  const size_t count = parts_of(L, k, entry, number, &size);
  const int list = lua_gettop(L);
  check_keys(L, k, entry, number);
  open_values(L, k, entry, number, count);
  for (size_t i = 0; i < count; i++) {
    uint32_t node[SW_ELEMENT_NODES];
    double values[MOST_VALUES] = {0};
    for (size_t j = 0; j < size; j++) node[j] = particle_at(L, list, size * i + j, k->what);
    for (int v = 0; v < MOST_VALUES && k->values[v]; v++) {
      const int type = lua_type(L, list + 1 + v);
      values[v] = type == LUA_TNIL      ? k->usual[v]
                  : type == LUA_TNUMBER ? lua_tonumber(L, list + 1 + v)
                                        : number_at(L, list + 1 + v, i, k->values[v]);
      if (type == LUA_TNUMBER && isnan(values[v])) values[v] = HUGE_VAL; /* NAN means not given */
    }
    k->store(out, (*at)++, node, size, values);
  }
  lua_settop(L, list - 1);
}

/* Returns the parts under the kind's name as an array of items of this size [B]; NULL without the
 * key. */
static const void *read_list(lua_State *L, int table, const kind *k, size_t item, size_t *count) {
  *count = 0;
  if (lua_getfield(L, table, k->what) == LUA_TNIL) return NULL;
  const int list = lua_gettop(L);
  const size_t entries = items_of(L, list, k->what);
  for (size_t i = 0; i < entries; i++) {
    size_t size;
    lua_rawgeti(L, list, (lua_Integer)i + 1);
    *count += parts_of(L, k, lua_gettop(L), i, &size);
    lua_settop(L, list);
  }
  char *out = new_array(L, *count, item);
  size_t at = 0;
  for (size_t i = 0; i < entries; i++) {
    lua_rawgeti(L, list, (lua_Integer)i + 1);
    read_entry(L, k, lua_gettop(L), i, out, &at);
    lua_pop(L, 1);
  }
  return out;
}

/* --- kinds of parts --------------------------------------------------------------------- */

static void store_link(void *out, size_t i, const uint32_t *node, size_t count SW_UNUSED,
                       const double *values) {
  ((sw_particles_link *)out)[i] = (sw_particles_link){.a = node[0],
                                                      .b = node[1],
                                                      .k = values[0],
                                                      .rest = values[1],
                                                      .yield = values[2],
                                                      .hardening = values[3]};
}

static void store_fold(void *out, size_t i, const uint32_t *node, size_t count SW_UNUSED,
                       const double *values) {
  ((sw_particles_fold *)out)[i] = (sw_particles_fold){node[0], node[1], node[2], values[0]};
}

static void store_element(void *out, size_t i, const uint32_t *node, size_t count,
                          const double *values) {
  sw_particles_element *e = (sw_particles_element *)out + i;
  *e = (sw_particles_element){.count = (uint32_t)count, .mu = values[0], .lambda = values[1]};
  memcpy(e->node, node, count * sizeof *node);
  if (isnan(values[2])) return;
  e->mu = values[2] / (2 * (1 + values[3])); /* Lame's constants from E and nu */
  e->lambda = values[2] * values[3] / ((1 + values[3]) * (1 - 2 * values[3]));
}

static const kind links = {.what = "links",
                           .group = {"pairs", NULL},
                           .size = {2, 2},
                           .values = {"k", "rest", "yield", "hardening", NULL},
                           .usual = {HUGE_VAL, NAN, NAN, 0},
                           .store = store_link};
static const kind folds = {.what = "folds",
                           .group = {"triples", NULL},
                           .size = {3, 3},
                           .values = {"stiffness", NULL},
                           .usual = {HUGE_VAL},
                           .store = store_fold};
static const kind elements = {.what = "elements",
                              .group = {"prisms", "hexes"},
                              .size = {SW_ELEMENT_NODES - 2, SW_ELEMENT_NODES},
                              .values = {"mu", "lambda", "E", "nu", NULL},
                              .usual = {NAN, NAN, NAN, NAN},
                              .store = store_element};

/* Raises unless each element has mu and lambda, or E and nu. */
static void check_materials(lua_State *L, const sw_particles_element *e, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (isnan(e[i].mu) || isnan(e[i].lambda))
      luaL_error(L, "particles: element %d: give mu and lambda [Pa], or E [Pa] and nu in (-1, 0.5)",
                 (int)i + 1);
}

/* Reads the surface: edges {i, j}, and triangles {i, j, k}, of which the three edges are kept. */
static void read_surface(lua_State *L, int table, sw_particles_parts *p) {
  if (lua_getfield(L, table, "surface") == LUA_TNIL) return;
  if (lua_type(L, -1) == LUA_TSTRING) {
    if (strcmp(lua_tostring(L, -1), "particles") != 0)
      luaL_error(L,
                 "particles: surface must be 'particles' or a list of edges and triangles, got "
                 "'%s'",
                 lua_tostring(L, -1));
    p->surface = SW_SURFACE_PARTICLES;
    return;
  }
  const int list = lua_gettop(L);
  const size_t entries = items_of(L, list, "surface");
  uint32_t *out = new_array(L, 6 * entries, sizeof *out);
  for (size_t i = 0; i < entries; i++) {
    lua_rawgeti(L, list, (lua_Integer)i + 1);
    const size_t n = lua_istable(L, -1) ? lua_rawlen(L, -1) : 0;
    if (n != 2 && n != 3)
      luaL_error(L, "particles: surface, entry %d, must be {i, j} or {i, j, k}, got %s", (int)i + 1,
                 lsw_describe(L, -1));
    lsw_only_items(L, lua_gettop(L), "particles: an entry of surface");
    uint32_t node[3] = {0};
    for (size_t k = 0; k < n; k++) node[k] = particle_at(L, lua_gettop(L), k, "surface");
    for (size_t k = 0; k < (n == 3 ? 3 : 1); k++, p->edges++) {
      out[2 * p->edges] = node[k];
      out[2 * p->edges + 1] = node[k < 2 ? (k + 1) : 0];
    }
    lua_pop(L, 1);
  }
  p->surface = SW_SURFACE_EDGES;
  p->edge = out;
}

void lsw_read_parts(lua_State *L, int table, sw_particles_parts *p) {
  luaL_checkstack(L, 32, "particles");
  p->positions = read_positions(L, table, &p->count);
  p->masses = read_masses(L, table, p->count);
  p->link = read_list(L, table, &links, sizeof *p->link, &p->links);
  p->fold = read_list(L, table, &folds, sizeof *p->fold, &p->folds);
  p->element = read_list(L, table, &elements, sizeof *p->element, &p->elements);
  check_materials(L, p->element, p->elements);
  read_surface(L, table, p);
  if (lua_getfield(L, table, "repel") == LUA_TNIL) return;
  lsw_arguments(L, lua_gettop(L), "particles: repel", &sw_repel_pairs_params, &p->repel);
}
