/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stops Lua code at a Ctrl-C. A debug hook can stop pure Lua code, but a hook belongs
 * to one coroutine, and a permanent hook halves the speed of Lua. So the signal
 * handler sets hooks when the Ctrl-C comes, on the running coroutine and on all
 * coroutines that wait for it; resume and wrap keep this chain. The first hook (or
 * polling C code) that sees the flag clears it and raises. The other hooks then find
 * the flag cleared and remove themselves. Coroutines resumed by other C code are not
 * in the chain: they stop when they return to a coroutine that is. */
#include "host/ctrl_c.h"

#include <errno.h>
#include <lauxlib.h>
#include <lualib.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <time.h>
#include <unistd.h>

#include "host/host.h"
#include "softworld.h"

typedef struct frame {
  lua_State *L;
  struct frame *outer;
} frame;

static frame base;
static frame *volatile running;
static pthread_t owner; /* the thread that runs Lua */
static volatile sig_atomic_t seen, prompt, cancelled;
static struct timespec last; /* time of the previous Ctrl-C; tv_sec 0 = none */

/* Pushes the position of the script's innermost running line, also when that line called the
 * library; without a script, the position of the running code. */
static void push_place(lua_State *L) {
  lua_Debug at;
  for (int level = 0; lua_getstack(L, level, &at); level++) { /* 0: the function the hook stopped */
    if (!lua_getinfo(L, "Sl", &at) || at.currentline < 0 || host_is_library(L, at.source)) continue;
    lua_pushfstring(L, "%s:%d: ", at.short_src, at.currentline);
    return;
  }
  luaL_where(L, 0);
}

static void stop(lua_State *L, lua_Debug *ar SW_UNUSED) {
  lua_sethook(L, NULL, 0, 0);
  if (!sw_interrupted()) return;
  sw_interrupt_clear();
  push_place(L);
  lua_pushliteral(L, "interrupted");
  lua_concat(L, 2);
  lua_error(L);
}

/* Returns the time since the previous Ctrl-C [s], and notes this one. */
static double since_last(void) {
  struct timespec now = {0, 0};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const double since =
      (double)(now.tv_sec - last.tv_sec) + 1e-9 * (double)(now.tv_nsec - last.tv_nsec);
  const int first = last.tv_sec == 0;
  last = now;
  return first ? 1e9 : since;
}

/* A second Ctrl-C within a second ends the process, in case code catches the error or
 * never polls. Signals less than 0.05 s apart count as one: programs like timeout(1)
 * send two at once. */
static void stop_running(void) {
  const double since = since_last();
  if (since < 0.05) return;
  if (since < 1.0) _exit(HOST_INTERRUPTED);
  seen = 1;
  sw_interrupt_raise();
  for (frame *f = running; f; f = f->outer) lua_sethook(f->L, stop, LUA_MASKCOUNT, 1);
}

static void on_sigint(int number) {
  const int kept = errno;
  if (!pthread_equal(pthread_self(), owner)) {
    pthread_kill(owner, number); /* only the thread of Lua may set hooks */
  } else if (prompt) {
    cancelled = 1;
  } else {
    stop_running();
  }
  errno = kept;
}

/* --- the chain of running coroutines --------------------------------------- */

static void enter(frame *f, lua_State *co) {
  f->L = co;
  f->outer = running;
  atomic_signal_fence(memory_order_seq_cst); /* the handler must see a complete frame */
  running = f;
}

static void leave(const frame *f) { running = f->outer; }

/* Moves count arguments from L's top into co and runs it. Returns the number of
 * results, which are on top of co, or -1 with the error value there. It never raises,
 * so no dead frame stays in the chain. */
static int transfer(lua_State *L, lua_State *co, int count) {
  frame f;
  int results = 0;
  if (!lua_checkstack(co, count + 1)) {
    lua_pop(L, count);
    lua_pushliteral(co, "too many arguments to resume");
    return -1;
  }
  lua_xmove(L, co, count);
  enter(&f, co);
  const int status = lua_resume(co, L, count, &results);
  leave(&f);
  if (status != LUA_OK && status != LUA_YIELD) return -1;
  if (!lua_checkstack(L, results + 1)) {
    lua_pop(co, results);
    lua_pushliteral(co, "too many results to resume");
    return -1;
  }
  return results;
}

/* Moves the error value from the top of co to L. Corrects its position here, because the calls of
 * co are known only now. */
static void take_error(lua_State *L, lua_State *co) {
  const int dead = lua_status(co) != LUA_OK && lua_status(co) != LUA_YIELD;
  lua_xmove(co, L, 1);
  if (dead && lua_type(L, -1) == LUA_TSTRING) host_move_position(L, co, 0);
}

static int co_resume(lua_State *L) {
  lua_State *co = lua_tothread(L, 1);
  luaL_argexpected(L, co, 1, "coroutine");
  const int results = transfer(L, co, lua_gettop(L) - 1);
  lua_settop(L, L == co ? lua_gettop(L) : 1);
  lua_pushboolean(L, results >= 0);
  if (L == co) { /* co resumes itself: the message is already here */
    lua_insert(L, -2);
    return 2;
  }
  if (results < 0) {
    take_error(L, co);
    return 2;
  }
  lua_xmove(co, L, results);
  return results + 1;
}

static int wrap_call(lua_State *L) {
  lua_State *co = lua_tothread(L, lua_upvalueindex(1));
  const int results = transfer(L, co, lua_gettop(L));
  if (results >= 0) {
    lua_xmove(co, L, results);
    return results;
  }
  const int status = lua_status(co);
  take_error(L, co);
  if (status != LUA_OK && status != LUA_YIELD) { /* co died: close its variables */
    frame f;
    lua_pushvalue(L, -1);
    lua_xmove(L, co, 1);
    enter(&f, co);
    lua_resetthread(co);
    leave(&f);
    lua_xmove(co, L, 1); /* the same error, or the error of a variable's __close */
  }
  if (status != LUA_ERRMEM && lua_type(L, -1) == LUA_TSTRING) {
    luaL_where(L, 1);
    lua_insert(L, -2);
    lua_concat(L, 2);
  }
  return lua_error(L);
}

static int co_wrap(lua_State *L) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  lua_State *co = lua_newthread(L);
  lua_pushvalue(L, 1);
  lua_xmove(L, co, 1);
  lua_pushcclosure(L, wrap_call, 1);
  return 1;
}

/* --- functions for the host ------------------------------------------------ */

void host_ctrl_c_open(lua_State *L) {
  static const luaL_Reg functions[] = {{"resume", co_resume}, {"wrap", co_wrap}, {NULL, NULL}};
  lua_getglobal(L, LUA_COLIBNAME);
  luaL_setfuncs(L, functions, 0);
  lua_pop(L, 1);
  base.L = L;
  running = &base;
  owner = pthread_self();
  host_ctrl_c_install();
}

void host_ctrl_c_install(void) {
  struct sigaction action = {.sa_handler = on_sigint}, before;
  sigemptyset(&action.sa_mask);
  /* A shell starts background jobs with SIGINT ignored; that stays so. Without
   * SA_RESTART a read from the terminal returns, so that the hook can run. */
  if (sigaction(SIGINT, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
    sigaction(SIGINT, &action, NULL);
}

void host_ctrl_c_close(void) {
  struct sigaction before;
  if (sigaction(SIGINT, NULL, &before) == 0 && before.sa_handler == on_sigint)
    signal(SIGINT, SIG_DFL);
  running = NULL;
}

void host_ctrl_c_reset(void) {
  seen = 0;
  last.tv_sec = 0;
  sw_interrupt_clear();
}

int host_ctrl_c_seen(void) { return seen; }

void host_ctrl_c_at_prompt(int on) { prompt = on; }

int host_ctrl_c_cancelled(void) {
  const int was = cancelled;
  cancelled = 0;
  return was;
}
