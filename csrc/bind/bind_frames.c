/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames of a run as Lua tables, the memory limit of frames, and read-outs over all frames. */
#include <math.h>

#include "bind/child.h"

static const char *const channels[SW_FRAME_FORCE + 1] = {"tension",      "curvature", "contact",
                                                         "twist_moment", "stress",    NULL};

static void push_floats(lua_State *L, const float *x, size_t count, size_t stride) {
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; i < count; i++)
    /* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): NULL comes with count = 0 */
    lsw_put_number(L, i, (double)x[stride * i]);
}

static void push_pose(lua_State *L, const float *p) {
  lua_createtable(L, 0, 4);
  lsw_set_vector(L, "position", sw_vec_of(p));
  lsw_set_vector(L, "force", sw_vec_of(p + SW_FRAME_POSE));
  lsw_push_quaternion(L, (sw_quat){(double)p[3], (double)p[4], (double)p[5], (double)p[6]});
  lua_setfield(L, -2, "rotation");
}

/* Pushes flat positions [m] of the wires (loose = 0), or of the objects of particles (1). */
static void push_wires(lua_State *L, const sw_scene *scene, size_t frame, int loose) {
  size_t count;
  const float *x;
  lua_Integer number = 0;
  lua_newtable(L);
  for (size_t w = 0; (x = sw_scene_frame_wire(scene, frame, w, &count)) != NULL; w++) {
    if (sw_scene_frame_is_loose(scene, w) != loose) continue;
    push_floats(L, x, 3 * count, 1);
    lua_rawseti(L, -2, ++number);
  }
}

/* Pushes for each wire its surface { around =, points = flat [m], force = flat [N] }, or false. */
static void push_surfaces(lua_State *L, const sw_scene *scene, size_t frame, int unused SW_UNUSED) {
  size_t count, around;
  lua_newtable(L);
  for (size_t w = 0; sw_scene_frame_wire(scene, frame, w, &count) != NULL; w++) {
    const float *p = sw_scene_frame_surface(scene, frame, w, &count, &around);
    if (p) {
      lua_createtable(L, 0, 3);
      lsw_set_integer(L, "around", around);
      lua_createtable(L, 3 * (int)count, 0);
      lua_createtable(L, (int)count, 0);
      for (size_t i = 0; i < count; i++, p += SW_FRAME_SURFACE) {
        for (size_t k = 0; k < 3; k++) {
          lua_pushnumber(L, (double)p[k]);
          lua_rawseti(L, -3, 3 * (lua_Integer)i + (lua_Integer)k + 1);
        }
        lsw_put_number(L, i, (double)p[3]);
      }
      lua_setfield(L, -3, "force");
      lua_setfield(L, -2, "points");
    } else {
      lua_pushboolean(L, 0);
    }
    lua_rawseti(L, -2, (lua_Integer)w + 1);
  }
}

/* Pushes for each wire { tension =, curvature =, contact =, twist_moment =, stress = }: flat lists
 * of a number for each node [N], [1/m], [N], [N m], [Pa]. */
static void push_values(lua_State *L, const sw_scene *scene, size_t frame, int unused SW_UNUSED) {
  size_t count;
  lua_Integer number = 0;
  lua_newtable(L);
  for (size_t w = 0; sw_scene_frame_wire(scene, frame, w, &count) != NULL; w++) {
    const float *p = sw_scene_frame_values(scene, frame, w, &count);
    if (!p && (count || sw_scene_frame_is_loose(scene, w))) continue;
    lua_createtable(L, 0, SW_FRAME_FORCE);
    for (size_t k = 0; k < SW_FRAME_FORCE; k++) {
      push_floats(L, p ? p + k : p, count, SW_FRAME_VALUES); /* empty if the wire is gone */
      lua_setfield(L, -2, channels[k]);
    }
    lua_rawseti(L, -2, ++number);
  }
}

/* Pushes for each its pose, for a hold also whether it holds; false for a removed obstacle. */
static void push_bodies(lua_State *L, const sw_scene *scene, size_t frame, int kind) {
  const float *p;
  int there;
  lua_newtable(L);
  for (size_t k = 0;
       (p = sw_scene_frame_body(scene, frame, (sw_frame_kind)kind, k, &there)) != NULL; k++) {
    if (there || kind == SW_FRAME_HOLDS)
      push_pose(L, p);
    else
      lua_pushboolean(L, 0);
    if (kind == SW_FRAME_HOLDS) lsw_set_flag(L, "held", there);
    lua_rawseti(L, -2, (lua_Integer)k + 1);
  }
}

static void push_energy(lua_State *L, const sw_scene *scene, size_t frame, int unused SW_UNUSED) {
  const double *e = sw_scene_frame_energy(scene, frame);
  lua_createtable(L, 0, SW_FRAME_ENERGIES);
  lsw_set_number(L, "kinetic", e[0]);
  lsw_set_number(L, "elastic", e[1]);
  lsw_set_number(L, "gravity", e[2]);
}

static const struct {
  const char *name;
  void (*push)(lua_State *L, const sw_scene *scene, size_t frame, int of);
  int of; /* which of the things that the function pushes */
} parts[] = {{"wires", push_wires, 0},
             {"values", push_values, 0},
             {"surfaces", push_surfaces, 0},
             {"particles", push_wires, 1},
             {"obstacles", push_bodies, SW_FRAME_OBSTACLES},
             {"holds", push_bodies, SW_FRAME_HOLDS},
             {"tools", push_bodies, SW_FRAME_TOOLS},
             {"energy", push_energy, 0}};

enum { PARTS = sizeof parts / sizeof parts[0] };

/* scene:frame(i) -> { t, wires, values, surfaces, particles, obstacles (false: removed), holds,
 * tools, energy }; nothing past the end. */
int lsw_scene_frame(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const lua_Integer i = lsw_integer(L, 2, "scene:frame: the number of the frame");
  lsw_quiet(L);
  if (i < 1 || (size_t)i > sw_scene_frames(scene)) return 0;
  const size_t frame = (size_t)i - 1;
  lua_createtable(L, 0, 1 + PARTS);
  lsw_set_number(L, "t", sw_scene_frame_time(scene, frame));
  for (int k = 0; k < PARTS; k++) {
    parts[k].push(L, scene, frame, parts[k].of);
    lua_setfield(L, -2, parts[k].name);
  }
  return 1;
}

int lsw_scene_frame_count(lua_State *L) {
  lua_pushinteger(L, (lua_Integer)sw_scene_frames(lsw_check_scene(L)));
  return 1;
}

int lsw_scene_clear_frames(lua_State *L) {
  LSW_DO(L, sw_scene_clear_frames, lsw_check_scene(L));
  return 0;
}

static int last_frame(lua_State *L) {
  lua_pushinteger(L, (lua_Integer)sw_scene_frames(lsw_check_scene(L)));
  return lsw_scene_frame(L);
}

/* core.frame_now(scene) -> as scene:frame, for the present state */
static int mod_frame_now(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  lua_settop(L, 1);
  LSW_DO(L, sw_scene_readable, scene);
  LSW_DO_FORCES(L, sw_scene_frame_now, scene);
  lsw_quiet(L);
  lua_pushcfunction(L, last_frame);
  lua_pushvalue(L, 1);
  const int failed = lua_pcall(L, 1, 1, 0);
  sw_scene_drop_last_frame(scene);
  return failed ? lua_error(L) : 1;
}

/* core.close_frames(scene): adds the frame of a run's end. */
static int mod_close_frames(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  lua_settop(L, 1);
  LSW_DO(L, sw_scene_readable, scene);
  LSW_DO_FORCES(L, sw_scene_close_frames, scene);
  return 0;
}

/* core.frames_closed(scene) -> whether the last frame is that of a run's end */
static int mod_frames_closed(lua_State *L) {
  lua_pushboolean(L, sw_scene_frames_closed(lsw_check_scene(L)));
  return 1;
}

/* core.add_between(scene, t [s]) -> number of a frame added last, or nothing: see frames.h. The
 * caller drops it with core.drop_frames(scene, number of frames that stay). */
static int mod_add_between(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  int added;
  const double t = lsw_number(L, 2, "add_between: time", "s");
  LSW_DO(L, sw_scene_add_between, scene, t, &added);
  if (!added) return 0;
  lua_pushinteger(L, (lua_Integer)sw_scene_frames(scene));
  return 1;
}

static int mod_drop_frames(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  const lua_Integer stay = lsw_integer(L, 2, "drop_frames: number");
  while ((lua_Integer)sw_scene_frames(scene) > stay && stay >= 0) sw_scene_drop_last_frame(scene);
  return 0;
}

/* core.keep_frames(scene [, memory [B]]): sets the memory limit of frames. */
static int mod_keep_frames(lua_State *L) {
  const double memory =
      lua_isnoneornil(L, 2) ? SW_FRAME_MEMORY : lsw_number(L, 2, "keep_frames: memory", "B");
  LSW_DO(L, sw_scene_keep_frames, lsw_check_scene(L), memory);
  return 0;
}

/* core.frames_thinned(scene) -> n: one of n frames was kept; 1, or a power of 2 after thinning */
static int mod_frames_thinned(lua_State *L) {
  lua_pushinteger(L, (lua_Integer)sw_scene_frames_thinned(lsw_check_scene(L)));
  return 1;
}

/* core.frame_times(scene) -> list of the times of all frames [s] */
static int mod_frame_times(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  lsw_quiet(L);
  const size_t count = sw_scene_frames(scene);
  lua_createtable(L, (int)count, 0);
  for (size_t f = 0; f < count; f++) lsw_put_number(L, f, sw_scene_frame_time(scene, f));
  return 1;
}

/* core.frame_range(scene, quantity) -> smallest and largest value in all frames; nothing if there
 * is no value */
static int mod_frame_range(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const int channel = luaL_checkoption(L, 2, NULL, channels);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (size_t f = 0; f < sw_scene_frames(scene); f++)
    for (size_t w = 0; w < sw_scene_frame_wires(scene); w++) {
      size_t count;
      const float *p = sw_scene_frame_values(scene, f, w, &count);
      for (size_t i = 0; p && i < count; i++) {
        const double x = (double)p[SW_FRAME_VALUES * i + (size_t)channel];
        if (isfinite(x)) low = fmin(low, x), high = fmax(high, x);
      }
    }
  if (!(low <= high)) return 0;
  lua_pushnumber(L, low), lua_pushnumber(L, high);
  return 2;
}

/* Returns the index (from 0) of the wire whose number (from 1) is at the stack index `at`. */
static size_t wire_index(lua_State *L, int at, const sw_scene *scene) {
  const lua_Integer w = lsw_integer(L, at, "frames: wire");
  const size_t count = sw_scene_frame_wires(scene);
  if (w < 1 || (size_t)w > count)
    luaL_error(L, "frames: wire %d is not allowed; there are %d", (int)w, (int)count);
  return (size_t)w - 1;
}

/* core.frames_sweep(scene, w, start [s]) -> { x1, y1, z1, x2, y2, z2, step = }: the box that wire w
 * swept and its largest move between two frames [m]; largest angle by which it turns along its
 * length [rad]; largest acceleration of a node from successive frames, and from every second frame
 * [m/s2], nil if there are too few */
static int mod_frames_sweep(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const size_t w = wire_index(L, 2, scene);
  const double start = lsw_number(L, 3, "frames_sweep: start", "s");
  sw_swept swept;
  lsw_quiet(L);
  sw_scene_frames_sweep(scene, start, w, &swept);
  lua_createtable(L, 6, 1);
  for (int k = 0; k < 3; k++) {
    lsw_put_number(L, k, swept.low[k]);
    lsw_put_number(L, k + 3, swept.high[k]);
  }
  lsw_set_number(L, "step", swept.step);
  lua_pushnumber(L, swept.turning);
  for (size_t stride = 1; stride <= 2; stride++) {
    const double most = sw_scene_frames_acceleration(scene, start, w, stride);
    if (most >= 0)
      lua_pushnumber(L, most);
    else
      lua_pushnil(L);
  }
  return 4;
}

/* core.frames_apart(scene, w, v, start [s], enough [m], most [m] or nil, straight) -> least
 * distance of the axes of wires w and v [m]; the search stops below enough and ignores distances
 * above most. straight: without their bow beside edges */
static int mod_frames_apart(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const size_t w = wire_index(L, 2, scene), v = wire_index(L, 3, scene);
  const double start = lsw_number(L, 4, "frames_apart: start", "s");
  const int bound = !lua_isnoneornil(L, 6);
  const sw_apart_request request = {
      .enough = lsw_number(L, 5, "frames_apart: enough", "m"),
      .most = bound ? lsw_number(L, 6, "frames_apart: most", "m") : HUGE_VAL,
      .straight = lua_toboolean(L, 7)};
  double apart = 0;
  sw_error err = {""};
  lsw_must(L, sw_scene_frames_apart(scene, start, w, v, &request, &apart, &err), &err);
  lua_pushnumber(L, apart);
  return 1;
}

/* core.frames_flat(scene, w, start [s]) -> true if wire w and all forces on it stay in one plane */
static int mod_frames_flat(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const size_t w = wire_index(L, 2, scene);
  lua_pushboolean(L, sw_scene_frames_flat(scene, lsw_number(L, 3, "frames_flat: start", "s"), w));
  return 1;
}

/* core.frames_lever(scene, w, start [s]) -> largest change of wire w's tension by the lever of
 * friction along it, 0 to 1 [-] */
static int mod_frames_lever(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const size_t w = wire_index(L, 2, scene);
  lua_pushnumber(L, sw_scene_frames_lever(scene, lsw_number(L, 3, "frames_lever: start", "s"), w));
  return 1;
}

/* core.frame_contact(scene, i, w) -> contact forces across wire w at its nodes in frame i [N], and
 * the distance of its first two nodes [m]; nothing if nothing touches it */
static int mod_frame_contact(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const lua_Integer i = lsw_integer(L, 2, "frame_contact: frame");
  const size_t w = wire_index(L, 3, scene);
  size_t count = 0;
  double most = 0;
  lsw_quiet(L);
  if (i < 1 || (size_t)i > sw_scene_frames(scene)) return 0;
  const float *x = sw_scene_frame_wire(scene, (size_t)i - 1, w, &count);
  const float *p = x ? sw_scene_frame_values(scene, (size_t)i - 1, w, &count) : NULL;
  for (size_t n = 0; p && n < count; n++)
    most = fmax(most, (double)p[SW_FRAME_VALUES * n + SW_FRAME_CONTACT]);
  if (!(most > 0) || count < 2) return 0;
  push_floats(L, p + SW_FRAME_CONTACT, count, SW_FRAME_VALUES);
  lua_pushnumber(L, sw_dist(sw_vec_of(x), sw_vec_of(x + 3)));
  return 2;
}

static sw_press_request check_press(lua_State *L) {
  const size_t count = (size_t)lua_rawlen(L, 5) / 2;
  sw_press_request r = {.spans = count, .place = lsw_number(L, 4, "frames_press: place", "-")};
  r.span = lua_newuserdatauv(L, (count + 1) * sizeof *r.span, 0);
  for (size_t k = 0; k < 2 * count; k++) {
    lua_rawgeti(L, 5, (lua_Integer)k + 1);
    r.span[k / 2][k % 2] = luaL_checknumber(L, -1);
    lua_pop(L, 1);
  }
  return r;
}

/* core.frames_press(scene, w, start [s], place, { middle, half length, ... } [m]) -> flat list of 5
 * numbers for each frame from start on in which something presses on line w outside the given
 * spans: largest load [N/m], largest load from both sides [N/m], first and last node of the pressed
 * length (load of at least place times the largest), number of nodes */
static int mod_frames_press(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const size_t w = wire_index(L, 2, scene);
  const double start = lsw_number(L, 3, "frames_press: start", "s");
  luaL_checktype(L, 5, LUA_TTABLE);
  const sw_press_request request = check_press(L);
  lsw_quiet(L);
  size_t at = 0;
  lua_newtable(L);
  for (size_t f = 0; f < sw_scene_frames(scene); f++) {
    sw_press p;
    if (sw_scene_frame_time(scene, f) < start) continue;
    if (!sw_scene_frame_press(scene, f, w, &request, &p)) continue;
    const double row[] = {p.load, p.squeeze, (double)p.first, (double)p.last, (double)p.count};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) lsw_put_number(L, at++, row[k]);
  }
  return 1;
}

const luaL_Reg lsw_module_frames[] = {
    {"frame_now", mod_frame_now},           {"frame_times", mod_frame_times},
    {"frame_range", mod_frame_range},       {"keep_frames", mod_keep_frames},
    {"frames_thinned", mod_frames_thinned}, {"frames_press", mod_frames_press},
    {"frames_sweep", mod_frames_sweep},     {"frames_apart", mod_frames_apart},
    {"frame_contact", mod_frame_contact},   {"frames_flat", mod_frames_flat},
    {"frames_lever", mod_frames_lever},     {"close_frames", mod_close_frames},
    {"frames_closed", mod_frames_closed},   {"add_between", mod_add_between},
    {"drop_frames", mod_drop_frames},       {NULL, NULL}};
