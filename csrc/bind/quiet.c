/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps finalisers from running while a method reads lists of a scene: a Lua __gc may close the
 * scene or change its lists, and any call that makes a Lua value may run it. The collector is
 * stopped for so long. */
#include <math.h>

#include "bind/child.h"

/* A collector that starts anew has forgotten how much may be allocated until its next cycle. It
 * would work at every call. So this is counted here, as the collector does it: a cycle begins when
 * the memory has grown by a share that is its `pause`. */
typedef struct quiet {
  int mark;   /* memory of Lua after the last cycle [KiB] */
  int before; /* and when the collector was stopped [KiB] */
  int steps;  /* of the present cycle, of those asked for here [-] */
} quiet;

static const char key = 0; /* its address is the guard's key in the registry */

/* Memory that may be allocated until the next cycle; below 0: a cycle is due [KiB]. */
static double credit(lua_State *L, const quiet *q, int now) {
  const int pause = lua_gc(L, LUA_GCSETPAUSE, 200);
  lua_gc(L, LUA_GCSETPAUSE, pause);
  return fmin(q->mark * (double)pause / 100, 1e9) - now;
}

/* In generational mode no step tells that a cycle has ended, so this many count as one. A step of
 * the other mode does the work for about 800 KiB. */
static int most_steps(int now) { return 20 + now / 400; }

static int end_quiet(lua_State *L) {
  quiet *q = lua_touserdata(L, 1);
  const int now = lua_gc(L, LUA_GCCOUNT);
  const double left = credit(L, q, now);
  lua_gc(L, LUA_GCRESTART);
  if (left > 0 && !q->steps) {
    lua_gc(L, LUA_GCSTEP, -(int)left); /* adds to the collector's debt, here less than nothing */
  } else if (lua_gc(L, LUA_GCSTEP, now - q->before) || ++q->steps > most_steps(now)) {
    q->mark = lua_gc(L, LUA_GCCOUNT);
    q->steps = 0;
  }
  return 0;
}

void lsw_open_quiet(lua_State *L) {
  quiet *q = lua_newuserdatauv(L, sizeof *q, 0);
  *q = (quiet){.mark = lua_gc(L, LUA_GCCOUNT)};
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, end_quiet);
  lua_setfield(L, -2, "__close");
  lua_setmetatable(L, -2);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &key);
}

void lsw_quiet(lua_State *L) {
  lsw_still_open(L);
  lua_rawgetp(L, LUA_REGISTRYINDEX, &key);
  if (lua_gc(L, LUA_GCISRUNNING) != 1) return; /* stopped by the script, or inside a finaliser */
  quiet *q = lua_touserdata(L, -1);
  q->before = lua_gc(L, LUA_GCCOUNT);
  if (q->before < q->mark) q->mark = q->before; /* a cycle of the collector's own freed memory */
  lua_gc(L, LUA_GCSTOP);
  lua_toclose(L, -1);
}
