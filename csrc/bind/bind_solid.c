/* SPDX-License-Identifier: GPL-3.0-or-later */
/* core.solid: evaluates one solid element, for specs. */
#include "bind/child.h"

enum { NUMBERS = 3 * SW_SOLID_NODES };

static void read_places(lua_State *L, int index, int n, double *out) {
  luaL_checktype(L, index, LUA_TTABLE);
  luaL_argcheck(L, (int)lua_rawlen(L, index) == n, index, "as many numbers as at rest");
  for (int i = 0; i < n; i++) {
    lua_geti(L, index, i + 1);
    out[i] = luaL_checknumber(L, -1);
    lua_pop(L, 1);
  }
}

/* solid(rest, mu, lambda, x [, semidefinite [, dx]]) -> energy [J], gradient, second derivative, J,
 * stress xx xy xz yy yz zz, von Mises stress; with dx also the allowed share of this step. Lists
 * are flat, 3 numbers a particle; an element has 6 or 8 particles. */
static int mod_solid(lua_State *L) {
  sw_solid e;
  double rest[NUMBERS], x[NUMBERS], dx[NUMBERS], g[NUMBERS], H[NUMBERS * NUMBERS];
  double stress[6], mises, J;
  luaL_checktype(L, 1, LUA_TTABLE);
  const int n = (int)lua_rawlen(L, 1);
  luaL_argcheck(L, n == 3 * SW_SOLID_PRISM || n == 3 * SW_SOLID_HEX, 1, "18 or 24 numbers");
  read_places(L, 1, n, rest);
  read_places(L, 4, n, x);
  const int moved = !lua_isnoneornil(L, 6);
  if (moved) read_places(L, 6, n, dx);
  if (sw_solid_prepare(n / 3, rest, luaL_checknumber(L, 2), luaL_checknumber(L, 3), &e) != SW_OK)
    return luaL_error(L, "solid: no element");
  const unsigned want = SW_WANT_FORCE | SW_WANT_STIFFNESS | SW_WANT_ENERGY |
                        (lua_toboolean(L, 5) ? SW_SOLID_SEMIDEFINITE : 0);
  lua_pushnumber(L, sw_solid_eval(&e, x, want, g, H));
  sw_solid_stress(&e, x, stress, &mises, &J);
  lsw_push_flat(L, g, (size_t)n);
  lsw_push_flat(L, H, (size_t)n * (size_t)n);
  lua_pushnumber(L, J);
  lsw_push_flat(L, stress, 6);
  lua_pushnumber(L, mises);
  if (!moved) return 6;
  lua_pushnumber(L, sw_solid_step(&e, x, dx));
  return 7;
}

const luaL_Reg lsw_module_solid[] = {{"solid", mod_solid}, {NULL, NULL}};
