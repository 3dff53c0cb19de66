/* SPDX-License-Identifier: GPL-3.0-or-later */
/* core.minimise: finds the minimum of a Lua function. core.quasi: quasi-random points, which fill a
 * cube evenly. core.normal_below, core.normal_at: the normal distribution. */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "bind/bind_motion.h"
#include "bind/child.h"

/* A call of the objective. Its function is at stack index 2 of L. */
typedef struct caller {
  lua_State *L;
  int list; /* the function takes a list, not a number */
  const double *x;
  size_t n;
  double value;
} caller;

static int call_function(lua_State *L) {
  caller *c = lua_touserdata(L, 2);
  lua_pushvalue(L, 1);
  if (c->list) {
    lsw_push_flat(L, c->x, c->n);
  } else {
    lua_pushnumber(L, c->x[0]);
  }
  const unsigned interrupts = sw_interrupt_count();
  lua_call(L, 1, 1);
  lsw_stop_since(L, interrupts); /* f may have caught the error */
  if (lua_type(L, -1) != LUA_TNUMBER) {
    lua_Debug f;
    lua_pushvalue(L, 1);
    lua_getinfo(L, ">S", &f);
    return luaL_error(L, "tune.minimise: f must return a number, got %s (f begins at %s:%d)",
                      luaL_typename(L, -1), f.short_src, f.linedefined);
  }
  c->value = lua_tonumber(L, -1);
  return 0;
}

static sw_status objective(void *user, const double *x, size_t n, double *value, sw_error *err) {
  caller *c = user;
  lua_State *L = c->L;
  c->x = x;
  c->n = n;
  if (!lua_checkstack(L, 8)) return sw_fail(err, SW_ENOMEM, "tune.minimise: out of stack");
  lua_pushcfunction(L, call_function);
  lua_pushvalue(L, 2);
  lua_pushlightuserdata(L, c);
  if (lua_pcall(L, 2, 0, 0) != LUA_OK) return lsw_motion_keep_error(L, err);
  *value = c->value;
  return SW_OK;
}

/* Reads the number or list under key of the table at index 1 into out; returns how
 * many numbers, 0 without the key. */
static size_t read_numbers(lua_State *L, const char *key, double *out, int *list) {
  const char *what = lua_pushfstring(L, "tune.minimise: %s", key);
  size_t n = 0;
  if (lua_getfield(L, 1, key) == LUA_TNIL) return 0;
  *list = lua_istable(L, -1);
  if (!*list) {
    out[0] = lsw_number(L, -1, what, "-");
    return 1;
  }
  lsw_only_items(L, -1, what);
  n = lua_rawlen(L, -1);
  if (n < 1 || n > SW_MINIMISE_MOST)
    luaL_error(L, "%s has %d numbers; allowed are 1 to %d", what, (int)n, SW_MINIMISE_MOST);
  for (size_t i = 0; i < n; i++) {
    lua_geti(L, -1, (lua_Integer)i + 1);
    const char *item = lua_pushfstring(L, "%s, number %d", what, (int)i + 1);
    out[i] = lsw_number(L, -2, item, "-");
    lua_pop(L, 2);
  }
  return n;
}

static void read_steps(lua_State *L, const double *x, double *step, size_t n) {
  int list = 0;
  const size_t given = read_numbers(L, "step", step, &list);
  if (given == 0)
    for (size_t i = 0; i < n; i++) step[i] = x[i] != 0 ? 0.1 * fabs(x[i]) : 0.1;
  else if (!list)
    for (size_t i = 1; i < n; i++) step[i] = step[0];
  else if (given != n)
    luaL_error(L, "tune.minimise: step must have as many numbers as start, %d, got %d", (int)n,
               (int)given);
}

static void push_result(lua_State *L, const double *x, size_t n, int list, const sw_minimum *r) {
  lua_createtable(L, 0, 8);
  if (list)
    lsw_set_flat(L, "x", x, n);
  else
    lsw_set_number(L, "x", x[0]);
  lsw_set_flag(L, "ok", r->ok);
  lsw_set_text(L, "reason", r->reason.text);
  lsw_set_number(L, "value", r->value);
  lsw_set_integer(L, "iterations", r->iterations);
  lsw_set_integer(L, "evaluations", r->evaluations);
  lsw_set_integer(L, "nonfinite", r->nonfinite);
}

/* minimise{ f =, from =, to = | start =, step =, tolerance =, max_iterations = } ->
 * { x, value, ok, reason, iterations, evaluations, nonfinite } */
static int mod_minimise(lua_State *L) {
  sw_minimise_args args;
  sw_minimum r;
  sw_error err = {""};
  sw_status status;
  double x[SW_MINIMISE_MOST] = {0}, step[SW_MINIMISE_MOST] = {0};
  int list = 0;
  lua_settop(L, 1);
  lsw_arguments(L, 1, "tune.minimise", &sw_minimise_params, &args);
  if (!lua_istable(L, 1) || lua_getfield(L, 1, "f") != LUA_TFUNCTION)
    return luaL_error(L, "tune.minimise: f must be a function, got %s",
                      lua_gettop(L) > 1 ? luaL_typename(L, 2) : "nothing");
  const size_t n = read_numbers(L, "start", x, &list);
  const int interval = !isnan(args.from) || !isnan(args.to);
  if (interval == (n > 0) || isnan(args.from) != isnan(args.to))
    return luaL_error(L, "tune.minimise: give either from and to, or start");
  caller c = {.L = L, .list = list};
  if (interval) {
    status = sw_minimise_interval(objective, &c, &args, sw_interrupted, x, &r, &err);
  } else {
    read_steps(L, x, step, n);
    status = sw_minimise_simplex(objective, &c, n, x, step, &args, sw_interrupted, &r, &err);
  }
  lsw_must(L, status, &err);
  push_result(L, x, n > 0 ? n : 1, list, &r);
  return 1;
}

/* quasi(kind, n, count): "sobol" or "halton" -> a flat list of n * count numbers in (0, 1) */
static int mod_quasi(lua_State *L) {
  const int sobol = strcmp(luaL_checkstring(L, 1), "sobol") == 0;
  const lua_Integer n = luaL_checkinteger(L, 2), count = luaL_checkinteger(L, 3);
  luaL_argcheck(L, n >= 1 && n < INT_MAX, 2, "1 or more parameters");
  luaL_argcheck(L, count >= 1 && count <= 10000000, 3, "1 to 1e7 points");
  LSW_DO(L, sw_quasi, sobol, (size_t)n, 0, NULL); /* only checks n, before memory is asked for */
  double *out = lua_newuserdatauv(L, sizeof *out * (size_t)(n * count), 0);
  LSW_DO(L, sw_quasi, sobol, (size_t)n, (size_t)count, out);
  lsw_push_flat(L, out, (size_t)(n * count));
  return 1;
}

/* normal_below(x) -> share of normally distributed numbers below x; normal_at(share) -> x */
static int mod_normal_below(lua_State *L) {
  lua_pushnumber(L, sw_normal_below(luaL_checknumber(L, 1)));
  return 1;
}

static int mod_normal_at(lua_State *L) {
  const double share = luaL_checknumber(L, 1);
  luaL_argcheck(L, share > 0 && share < 1, 1, "between 0 and 1");
  lua_pushnumber(L, sw_normal_at(share));
  return 1;
}

const luaL_Reg lsw_module_tune[] = {{"minimise", mod_minimise},
                                    {"quasi", mod_quasi},
                                    {"normal_below", mod_normal_below},
                                    {"normal_at", mod_normal_at},
                                    {NULL, NULL}};
