/* SPDX-License-Identifier: GPL-3.0-or-later */
/* core.least_squares: fits parameters, so that the residuals of a Lua function are smallest.
 * core.student, core.chi2_above, core.singular: statistics for the errors of a fit. The arguments
 * come from the library's own Lua files, which have checked the script's values. */
#include <math.h>

#include "bind/bind_motion.h"
#include "bind/child.h"

enum { MOST = 10000000 }; /* largest matrix, rows times columns [-] */

/* The function is at stack index 2 of L. */
typedef struct caller {
  lua_State *L;
  size_t n, rows;
  const double *x;
  double *out;
  int derivatives;
} caller;

static int call_function(lua_State *L) {
  caller *c = lua_touserdata(L, 2);
  lua_pushvalue(L, 1);
  lsw_push_flat(L, c->x, c->n);
  lua_pushboolean(L, c->derivatives);
  lua_call(L, 2, 1);
  lsw_read_flat(L, -1, c->out, c->derivatives ? c->rows * c->n : c->rows);
  return 0;
}

static sw_status residuals(void *user, const double *x, double *r, double *jacobian,
                           sw_error *err) {
  caller *c = user;
  lua_State *L = c->L;
  c->x = x;
  c->out = jacobian ? jacobian : r;
  c->derivatives = jacobian != NULL;
  if (!lua_checkstack(L, 8)) return sw_fail(err, SW_ENOMEM, "least_squares: out of stack");
  lua_pushcfunction(L, call_function);
  lua_pushvalue(L, 2);
  lua_pushlightuserdata(L, c);
  if (lua_pcall(L, 2, 0, 0) != LUA_OK) return lsw_motion_keep_error(L, err);
  return SW_OK;
}

/* least_squares(start, f, rows, tolerance, max_iterations) -> x, "near" | "stuck" | "used",
 * iterations. f(x, derivatives) returns a flat list: `rows` residuals, or, if derivatives is true,
 * the Jacobian (rows x n), row by row. */
static int mod_least_squares(lua_State *L) {
  static const char *const ends[] = {
      [SW_FIT_NEAR] = "near", [SW_FIT_STUCK] = "stuck", [SW_FIT_USED] = "used"};
  sw_fit_end end = SW_FIT_USED;
  size_t iterations = 0;
  luaL_checktype(L, 1, LUA_TTABLE);
  luaL_checktype(L, 2, LUA_TFUNCTION);
  const lua_Integer n = (lua_Integer)lua_rawlen(L, 1), rows = luaL_checkinteger(L, 3);
  const double tolerance = luaL_checknumber(L, 4);
  const lua_Integer most = luaL_checkinteger(L, 5);
  luaL_argcheck(L, n >= 1 && n <= 1000, 1, "1 to 1000 parameters");
  /* NOLINTNEXTLINE(clang-analyzer-core.DivideZero): luaL_argcheck has raised for n = 0 */
  luaL_argcheck(L, rows >= n && rows <= MOST / n, 3, "rows from the parameters to 1e7 numbers");
  double *x = lua_newuserdatauv(L, sizeof *x * (size_t)n, 0);
  lsw_read_flat(L, 1, x, (size_t)n);
  caller c = {.L = L, .n = (size_t)n, .rows = (size_t)rows};
  LSW_DO(L, sw_fit, residuals, &c, c.n, c.rows, x, tolerance, (size_t)(most > 0 ? most : 1), &end,
         &iterations);
  lsw_push_flat(L, x, (size_t)n);
  lua_pushstring(L, ends[end]);
  lua_pushinteger(L, (lua_Integer)iterations);
  return 3;
}

/* singular(a, rows, n) -> singular values (falling), right singular vectors as a flat list (n x n),
 * one a column. a: the matrix as a flat list, row by row. */
static int mod_singular(lua_State *L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  const lua_Integer rows = luaL_checkinteger(L, 2), n = luaL_checkinteger(L, 3);
  luaL_argcheck(L, n >= 1 && n <= 1000, 3, "1 to 1000 columns");
  luaL_argcheck(L, rows >= n && rows <= MOST / n, 2, "rows from the columns to 1e7 numbers");
  const size_t size = (size_t)(rows * n), square = (size_t)(n * n);
  double *a = lua_newuserdatauv(L, sizeof *a * (size + (size_t)n + square), 0);
  double *s = a + size, *v = s + n;
  lsw_read_flat(L, 1, a, size);
  LSW_DO(L, sw_singular, a, (size_t)rows, (size_t)n, s, v);
  lsw_push_flat(L, s, (size_t)n);
  lsw_push_flat(L, v, square);
  return 2;
}

/* student(p, freedom) -> the value below which Student's t lies with probability p */
static int mod_student(lua_State *L) {
  const double p = luaL_checknumber(L, 1), freedom = luaL_checknumber(L, 2);
  luaL_argcheck(L, p > 0 && p < 1, 1, "between 0 and 1");
  luaL_argcheck(L, freedom > 0, 2, "above 0");
  lua_pushnumber(L, sw_student(p, freedom));
  return 1;
}

/* chi2_above(x, freedom) -> the probability that chi squared is above x */
static int mod_chi2_above(lua_State *L) {
  const double x = luaL_checknumber(L, 1), freedom = luaL_checknumber(L, 2);
  luaL_argcheck(L, x >= 0, 1, "0 or more");
  luaL_argcheck(L, freedom > 0 && isfinite(freedom), 2, "above 0 and finite");
  lua_pushnumber(L, sw_chi2_above(x, freedom));
  return 1;
}

const luaL_Reg lsw_module_fit[] = {{"least_squares", mod_least_squares},
                                   {"singular", mod_singular},
                                   {"student", mod_student},
                                   {"chi2_above", mod_chi2_above},
                                   {NULL, NULL}};
