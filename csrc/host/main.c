/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The host program `softworld`: a Lua interpreter with the core built in. */
#include <errno.h>
#include <lauxlib.h>
#include <lua.h>
#include <lualib.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "bind/module.h"
#include "host/ctrl_c.h"
#include "host/host.h"
#include "softworld.h"

static void open_libraries(lua_State *L) {
  luaL_openlibs(L);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  lua_pushcfunction(L, luaopen_softworld_core);
  lua_setfield(L, -2, "softworld.core");
  lua_pop(L, 1);
}

/* Runs a command; or the -e codes, then the script, then the prompt, as the options ask. */
static int run_all(lua_State *L, const host_options *o) {
  int status = HOST_OK, at = 1;
  const char *code;
  if (o->log && host_log_open(L, o) != HOST_OK) return HOST_FAILED;
  if (o->command) return host_run_command(L, o);
  while (status == HOST_OK && (code = host_options_code(o, &at))) status = host_run_code(L, code);
  const int nothing = !o->codes && !o->version && !o->interactive;
  const char *may = o->functions ? "{ functions = true }" : "{}";
  char view[100];
  snprintf(view, sizeof view, "require('softworld'); require('softworld.view.view').%s %s",
           o->script ? "all" : "begin", may);
  if (o->view && !o->script) return host_run_code(L, view);
  if (status == HOST_OK && o->view) status = host_run_code(L, view);
  if (status == HOST_OK && (o->script || nothing)) status = host_run_script(L, o);
  if (status == HOST_OK && o->view)
    status = host_run_code(L, "require('softworld.view.view').stay()");
  if (!o->interactive) return status;
  /* the prompt also follows a failure, so that the user can look at the globals */
  const int left = host_repl(L);
  return left == HOST_OK ? status : left;
}

/* Runs in protected mode, so that even running out of memory ends with a message. */
static int protected_main(lua_State *L) {
  const host_options *o = lua_touserdata(L, 1);
  open_libraries(L);
  host_ctrl_c_open(L);
  host_push_arg(L, o);
  host_paths_open(L, o);
  lua_pushinteger(L, run_all(L, o));
  return 1;
}

/* Returns status, or a failure if the output cannot be written (full disk). */
static int flush_output(int status) {
  if (fflush(stdout) == 0 && !ferror(stdout)) return status;
  fprintf(stderr, "softworld: cannot write the output: %s\n", strerror(errno));
  return status == HOST_OK ? HOST_FAILED : status;
}

int main(int argc, char **argv) {
  host_options o;
  signal(SIGXFSZ,
         SIG_IGN); /* a file above the limit of ulimit -f is an error of writing, not an end */
  int status = host_options_read(&o, argc, argv);
  if (status != HOST_OK) return status;
  if (o.help) {
    host_options_help();
    return flush_output(HOST_OK);
  }
  if (o.version) puts("SoftWorld " SW_VERSION " (" LUA_RELEASE ")");
  lua_State *L = luaL_newstate();
  if (!L) {
    fputs("softworld: out of memory\n", stderr);
    return HOST_FAILED;
  }
  lua_pushcfunction(L, protected_main);
  lua_pushlightuserdata(L, &o);
  status = lua_pcall(L, 1, 1, 0) == LUA_OK ? (int)lua_tointeger(L, -1) : host_report(L);
  host_ctrl_c_close();
  lua_close(L);
  return flush_output(status);
}
