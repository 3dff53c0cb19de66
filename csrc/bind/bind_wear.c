/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wear of wires in a run, place by place, and the rainflow count of load cycles, for specs. */
#include "bind/child.h"

/* Pushes the cycles as a flat list of range, mean, number. */
static int push_cycles(lua_State *L, const sw_cycle *list, size_t count) {
  _Static_assert(sizeof *list == 3 * sizeof(double), "a cycle is three numbers");
  lsw_push_flat(L, (const double *)list, 3 * count);
  return 1;
}

/* Returns the wire at index 1; *places: number of its places with a record. */
static lsw_self wire_at(lua_State *L, size_t *places) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  LSW_DO(L, sw_scene_worn, w.scene, w.id, places);
  return w;
}

/* core.worn(wire) -> { { s [m], rubbed [J/m], slid [N], side }, ... }; nothing without a record */
static int mod_worn(lua_State *L) {
  size_t count;
  const lsw_self w = wire_at(L, &count);
  if (!count) return 0;
  lsw_quiet(L);
  lua_createtable(L, (int)count, 0);
  for (size_t k = 0; k < count; k++) {
    const sw_worn x = sw_scene_worn_place(w.scene, w.id, k);
    lua_createtable(L, 0, 4);
    lsw_set_number(L, "s", x.s);
    lsw_set_number(L, "rubbed", x.rubbed);
    lsw_set_number(L, "slid", x.slid);
    lua_pushinteger(L, x.side);
    lua_setfield(L, -2, "side");
    lua_rawseti(L, -2, (lua_Integer)k + 1);
  }
  return 1;
}

/* core.worn_sidewall(wire) -> largest pressure T/R where the wire touched something [N/m], where
 * [m], when [s]; nothing without a record */
static int mod_worn_sidewall(lua_State *L) {
  size_t count;
  const lsw_self w = wire_at(L, &count);
  if (!count) return 0;
  const sw_extreme x = sw_scene_worn_sidewall(w.scene, w.id);
  lua_pushnumber(L, x.value), lua_pushnumber(L, x.s), lua_pushnumber(L, x.time);
  return 3;
}

/* core.worn_cycles(wire, place, signal) -> flat list of range, mean, number; values of the
 * reversals that close cycles if the load is repeated. signal 0: the tension [N]; 1 to 12: the
 * bend in one of 12 directions over half a turn [1/m] */
static int mod_worn_cycles(lua_State *L) {
  sw_cycle list[SW_CYCLES_KEPT + SW_CYCLES_OPEN];
  size_t count;
  const lsw_self w = wire_at(L, &count);
  const lua_Integer k = lsw_integer(L, 2, "worn_cycles: the place");
  const lua_Integer signal = lsw_integer(L, 3, "worn_cycles: the signal");
  luaL_argcheck(L, k >= 1 && (size_t)k <= count, 2, "there is no such place");
  luaL_argcheck(L, signal >= 0 && signal < SW_WORN_SIGNALS, 3, "there is no such signal");
  double left[2 * SW_CYCLES_OPEN];
  lsw_quiet(L);
  push_cycles(L, list, sw_scene_worn_cycles(w.scene, w.id, (size_t)k - 1, (int)signal, list));
  lsw_push_flat(L, left, sw_scene_worn_residue(w.scene, w.id, (size_t)k - 1, (int)signal, left));
  return 2;
}

/* core.cycles(list) -> flat list of range, mean, number of the cycles in a load history; values of
 * the reversals that close cycles if it is repeated */
static int mod_cycles(lua_State *L) {
  sw_cycles c = {.opened = 0};
  sw_cycle list[SW_CYCLES_KEPT + SW_CYCLES_OPEN];
  luaL_checktype(L, 1, LUA_TTABLE);
  for (lua_Integer k = 1; lua_rawgeti(L, 1, k) != LUA_TNIL; k++) {
    sw_cycles_add(&c, luaL_checknumber(L, -1));
    lua_pop(L, 1);
  }
  double left[2 * SW_CYCLES_OPEN];
  push_cycles(L, list, sw_cycles_read(&c, list));
  lsw_push_flat(L, left, sw_cycles_residue(&c, left));
  return 2;
}

const luaL_Reg lsw_module_wear[] = {{"worn", mod_worn},
                                    {"worn_sidewall", mod_worn_sidewall},
                                    {"worn_cycles", mod_worn_cycles},
                                    {"cycles", mod_cycles},
                                    {NULL, NULL}};
