/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy ledger of the last run. */
#include "bind/child.h"

static void set_retries(lua_State *L, const char *name, const sw_retries *r) {
  lua_createtable(L, 0, 5);
  lsw_set_integer(L, "count", r->count);
  if (r->count) {
    lsw_set_number(L, "largest", r->largest);
    lsw_set_number(L, "time", r->time);
    lsw_set_number(L, "s", r->s);
    lsw_set_text(L, "object", r->object);
  }
  lua_setfield(L, -2, name);
}

static void set_work(lua_State *L, const sw_ledger *l) {
  lua_createtable(L, 0, 5);
  lsw_set_number(L, "holds", l->by_holds);
  lsw_set_number(L, "obstacles", l->by_obstacles);
  lsw_set_number(L, "feeds", l->by_feeds);
  lsw_set_number(L, "forces", l->by_forces);
  lsw_set_number(L, "changes", l->by_changes);
  lua_setfield(L, -2, "work");
}

static void set_losses(lua_State *L, const sw_ledger *l) {
  lua_createtable(L, 0, 7);
  lsw_set_number(L, "damping", l->damping);
  lsw_set_number(L, "friction", l->friction);
  lsw_set_number(L, "plasticity", l->plasticity);
  lsw_set_number(L, "impact", l->impact);
  lsw_set_number(L, "contact", l->contact);
  lsw_set_number(L, "integrator", l->integrator);
  lsw_set_number(L, "jumps", l->jumps);
  lua_setfield(L, -2, "lost");
}

/* core.ledger(scene) -> table of energies [J], work, losses and counts of the last run */
static int mod_ledger(lua_State *L) {
  sw_ledger l;
  LSW_DO(L, sw_scene_ledger, lsw_check_scene(L), &l);
  lua_createtable(L, 0, 14);
  lsw_set_number(L, "kinetic", l.kinetic);
  lsw_set_number(L, "stored", l.stored);
  lsw_set_number(L, "gravity", l.gravity);
  lsw_set_number(L, "total", l.kinetic + l.stored + l.gravity);
  lsw_set_number(L, "at_start", l.at_start);
  lsw_set_number(L, "gap", l.gap);
  lsw_set_number(L, "gained", l.gained);
  lsw_set_number(L, "play", l.play);
  lsw_set_integer(L, "steps", l.steps);
  set_work(L, &l);
  set_losses(L, &l);
  set_retries(L, "redone", &l.redone);
  set_retries(L, "halved", &l.halved);
  set_retries(L, "accepted", &l.accepted);
  return 1;
}

/* core.energy_log(scene) -> flat rows of time [s], kinetic, stored and gravity energy, gap, sum of
 * all losses so far [J]; number of rows */
static int mod_energy_log(lua_State *L) {
  size_t rows;
  const sw_scene *scene = lsw_check_scene(L);
  lsw_quiet(L);
  const double *log = sw_scene_energy_log(scene, &rows);
  lsw_push_flat(L, log, rows * SW_LOG_ENERGY_SIZE);
  lua_pushinteger(L, (lua_Integer)rows);
  return 2;
}

/* core.end_run(scene) -> ok, reason if it failed */
static int mod_end_run(lua_State *L) {
  sw_error why = {""};
  const sw_status status = sw_scene_end_run(lsw_check_scene(L), &why);
  lua_pushboolean(L, status == SW_OK);
  lua_pushstring(L, why.text);
  return 2;
}

const luaL_Reg lsw_module_ledger[] = {
    {"ledger", mod_ledger}, {"energy_log", mod_energy_log}, {"end_run", mod_end_run}, {NULL, NULL}};
