/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The band solvers for specs: core.band3(rows, right) -> x, negative pivots,
 * product. rows: flat, 24 numbers a node as in solve/band3.h; right: flat, 3 a
 * node. product is rows times right. */
#include <string.h>

#include "bind/class.h"
#include "bind/module.h"

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

/* core.band4(rows, right) -> x, negative pivots. rows: flat, 48 numbers a node. */
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

/* core.sparse(block, own, pairs, values, right) -> x, negative pivots, fill. own: flat,
 * block * block numbers a node; pairs: flat, two node numbers from 0 each; values: flat,
 * block * block numbers a pair; right: flat, block numbers a node. */
static int mod_sparse(lua_State *L) {
  sw_error err = {""};
  sw_sparse *s = NULL;
  size_t negative = 0;
  const size_t b = (size_t)luaL_checkinteger(L, 1);
  luaL_argcheck(L, b == 3 || b == SW_SPARSE_BLOCK_MAX, 1, "3 or 4");
  for (int k = 2; k <= 5; k++) luaL_checktype(L, k, LUA_TTABLE);
  const size_t n = lua_rawlen(L, 5) / b, pairs = lua_rawlen(L, 3) / 2, bb = b * b;
  luaL_argcheck(L, lua_rawlen(L, 2) == bb * n && lua_rawlen(L, 4) == bb * pairs, 4, "sizes differ");
  double *own = read_flat(L, 2, bb * n), *list = read_flat(L, 3, 2 * pairs);
  double *values = read_flat(L, 4, bb * pairs), *x = read_flat(L, 5, b * n);
  sw_sparse_pair *at = lua_newuserdatauv(L, (pairs + 1) * sizeof *at, 0);
  for (size_t k = 0; k < pairs; k++) {
    const double i = list[2 * k], j = list[2 * k + 1];
    luaL_argcheck(L, i >= 0 && i < (double)n && j >= 0 && j < (double)n && i != j, 3,
                  "no such node");
    at[k] = (sw_sparse_pair){(uint32_t)i, (uint32_t)j};
  }
  sw_status status = sw_sparse_new(n, b, at, pairs, &s);
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

static const luaL_Reg functions[] = {
    {"band3", mod_band3}, {"band4", mod_band4}, {"sparse", mod_sparse}, {NULL, NULL}};

void lsw_open_solve(lua_State *L) { luaL_setfuncs(L, functions, 0); }
