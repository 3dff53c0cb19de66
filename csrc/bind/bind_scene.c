/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lua class scene: making, reading and snapshots of scenes. */
#include <time.h>

#include "bind/child.h"

lsw_handle *lsw_new_scene(lua_State *L) {
  lsw_scene_handle *h = lsw_new(L, &lsw_class_scene, 2);
  lua_newtable(L); /* functions kept as forces */
  lua_setiuservalue(L, -2, 1);
  lua_newtable(L); /* the Lua side's data of the scene */
  lua_setiuservalue(L, -2, 2);
  return &h->h;
}

static int mod_scene(lua_State *L) {
  sw_scene_args args;
  sw_scene *scene = NULL;
  lua_settop(L, 1);
  lsw_arguments(L, 1, "scene", &sw_scene_params, &args);
  lsw_handle *h = lsw_new_scene(L);
  LSW_DO(L, sw_scene_new, &args, &scene);
  h->object = scene;
  return 1;
}

static void close_scene(lsw_handle *h) { sw_scene_free(h->object); }

static int scene_busy(const lsw_handle *h) { return sw_scene_busy(h->object); }

/* core.data(object) -> the table in which the Lua side keeps data of the object */
static int mod_data(lua_State *L) {
  luaL_checktype(L, 1, LUA_TUSERDATA);
  if (lua_getiuservalue(L, 1, 2) == LUA_TTABLE) return 1;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_pushvalue(L, -1);
  if (!lua_setiuservalue(L, 1, 2)) return luaL_error(L, "this object keeps no data");
  return 1;
}

/* core.type(x) -> name of the class of x; nil if x is not an object of this library */
static int mod_type(lua_State *L) {
  luaL_checkany(L, 1);
  const lsw_class *c = lsw_class_of(L, 1);
  lua_pushstring(L, c ? c->name : NULL);
  return 1;
}

/* core.busy(scene) -> true inside a step, a function of time or an observer; true in an observer */
static int mod_busy(lua_State *L) {
  const int busy = sw_scene_busy(lsw_check_scene(L));
  lua_pushboolean(L, busy);
  lua_pushboolean(L, busy == 2);
  return 2;
}

/* core.begin_review(scene, what, instead): a script's function of `what` reads a run; changes of
 * the scene are refused until core.end_review(scene) -> the error of a change that was refused, or
 * nil; true if something was asked for that only another model of a wire has. */
static int mod_begin_review(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  LSW_DO(L, sw_scene_begin_review, scene, luaL_checkstring(L, 2), luaL_checkstring(L, 3));
  return 0;
}

static int mod_end_review(lua_State *L) {
  sw_error err = {""};
  int unlike;
  const sw_status status = sw_scene_end_review(lsw_check_scene(L), &unlike, &err);
  lua_pushstring(L, status == SW_OK ? NULL : err.text);
  lua_pushboolean(L, unlike);
  return 2;
}

/* core.exists(object) -> true if its scene still has the object. Released holds, forces and joins
 * and removed obstacles count; wires, particles and tools that were taken away do not. */
static int mod_exists(lua_State *L) {
  const lsw_class *c = lsw_class_of(L, 1);
  const lsw_handle *h = lua_touserdata(L, 1);
  int known = c && h->object;
  if (known && c->kind) {
    const lsw_child *child = lua_touserdata(L, 1);
    const sw_scene *scene = ((lsw_scene_handle *)child->h.object)->h.object;
    const int body = c->kind == SW_OF_BODY, leaves = body || c->kind == SW_OF_TOOL;
    const sw_handle id = body && scene ? sw_scene_body_now(scene, child->id) : child->id;
    const sw_identity is = scene ? sw_scene_identify(scene, c->kind, id) : (sw_identity){NULL};
    known = is.name && (is.alive || !leaves);
  }
  lua_pushboolean(L, known);
  return 1;
}

static int mod_interrupted(lua_State *L) { return lua_pushboolean(L, sw_interrupted()), 1; }

/* core.interrupts() -> how often Ctrl-C was pressed */
static int mod_interrupts(lua_State *L) { return lua_pushinteger(L, sw_interrupt_count()), 1; }

/* core.stop_since(interrupts): raises "interrupted" if Ctrl-C was pressed since */
static int mod_stop_since(lua_State *L) {
  lsw_stop_since(L, (unsigned)luaL_checkinteger(L, 1));
  return 0;
}

/* Monotonic wall clock [s]. */
static int mod_clock(lua_State *L) { return lua_pushnumber(L, sw_wall_clock()), 1; }

/* core.sleep(s): waits this long [s]; Ctrl-C ends it with an error. */
static int mod_sleep(lua_State *L) {
  const double end = sw_wall_clock() + lsw_number(L, 1, "sleep: the time", "s");
  for (double left; (left = end - sw_wall_clock()) > 0;) {
    const double part = left < 0.02 ? left : 0.02; /* another thread may get the signal: poll */
    nanosleep(&(struct timespec){0, (long)(1e9 * part)}, NULL);
    lsw_poll(L);
  }
  return 0;
}

/* core.nearest(word, names) -> the name that word may be a misspelling of, or nil */
static int mod_nearest(lua_State *L) {
  size_t count = 0;
  const char *word = luaL_checkstring(L, 1);
  luaL_checktype(L, 2, LUA_TTABLE);
  const size_t most = lua_rawlen(L, 2);
  const char **names = lua_newuserdatauv(L, (most + 1) * sizeof *names, 0);
  for (; count < most && lua_rawgeti(L, 2, (lua_Integer)count + 1) == LUA_TSTRING; count++) {
    names[count] = lua_tostring(L, -1); /* the list keeps it alive */
    lua_pop(L, 1);
  }
  lua_pushstring(L, sw_nearest_name(word, names, sizeof names[0], count));
  return 1;
}

/* core.remesh(scene, { segments of each wire }): gives the wires new meshes */
static int mod_remesh(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  luaL_checktype(L, 2, LUA_TTABLE);
  const size_t count = lua_rawlen(L, 2);
  size_t *segments = lua_newuserdatauv(L, (count + 1) * sizeof *segments, 0);
  for (size_t w = 0; w < count; w++) {
    lua_rawgeti(L, 2, (lua_Integer)w + 1);
    const lua_Integer n = lsw_integer(L, -1, "remesh: segments");
    segments[w] = n > 0 ? (size_t)n : 0;
    lua_pop(L, 1);
  }
  LSW_DO(L, sw_scene_remesh, scene, segments, count);
  return 0;
}

/* core.chord(wire, s) -> the place on the chord of its edge, where a tie acts [m] */
static int mod_chord(lua_State *L) {
  sw_point_state p;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const double s = lsw_number(L, 2, "chord: s", "m");
  LSW_DO(L, sw_scene_wire_motion, w.scene, w.id, s, &p);
  return lsw_push_vector(L, p.chord), 1;
}

/* core.across(wire, s) -> a direction across the wire that goes with its material; nil without
 * material frames */
static int mod_across(lua_State *L) {
  sw_point_state p;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const double s = lsw_number(L, 2, "across: s", "m");
  LSW_DO(L, sw_scene_wire_at, w.scene, w.id, s, &p);
  return sw_norm2(p.across) > 0 ? lsw_push_vector(L, p.across) : lua_pushnil(L), 1;
}

/* core.came_from(wire, before = flat positions [m], span [s]): sets the velocity with which the
 * wire came from these positions in the time span. */
static int mod_came_from(lua_State *L) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  luaL_checktype(L, 2, LUA_TTABLE);
  const double span = lsw_number(L, 3, "came_from: span", "s");
  const size_t count = lua_rawlen(L, 2);
  if (!(span > 0) || count == 0) return luaL_error(L, "came_from: a span above 0, and places");
  const double *before = lsw_numbers(L, 2, count, "came_from: a place", "m");
  LSW_DO(L, sw_scene_wire_came_from, w.scene, w.id, before, count / 3, span);
  return 0;
}

/* core.redraw(wire, rolls, EA, EI, GJ): multiplies a rod's stiffnesses by the factors EA, EI, GJ
 * (default 1) and sets whether friction rolls it. */
static int mod_redraw(lua_State *L) {
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  const sw_redrawing as = {.rolls = lua_toboolean(L, 2),
                           .EA = luaL_optnumber(L, 3, 1),
                           .EI = luaL_optnumber(L, 4, 1),
                           .GJ = luaL_optnumber(L, 5, 1)};
  LSW_DO(L, sw_scene_redraw, w.scene, w.id, &as);
  return 0;
}

/* core.segments(wire) -> number of even segments of its mesh, without nodes added by holds */
static int mod_segments(lua_State *L) {
  size_t n;
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  LSW_DO(L, sw_scene_wire_segments, w.scene, w.id, &n);
  lua_pushinteger(L, (lua_Integer)n);
  return 1;
}

/* --- reading ------------------------------------------------------------------- */

static int meth_energy(lua_State *L) {
  sw_energy e;
  LSW_DO(L, sw_scene_energy, lsw_check_scene(L), &e);
  lsw_push_energy(L, &e);
  return 1;
}

static int meth_stable_dt(lua_State *L) {
  double dt;
  LSW_DO(L, sw_scene_stable_dt, lsw_check_scene(L), &dt);
  lua_pushnumber(L, dt);
  return 1;
}

/* scene:gravity() -> vector; scene:gravity(vector) sets it [m/s2] */
static int meth_gravity(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  if (lua_gettop(L) > 1) {
    const sw_vec g = lsw_vector(L, 2, "scene:gravity", "m/s2");
    LSW_DO(L, sw_scene_set_gravity, scene, g);
    return 0;
  }
  lsw_push_vector(L, sw_scene_gravity(scene));
  return 1;
}

static int prop_time(lua_State *L) {
  lua_pushnumber(L, sw_scene_time(lsw_check_scene(L)));
  return 1;
}

static int prop_name(lua_State *L) {
  lua_pushstring(L, sw_scene_name(lsw_check_scene(L)));
  return 1;
}

/* --- snapshots ------------------------------------------------------------------ */

static int meth_snapshot(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_snapshot *snapshot = NULL;
  lsw_handle *h = lsw_new(L, &lsw_class_snapshot, 2);
  lua_pushvalue(L, 1);
  lua_setiuservalue(L, -2, 1);
  LSW_DO(L, sw_scene_snapshot, scene, &snapshot);
  h->object = snapshot;
  return 1;
}

/* core.whole_snapshot(snapshot): it keeps the scene's frames, too. */
static int mod_whole_snapshot(lua_State *L) {
  const lsw_handle *h = lsw_check(L, 1, &lsw_class_snapshot);
  sw_error err = {""};
  lsw_must(L, sw_snapshot_keep_frames(h->object, &err), &err);
  return 0;
}

static int meth_restore(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  const lsw_handle *h = lsw_check(L, 2, &lsw_class_snapshot);
  lua_getiuservalue(L, 2, 1);
  if (!lua_rawequal(L, -1, 1)) return luaL_error(L, "restore: the snapshot is of another scene");
  LSW_DO(L, sw_scene_restore, scene, h->object);
  lsw_forget_forces(L, 1, scene);
  return 0;
}

static void close_snapshot(lsw_handle *h) { sw_snapshot_free(h->object); }

static int snapshot_busy(const lsw_handle *h) { return sw_snapshot_busy(h->object); }

static int describe_snapshot(lua_State *L) {
  const lsw_handle *h = lsw_check(L, 1, &lsw_class_snapshot);
  return lsw_say(L, "snapshot at t = %.6g s", sw_snapshot_time(h->object));
}

static int describe(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  return lsw_say(L, "scene '%s' at t = %.6g s", sw_scene_name(scene), sw_scene_time(scene));
}

static const luaL_Reg methods[] = {{"wire", lsw_scene_wire},
                                   {"particles", lsw_scene_particles},
                                   {"hold", lsw_hold_particles},
                                   {"join", lsw_scene_join},
                                   {"obstacle", lsw_scene_obstacle},
                                   {"tool", lsw_scene_tool},
                                   {"force", lsw_scene_force},
                                   {"advance", lsw_scene_advance},
                                   {"settle", lsw_scene_settle},
                                   {"energy", meth_energy},
                                   {"evaluate", lsw_scene_evaluate},
                                   {"wire_contact", lsw_scene_wire_contact},
                                   {"touches", lsw_scene_touches},
                                   {"events", lsw_scene_events},
                                   {"tell", lsw_scene_tell},
                                   {"penetration", lsw_scene_penetration},
                                   {"contacts", lsw_scene_contacts},
                                   {"stable_dt", meth_stable_dt},
                                   {"gravity", meth_gravity},
                                   {"frame", lsw_scene_frame},
                                   {"frame_count", lsw_scene_frame_count},
                                   {"clear_frames", lsw_scene_clear_frames},
                                   {"snapshot", meth_snapshot},
                                   {"restore", meth_restore},
                                   {NULL, NULL}};
static const luaL_Reg properties[] = {{"time", prop_time}, {"name", prop_name}, {NULL, NULL}};

const lsw_class lsw_class_scene = {.name = "scene",
                                   .size = sizeof(lsw_scene_handle),
                                   .methods = methods,
                                   .more = lsw_add_holds,
                                   .describe = describe,
                                   .properties = properties,
                                   .close = close_scene,
                                   .gone = "the scene has been closed",
                                   .busy = scene_busy};

static const luaL_Reg none[] = {{NULL, NULL}};
const lsw_class lsw_class_snapshot = {.name = "snapshot",
                                      .size = sizeof(lsw_handle),
                                      .methods = none,
                                      .describe = describe_snapshot,
                                      .close = close_snapshot,
                                      .gone = "the snapshot has been closed",
                                      .busy = snapshot_busy};

const luaL_Reg lsw_module_scene[] = {{"whole_snapshot", mod_whole_snapshot},
                                     {"scene", mod_scene},
                                     {"data", mod_data},
                                     {"type", mod_type},
                                     {"busy", mod_busy},
                                     {"begin_review", mod_begin_review},
                                     {"end_review", mod_end_review},
                                     {"exists", mod_exists},
                                     {"interrupted", mod_interrupted},
                                     {"interrupts", mod_interrupts},
                                     {"stop_since", mod_stop_since},
                                     {"clock", mod_clock},
                                     {"sleep", mod_sleep},
                                     {"nearest", mod_nearest},
                                     {"remesh", mod_remesh},
                                     {"redraw", mod_redraw},
                                     {"came_from", mod_came_from},
                                     {"chord", mod_chord},
                                     {"across", mod_across},
                                     {"segments", mod_segments},
                                     {NULL, NULL}};
