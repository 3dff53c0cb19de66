/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Search for a minimum and eigenvalues of a symmetric matrix, for Lua.
 *
 *   core.search(method, start, number of constraints, step, tolerance, seed) -> search
 *   search:ask() -> next place as a list of numbers; or nil, reason of the end, reached the
 *     tolerance?
 *   search:tell(value, list of constraint violations); search:close()
 *   core.eigen(flat list of n x n numbers, n) -> eigenvalues (ascending), list of eigenvectors */
#include <lauxlib.h>
#include <math.h>

#include "bind/child.h"

static const char SEARCH[] = "softworld.search";

enum { MOST = 1000 }; /* most rows of a matrix [-] */

typedef struct holder {
  sw_search *search;
  size_t n, constraints; /* parameters, constraints [-] */
} holder;

static holder *check(lua_State *L) {
  holder *h = luaL_checkudata(L, 1, SEARCH);
  if (!h->search) luaL_error(L, "the search is closed");
  return h;
}

static int meth_ask(lua_State *L) {
  double x[SW_SEARCH_MOST];
  const holder *h = check(L);
  int ok;
  if (sw_search_ask(h->search, x)) {
    lsw_push_flat(L, x, h->n);
    return 1;
  }
  lua_pushnil(L);
  lua_pushstring(L, sw_search_reason(h->search, &ok));
  lua_pushboolean(L, ok);
  return 3;
}

static int meth_tell(lua_State *L) {
  double broken[SW_SEARCH_MOST] = {0};
  const holder *h = check(L);
  const double value = luaL_checknumber(L, 2);
  luaL_argcheck(L, isfinite(value), 2, "a finite number is wanted");
  if (h->constraints > 0) lsw_read_flat(L, 3, broken, h->constraints);
  sw_search_tell(h->search, value, broken);
  return 0;
}

static int meth_close(lua_State *L) {
  holder *h = luaL_checkudata(L, 1, SEARCH);
  sw_search_free(h->search);
  h->search = NULL;
  return 0;
}

static const luaL_Reg methods[] = {
    {"ask", meth_ask}, {"tell", meth_tell}, {"close", meth_close}, {NULL, NULL}};

static int mod_search(lua_State *L) {
  double start[SW_SEARCH_MOST];
  luaL_checktype(L, 2, LUA_TTABLE);
  const size_t n = lua_rawlen(L, 2);
  const lua_Integer count = luaL_checkinteger(L, 3);
  luaL_argcheck(L, n >= 1 && n <= SW_SEARCH_MOST, 2, "1 to 64 parameters");
  luaL_argcheck(L, count >= 0 && count <= SW_SEARCH_MOST, 3, "0 to 64 constraints");
  lsw_read_flat(L, 2, start, n);
  const sw_search_args args = {luaL_checkstring(L, 1),
                               n,
                               (size_t)count,
                               start,
                               luaL_checknumber(L, 4),
                               luaL_checknumber(L, 5),
                               (unsigned long)luaL_checkinteger(L, 6)};
  luaL_argcheck(L, args.step > 0 && args.step <= 0.5, 4, "above 0 to 0.5");
  luaL_argcheck(L, args.tolerance > 0 && args.tolerance <= 0.5, 5, "above 0 to 0.5");
  holder *h = lsw_keep(L, sizeof *h, SEARCH, methods, meth_close);
  h->n = n, h->constraints = (size_t)count;
  LSW_DO(L, sw_search_new, &args, &h->search);
  return 1;
}

static int mod_eigen(lua_State *L) {
  const lua_Integer n = luaL_checkinteger(L, 2);
  sw_error err = {""};
  luaL_argcheck(L, n >= 1 && n <= MOST, 2, "1 to 1000 rows");
  const size_t rows = (size_t)n;
  double *a = lua_newuserdatauv(L, sizeof *a * (2 * rows * rows + rows), 0);
  lsw_read_flat(L, 1, a, rows * rows);
  double *values = a + rows * rows, *vectors = values + rows;
  lsw_must(L, sw_eigen_dense(a, NULL, rows, values, vectors), &err);
  lsw_push_flat(L, values, rows);
  lsw_push_rows(L, vectors, rows, rows);
  return 2;
}

const luaL_Reg lsw_module_search[] = {{"search", mod_search}, {"eigen", mod_eigen}, {NULL, NULL}};
