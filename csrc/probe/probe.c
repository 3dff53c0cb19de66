/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Lua module softworld.probe: solvers and a scene's fields, for specs. It is not installed, and
 * uses the core of the program that loads it. */
#include "probe/probe.h"

#include <math.h>
#include <string.h>
#include <time.h>

#include "bind/class.h"
#include "solve/band3.h"
#include "solve/band4.h"
#include "solve/blocks.h"
#include "solve/sparse.h"

static double *read_flat(lua_State *L, int index, size_t n) {
  double *p = lua_newuserdatauv(L, (n + 1) * sizeof *p, 0);
  for (size_t i = 0; i < n; i++) {
    lua_geti(L, index, (lua_Integer)i + 1);
    p[i] = luaL_checknumber(L, -1);
    lua_pop(L, 1);
  }
  return p;
}

static void push_flat(lua_State *L, const double *p, size_t n) {
  lua_createtable(L, (int)n, 0);
  for (size_t i = 0; i < n; i++) {
    lua_pushnumber(L, p[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

/* band3(rows, right) -> x, negative pivots, product. rows: flat, 24 numbers a node as in
 * solve/band3.h; right: flat, 3 numbers a node. product is rows times right. */
static int mod_band3(lua_State *L) {
  sw_error err = {""};
  size_t negative = 0;
  luaL_checktype(L, 1, LUA_TTABLE);
  luaL_checktype(L, 2, LUA_TTABLE);
  const size_t n = lua_rawlen(L, 2) / 3;
  luaL_argcheck(L, n >= 2 && lua_rawlen(L, 2) == 3 * n, 2, "3 numbers a node, at least 2 nodes");
  luaL_argcheck(L, lua_rawlen(L, 1) == SW_ROW_SIZE * n, 1, "24 numbers a node");
  double *rows = read_flat(L, 1, SW_ROW_SIZE * n), *x = read_flat(L, 2, 3 * n);
  double *product = lua_newuserdatauv(L, 3 * n * sizeof *product, 0);
  sw_band3_multiply(rows, n, x, product);
  const sw_status status = sw_band3_factor(rows, n, rows, &negative);
  if (status != SW_OK) return lsw_raise(L, status, &err);
  sw_band3_solve(rows, n, x);
  push_flat(L, x, 3 * n);
  lua_pushinteger(L, (lua_Integer)negative);
  push_flat(L, product, 3 * n);
  return 3;
}

/* band4(rows, right) -> x, negative pivots. rows: flat, 48 numbers a node. */
static int mod_band4(lua_State *L) {
  sw_error err = {""};
  size_t negative = 0;
  luaL_checktype(L, 1, LUA_TTABLE);
  luaL_checktype(L, 2, LUA_TTABLE);
  const size_t n = lua_rawlen(L, 2) / 4;
  luaL_argcheck(L, n >= 2 && lua_rawlen(L, 2) == 4 * n, 2, "4 numbers a node, at least 2 nodes");
  luaL_argcheck(L, lua_rawlen(L, 1) == SW_ROW4_SIZE * n, 1, "48 numbers a node");
  double *rows = read_flat(L, 1, SW_ROW4_SIZE * n), *x = read_flat(L, 2, 4 * n);
  const sw_status status = sw_band4_factor(rows, n, &negative);
  if (status != SW_OK) return lsw_raise(L, status, &err);
  sw_band4_solve(rows, n, x);
  push_flat(L, x, 4 * n);
  lua_pushinteger(L, (lua_Integer)negative);
  return 2;
}

/* sparse(block, own, pairs, values, right) -> x, negative pivots, fill. block: 3 or 4. own: flat,
 * diagonal blocks, block * block numbers a node; pairs: flat, two node numbers from 0 each; values:
 * flat, block * block numbers a pair; right: flat, block numbers a node. */
static int mod_sparse(lua_State *L) {
  sw_error err = {""};
  sw_sparse *s = NULL;
  size_t negative = 0;
  const size_t b = (size_t)lsw_integer(L, 1, "sparse: the size of a block");
  luaL_argcheck(L, b == 3 || b == SW_SPARSE_BLOCK_MAX, 1, "3 or 4");
  for (int k = 2; k <= 5; k++) luaL_checktype(L, k, LUA_TTABLE);
  const size_t n = lua_rawlen(L, 5) / b, pairs = lua_rawlen(L, 3) / 2, bb = b * b;
  luaL_argcheck(L, lua_rawlen(L, 2) == bb * n && lua_rawlen(L, 4) == bb * pairs, 4, "sizes differ");
  double *own = read_flat(L, 2, bb * n), *list = read_flat(L, 3, 2 * pairs);
  double *values = read_flat(L, 4, bb * pairs), *x = read_flat(L, 5, b * n);
  sw_couple *at = lua_newuserdatauv(L, (pairs + 1) * sizeof *at, 0);
  for (size_t k = 0; k < pairs; k++) {
    const double i = list[2 * k], j = list[2 * k + 1];
    luaL_argcheck(L, i >= 0 && i < (double)n && j >= 0 && j < (double)n && i != j, 3,
                  "no such node");
    at[k] = (sw_couple){(uint32_t)i, (uint32_t)j};
  }
  sw_status status = sw_sparse_new(n, b, at, pairs, NULL, &s);
  if (status != SW_OK) return lsw_raise(L, status, &err);
  sw_sparse_clear(s);
  for (size_t i = 0; i < n; i++) memcpy(sw_sparse_own(s, i), own + bb * i, bb * sizeof *own);
  for (size_t k = 0; k < pairs; k++) sw_sparse_add(s, k, values + bb * k);
  const size_t fill = sw_sparse_fill(s);
  status = sw_sparse_factor(s, &negative);
  if (status == SW_OK) sw_sparse_solve(s, x);
  sw_sparse_free(s);
  if (status != SW_OK) return lsw_raise(L, status, &err);
  push_flat(L, x, b * n);
  lua_pushinteger(L, (lua_Integer)negative);
  lua_pushinteger(L, (lua_Integer)fill);
  return 3;
}

static size_t field(lua_State *L, const char *name) {
  lua_getfield(L, 1, name);
  const lua_Integer value = lua_isnil(L, -1) ? 0 : lsw_integer(L, -1, name);
  luaL_argcheck(L, value >= 0, 1, name);
  lua_pop(L, 1);
  return (size_t)value;
}

/* Makes blocks for nodes in rings { rings, per_ring } or with pairs { nodes, pairs }. */
static sw_status new_blocks(lua_State *L, sw_blocks **out) {
  const size_t rings = field(L, "rings"), per_ring = field(L, "per_ring");
  const size_t nodes = field(L, "nodes");
  if (lua_getfield(L, 1, "pairs") != LUA_TTABLE) return sw_blocks_new_rings(rings, per_ring, out);
  const size_t count = lua_rawlen(L, -1) / 2;
  const double *list = read_flat(L, lua_gettop(L), 2 * count);
  sw_couple *pairs = lua_newuserdatauv(L, (count + 1) * sizeof *pairs, 0);
  for (size_t k = 0; k < count; k++) {
    luaL_argcheck(L, list[2 * k] >= 0 && list[2 * k + 1] >= 0, 1, "no such node");
    pairs[k] = (sw_couple){(uint32_t)list[2 * k], (uint32_t)list[2 * k + 1]};
  }
  return sw_blocks_new_sparse(nodes, pairs, count, NULL, NULL, out);
}

/* Writes the existing blocks from a dense matrix (row by row); returns their number. */
static size_t write_blocks(sw_blocks *b, const double *dense) {
  const size_t n = sw_blocks_nodes(b), stride = sw_blocks_stride(b);
  size_t count = 0;
  sw_blocks_clear(b);
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j <= i; j++) {
      const size_t slot = sw_blocks_slot(b, i, j);
      if (slot == SIZE_MAX) continue;
      count++;
      for (size_t r = 0; r < 3; r++)
        for (size_t c = 0; c < 3; c++)
          sw_blocks_values(b)[slot + r * stride + c] = dense[(3 * i + r) * 3 * n + 3 * j + c];
    }
  return count;
}

/* blocks(layout, dense, right, fixed, before) -> x, negative pivots, product, the product computed
 * row by row, number of blocks. dense: flat, all numbers of the matrix; fixed: a number a node (not
 * 0: fixed), or nil; before: the same, for a first factorisation before the one with fixed. product
 * is the whole matrix times right. */
static int mod_blocks(lua_State *L) {
  sw_error err = {""};
  sw_blocks *b = NULL;
  size_t negative = 0, count = 0;
  lua_settop(L, 5);
  for (int k = 1; k <= 3; k++) luaL_checktype(L, k, LUA_TTABLE);
  const size_t n = lua_rawlen(L, 3) / 3;
  luaL_argcheck(L, lua_rawlen(L, 2) == 9 * n * n, 2, "sizes differ");
  unsigned char *masks[2] = {NULL, NULL};
  for (int k = 0; k < 2; k++) {
    if (lua_isnil(L, 4 + k)) continue;
    const double *list = read_flat(L, 4 + k, n);
    masks[k] = lua_newuserdatauv(L, n + 1, 0);
    for (size_t i = 0; i < n; i++) masks[k][i] = list[i] != 0.0;
  }
  const double *dense = read_flat(L, 2, 9 * n * n);
  double *x = read_flat(L, 3, 3 * n), *product = read_flat(L, 3, 3 * n);
  double *rows = read_flat(L, 3, 3 * n);
  sw_status status = new_blocks(L, &b);
  if (status == SW_OK && sw_blocks_nodes(b) != n) status = SW_EINVAL;
  if (status == SW_OK) {
    count = write_blocks(b, dense);
    if (masks[1]) status = sw_blocks_factor(b, masks[1], NULL);
  }
  if (status == SW_OK) status = sw_blocks_factor(b, masks[0], &negative);
  if (status == SW_OK) {
    sw_blocks_multiply(b, x, product);
    for (size_t i = 0; i < n; i++) sw_blocks_row_times(b, i, x, rows + 3 * i);
    sw_blocks_solve(b, x);
  }
  sw_blocks_free(b);
  if (status != SW_OK) return lsw_raise(L, status, &err);
  push_flat(L, x, 3 * n);
  lua_pushinteger(L, (lua_Integer)negative);
  push_flat(L, product, 3 * n);
  push_flat(L, rows, 3 * n);
  lua_pushinteger(L, (lua_Integer)count);
  return 5;
}

/* blocks_work(layout) -> number of products of a factorisation; of rings: also before they are made
 */
static int mod_blocks_work(lua_State *L) {
  sw_error err = {""};
  sw_blocks *b = NULL;
  lua_settop(L, 1);
  luaL_checktype(L, 1, LUA_TTABLE);
  const sw_status status = new_blocks(L, &b);
  if (status != SW_OK) return lsw_raise(L, status, &err);
  lua_pushnumber(L, sw_blocks_work(b));
  lua_pushnumber(L, sw_blocks_rings_work(field(L, "rings"), field(L, "per_ring")));
  sw_blocks_free(b);
  return 2;
}

/* Writes a matrix of rings that can be factorised: large on the diagonal, small elsewhere. */
static void write_any(sw_blocks *b, size_t per_ring) {
  const size_t n = sw_blocks_nodes(b), stride = sw_blocks_stride(b);
  for (size_t i = 0; i < n; i++)
    for (size_t j = i < 2 * per_ring ? 0 : i - 2 * per_ring; j <= i; j++) {
      const size_t slot = sw_blocks_slot(b, i, j);
      for (size_t k = 0; slot != SIZE_MAX && k < 9; k++)
        sw_blocks_values(b)[slot + k / 3 * stride + k % 3] =
            i == j && k % 4 == 0 ? 1.0 : 0.1 / (double)(per_ring * (1 + i - j + k));
    }
}

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* blocks_time(rings, per ring, repeats) -> shortest time of a factorisation, of a solve [s] */
static int mod_blocks_time(lua_State *L) {
  sw_error err = {""};
  sw_blocks *b = NULL;
  const lua_Integer size[3] = {lsw_integer(L, 1, "blocks_time: rings"),
                               lsw_integer(L, 2, "blocks_time: nodes a ring"),
                               lsw_integer(L, 3, "blocks_time: repeats")};
  for (int k = 0; k < 3; k++) luaL_argcheck(L, size[k] >= 1 && size[k] <= 100000, k + 1, "range");
  const size_t per_ring = (size_t)size[1], count = 3 * (size_t)size[0] * per_ring;
  double least[2] = {HUGE_VAL, HUGE_VAL}, *x = lua_newuserdatauv(L, count * sizeof *x, 0);
  sw_status status = sw_blocks_new_rings((size_t)size[0], per_ring, &b);
  if (status == SW_OK) write_any(b, per_ring);
  for (lua_Integer k = 0; k < size[2] && status == SW_OK; k++) {
    for (size_t i = 0; i < count; i++) x[i] = 1.0;
    const double begun = seconds();
    status = sw_blocks_factor(b, NULL, NULL);
    const double between = seconds();
    if (status == SW_OK) sw_blocks_solve(b, x);
    least[0] = fmin(least[0], between - begun);
    least[1] = fmin(least[1], seconds() - between);
  }
  sw_blocks_free(b);
  if (status != SW_OK) return lsw_raise(L, status, &err);
  lua_pushnumber(L, least[0]);
  lua_pushnumber(L, least[1]);
  return 2;
}

static const luaL_Reg functions[] = {{"fields", lsw_probe_fields},
                                     {"band3", mod_band3},
                                     {"band4", mod_band4},
                                     {"sparse", mod_sparse},
                                     {"blocks", mod_blocks},
                                     {"blocks_work", mod_blocks_work},
                                     {"blocks_time", mod_blocks_time},
                                     {NULL, NULL}};

int luaopen_softworld_probe(lua_State *L);

int luaopen_softworld_probe(lua_State *L) {
  luaL_newlib(L, functions);
  return 1;
}
