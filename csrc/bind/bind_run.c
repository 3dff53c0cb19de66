/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs and settles a scene. */
#include "bind/bind_motion.h"
#include "bind/child.h"

/* core.check_run{...}: raises unless the parameters of scene:run are valid. */
static int mod_check_run(lua_State *L) {
  sw_run_args args;
  lsw_arguments(L, 1, "scene:run", &sw_run_params, &args);
  return 0;
}

/* core.check_settle{...}: raises unless the parameters of scene:settle are valid. */
static int mod_check_settle(lua_State *L) {
  sw_settle_args args;
  lsw_arguments(L, 1, "scene:settle", &sw_settle_params, &args);
  return 0;
}

/* core.begin_run(scene [, wear]): begins a run and resets extremes. wear: true = record the wear of
 * wires. */
static int mod_begin_run(lua_State *L) {
  LSW_DO(L, sw_scene_begin_run, lsw_check_scene(L), lua_toboolean(L, 2));
  return 0;
}

/* core.window(scene, obstacle or clamp) -> window of the scene's last run [s]. */
static int mod_window(lua_State *L) {
  const lsw_class *const classes[2] = {&lsw_class_obstacle, &lsw_class_clamp};
  const sw_scene *scene = NULL;
  for (size_t k = 0; !scene && k < 2; k++)
    if (lsw_test(L, 1, classes[k])) scene = lsw_check_self(L, classes[k]).scene;
  lua_pushnumber(L, sw_scene_window(scene ? scene : lsw_check_scene(L)));
  return 1;
}

/* The Lua function of an observer. */
typedef struct watcher {
  lua_State *L;
  int function; /* its stack index */
} watcher;

/* Calls the observer's function, in protected mode. Arguments: the function, the observer. The
 * function returns stop, the next time [s] and the next time on the wall clock [s]. */
static int call_observer(lua_State *L) {
  sw_observer *o = lua_touserdata(L, 2);
  lua_pushvalue(L, 1);
  lua_call(L, 0, 3);
  o->stop = lua_toboolean(L, -3);
  o->at = luaL_checknumber(L, -2);
  o->wall = luaL_checknumber(L, -1);
  return 0;
}

static sw_status look(sw_observer *o, sw_error *err) {
  const watcher *w = o->user;
  if (!lua_checkstack(w->L, 8)) return sw_fail(err, SW_ENOMEM, "observer: out of stack");
  lua_pushcfunction(w->L, call_observer);
  lua_pushvalue(w->L, w->function);
  lua_pushlightuserdata(w->L, o);
  if (lua_pcall(w->L, 2, 0, 0) == LUA_OK) return SW_OK;
  return lsw_motion_keep_error(w->L, err);
}

/* scene:advance({...}, until [, look, at, wall]) -> report. Runs until exactly the time `until`
 * [s]. Calls look() at the end of the first step from time `at` on [s], or when core.clock() has
 * reached wall [s]. look returns stop, the next at, and the next wall. */
int lsw_scene_advance(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_run_args args = {0};
  sw_run_report r;
  lsw_arguments(L, 2, "scene:run", &sw_run_params, &args);
  const double until = lsw_number(L, 3, "scene:advance: until", "s");
  watcher w = {L, 4};
  sw_observer o = {.look = look, .user = &w};
  const int watched = lua_isfunction(L, 4);
  if (watched) o.at = luaL_checknumber(L, 5), o.wall = luaL_checknumber(L, 6);
  LSW_DO_FORCES(L, sw_scene_advance, scene, &args, until, sw_interrupted, watched ? &o : NULL, &r);
  if (r.status == SW_EINTR || r.status == SW_ECALLBACK || r.status == SW_ENOMEM ||
      r.status == SW_EEMPTY)
    lsw_must(L, r.status, &r.reason);
  lua_createtable(L, 0, 9);
  lsw_set_flag(L, "ok", r.status == SW_OK);
  lsw_set_text(L, "reason", r.reason.text);
  lsw_set_number(L, "time", r.time);
  lsw_set_integer(L, "steps", r.steps);
  lsw_set_integer(L, "rejected", r.rejected);
  lsw_set_integer(L, "iterations", r.iterations);
  lsw_set_integer(L, "evaluations", r.evaluations);
  lsw_set_integer(L, "solves", r.solves);
  lsw_set_integer(L, "looks", r.looks);
  lsw_set_number(L, "smallest_dt", r.smallest_dt);
  lsw_set_integer(L, "jumps", r.jumps);
  if (r.jumps) lsw_set_number(L, "last_jump", r.last_jump);
  return 1;
}

/* A settle may take minutes. While it runs, its check for Ctrl-C calls a function of Lua, the third
 * value of L, which shows that. */
static struct {
  lua_State *L; /* NULL: there is no function */
  double next;  /* when it is called, on the wall clock [s] */
} shown;
static const double SHOW_GAP = 0.1; /* [s] */

static int stop_or_show(void) {
  if (!shown.L || sw_wall_clock() < shown.next) return sw_interrupted();
  lua_State *L = shown.L;
  const unsigned count = sw_interrupt_count();
  shown.L = NULL; /* the function may settle another scene */
  if (lua_checkstack(L, LUA_MINSTACK)) {
    lua_pushvalue(L, 3);
    if (lua_pcall(L, 0, 0, 0) != LUA_OK) lua_pop(L, 1); /* nothing is shown */
  }
  shown.L = L;
  shown.next = sw_wall_clock() + SHOW_GAP;
  return sw_interrupted() || sw_interrupt_count() != count;
}

/* scene:settle({ tolerance =, max_iterations = }, show) -> report. show(): called ten times a
 * second, or nil. */
int lsw_scene_settle(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_settle_args args = {.stays = 0}; /* not a row */
  sw_settle_report r;
  sw_error err = {""};
  lua_settop(L, 3);
  lsw_arguments(L, 2, "scene:settle", &sw_settle_params, &args);
  shown.L = lua_isfunction(L, 3) ? L : NULL;
  shown.next = 0;
  lsw_still_open(L);
  lua_State *outer = lsw_begin_forces(L);
  const sw_status status = sw_scene_settle(scene, &args, stop_or_show, &r, &err);
  lsw_end_forces(outer);
  shown.L = NULL;
  lsw_must(L, status, &err);
  if (sw_interrupted()) lsw_must(L, SW_EINTR, &err);
  lua_createtable(L, 0, 6);
  lsw_set_flag(L, "ok", r.ok);
  lsw_set_text(L, "reason", r.ok ? "at rest" : r.reason.text);
  lsw_set_integer(L, "iterations", r.iterations);
  lsw_set_number(L, "residual", r.residual);
  lsw_set_integer(L, "unstable", r.negative);
  lsw_set_flag(L, "transient", r.transient);
  lsw_set_flag(L, "jumped", r.jumped);
  return 1;
}

const luaL_Reg lsw_module_run[] = {{"check_run", mod_check_run},
                                   {"check_settle", mod_check_settle},
                                   {"begin_run", mod_begin_run},
                                   {"window", mod_window},
                                   {NULL, NULL}};
