/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Workers of a study: forks of this process, with all that it has built. They exchange texts with
 * this process.
 *
 *   core.fork(f, memory) -> worker. The fork runs f(channel), then exits. memory: how much more
 *     than now it may use [B], 0 = any. nil and the reason if no worker can be started.
 *   worker:send(text) -> true if it was sent; worker:pid();
 *   worker:receive() -> text; nil, "signal" or "exit", and its number if the worker has ended
 *   worker:stop(): kills the worker and the processes it has started
 *   channel:send(text); channel:receive() -> text, or nil if there is nothing more to do
 *   core.ready(workers, seconds) -> indexes of the workers from which something can be received
 *   core.limit_cpu(seconds): kills this worker after so much processor time; 0 = never
 *   core.limit_steps(count) -> did the steps of runs exceed the limit before? Sets a new limit and
 *     counts from 0; 0 = any number.
 *   core.processors() -> processors that this process may use
 *
 * A text is one packet: it arrives whole or not at all. A worker has its own process group, so
 * Ctrl-C at a terminal reaches the parent only, and the processes it starts end with it. A worker
 * is killed when its parent ends. */
#include <errno.h>
#include <lauxlib.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bind/child.h"
#include "bind/process.h"

enum { LONGEST = 1 << 16, MOST = 1024 }; /* longest text [B], most workers [-] */

static const char WORKER[] = "softworld.worker";

typedef struct worker {
  int fd;      /* -1: closed */
  pid_t pid;   /* 0: the worker has ended, or this is its own end */
  pid_t owner; /* the process that may end the worker */
  int status;  /* exit status of waitpid; -1: none */
} worker;

static worker *check(lua_State *L, int index) { return luaL_checkudata(L, index, WORKER); }

/* Waits for the worker's end and takes its exit status; kills it first if kill_it. */
static void bury(worker *w, int kill_it) {
  if (w->fd >= 0) close(w->fd);
  w->fd = -1;
  if (w->pid <= 0 || w->owner != getpid()) return;
  siginfo_t info;
  if (kill_it) kill(w->pid, SIGKILL);
  w->status = -1;
  while (waitid(P_PID, (id_t)w->pid, &info, WEXITED | WNOWAIT) < 0)
    if (errno != EINTR) break;
  kill(-w->pid, SIGKILL); /* its process group, before the system can reuse its pid */
  while (waitpid(w->pid, &w->status, 0) < 0)
    if (errno != EINTR) break;
  w->pid = 0;
}

static int meth_stop(lua_State *L) {
  bury(check(L, 1), 1);
  return 0;
}

static int meth_pid(lua_State *L) { return lua_pushinteger(L, check(L, 1)->pid), 1; }

static int meth_send(lua_State *L) {
  size_t size;
  worker *w = check(L, 1);
  const char *text = luaL_checklstring(L, 2, &size);
  ssize_t n = -1;
  luaL_argcheck(L, size > 0 && size <= LONGEST, 2, "a text of 1 to 65536 bytes is wanted");
  do n = w->fd >= 0 ? send(w->fd, text, size, MSG_NOSIGNAL) : -1;
  while (n < 0 && w->fd >= 0 && errno == EINTR);
  lua_pushboolean(L, n == (ssize_t)size);
  return 1;
}

static int push_end(lua_State *L, worker *w) {
  const int child_end = w->pid <= 0;
  bury(w, 0);
  lua_pushnil(L);
  if (child_end) return 1;
  const int killed = w->status != -1 && WIFSIGNALED(w->status);
  lua_pushstring(L, killed ? "signal" : "exit");
  lua_pushinteger(L, killed ? WTERMSIG(w->status) : w->status == -1 ? -1 : WEXITSTATUS(w->status));
  return 3;
}

static int meth_receive(lua_State *L) {
  luaL_Buffer b;
  worker *w = check(L, 1);
  ssize_t n = 0;
  char *room = luaL_buffinitsize(L, &b, LONGEST);
  do n = w->fd >= 0 ? recv(w->fd, room, LONGEST, 0) : 0;
  while (n < 0 && errno == EINTR);
  luaL_pushresultsize(&b, n > 0 ? (size_t)n : 0);
  return n > 0 ? 1 : push_end(L, w);
}

static const luaL_Reg methods[] = {{"send", meth_send},
                                   {"receive", meth_receive},
                                   {"pid", meth_pid},
                                   {"stop", meth_stop},
                                   {NULL, NULL}};

static worker *new_worker(lua_State *L) {
  worker *w = lsw_keep(L, sizeof *w, WORKER, methods, meth_stop);
  *w = (worker){.fd = -1, .status = -1, .owner = getpid()};
  return w;
}

/* Runs in the fork. Stack index 1 is the function, 3 the worker's end of the connection. */
static void work(lua_State *L, pid_t parent, double memory) {
  lsw_process_follow(parent);
  setpgid(0, 0);
  lsw_process_silence(0, 0, -1);
  lsw_process_limit(RLIMIT_CORE, 0, 0);
  if (memory > 0) lsw_process_limit_memory(memory);
  lsw_process_reset_signals();
  signal(SIGINT, SIG_IGN); /* the parent decides */
  sw_interrupt_clear();
  lua_pushvalue(L, 1);
  lua_pushvalue(L, 3);
  const int status = lua_pcall(L, 1, 0, 0);
  fflush(NULL);
  _exit(status == LUA_OK ? 0 : 1);
}

static int is_worker; /* 1: this process is a worker */

static int mod_fork(lua_State *L) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  const double memory = luaL_optnumber(L, 2, 0);
  int ends[2];
  if (lsw_servers() > 0)
    return luaL_error(L,
                      "no worker can be forked while a live view is open: close the view, or "
                      "compute in this process with workers = 0");
  lua_settop(L, 1);
  worker *ours = new_worker(L), *theirs = new_worker(L);
  luaL_checkstack(L, 8, "fork");
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return lsw_failed(L);
  ours->fd = ends[0], theirs->fd = ends[1];
  const pid_t parent = getpid();
  fflush(NULL); /* else both processes would write the buffered output */
  const pid_t pid = lsw_process_fork();
  if (pid == 0) {
    close(ours->fd);
    ours->fd = -1;
    is_worker = 1;
    work(L, parent, memory);
  }
  const int why = errno;
  bury(theirs, 0);
  if (pid < 0) {
    bury(ours, 0);
    errno = why;
    return lsw_failed(L);
  }
  ours->pid = pid;
  setpgid(pid, pid); /* both processes do it, as either may run first */
  lua_settop(L, 2);
  return 1;
}

static int mod_ready(lua_State *L) {
  struct pollfd p[MOST];
  const double seconds = luaL_checknumber(L, 2);
  luaL_checktype(L, 1, LUA_TTABLE);
  const lua_Integer count = luaL_len(L, 1);
  luaL_argcheck(L, count <= MOST, 1, "too many workers");
  for (lua_Integer k = 0; k < count; k++) {
    lua_geti(L, 1, k + 1);
    p[k] = (struct pollfd){check(L, -1)->fd, POLLIN, 0};
    lua_pop(L, 1);
  }
  lsw_poll(L);
  const int n = poll(p, (nfds_t)count, (int)(1e3 * seconds));
  lsw_poll(L);
  lua_newtable(L);
  lua_Integer found = 0;
  for (lua_Integer k = 0; k < count && n > 0; k++)
    if (p[k].revents != 0) {
      lua_pushinteger(L, k + 1);
      lua_rawseti(L, -2, ++found);
    }
  return 1;
}

static int mod_limit_cpu(lua_State *L) {
  const double seconds = luaL_checknumber(L, 1);
  if (!is_worker) return luaL_error(L, "core.limit_cpu ends its process, and is for workers alone");
  luaL_argcheck(L, seconds >= 0 && seconds < 1e9, 1, "from 0 to 1e9 s");
  struct itimerval t = {{0, 0}, {(time_t)seconds, (suseconds_t)(1e6 * (seconds - floor(seconds)))}};
  setitimer(ITIMER_PROF, &t, NULL); /* SIGPROF, which has no handler in a worker, kills it */
  return 0;
}

static int mod_limit_steps(lua_State *L) {
  const lua_Integer steps = lsw_integer(L, 1, "core.limit_steps: the number of steps");
  lua_pushboolean(L, sw_quota_over());
  sw_quota_set((long)steps);
  return 1;
}

static int mod_processors(lua_State *L) {
  cpu_set_t set;
  const int known = sched_getaffinity(0, sizeof set, &set) == 0;
  lua_pushinteger(L, known ? CPU_COUNT(&set) : 1);
  return 1;
}

const luaL_Reg lsw_module_worker[] = {{"fork", mod_fork},
                                      {"ready", mod_ready},
                                      {"limit_cpu", mod_limit_cpu},
                                      {"limit_steps", mod_limit_steps},
                                      {"processors", mod_processors},
                                      {NULL, NULL}};
