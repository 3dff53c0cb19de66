/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs chunks and reports their errors. */
#include <errno.h>
#include <lauxlib.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "host/ctrl_c.h"
#include "host/host.h"
#include "softworld.h"

int host_call(lua_State *L, int count, int results) {
  const int place = lua_gettop(L) - count;
  lua_pushcfunction(L, host_traceback);
  lua_insert(L, place);
  int status = lua_pcall(L, count, results, place);
  if (status == LUA_OK && sw_interrupted()) { /* the Ctrl-C came too late for a hook */
    sw_interrupt_clear();
    lua_settop(L, place);
    lua_pushliteral(L, "interrupted");
    status = LUA_ERRRUN;
  }
  lua_remove(L, place);
  return status;
}

/* Passes a text to softworld.program.log if that is loaded; leaves the stack as it was. */
static void log_text(lua_State *L, const char *text) {
  const int top = lua_gettop(L);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  if (lua_getfield(L, -1, "softworld.program.log") == LUA_TTABLE &&
      lua_getfield(L, -1, "line") == LUA_TFUNCTION) {
    lua_pushstring(L, text);
    (void)lua_pcall(L, 1, 0, 0);
  }
  lua_settop(L, top);
}

int host_log_open(lua_State *L, const host_options *o) {
  lua_getglobal(L, "require");
  lua_pushliteral(L, "softworld.program.log");
  if (host_call(L, 1, 1) == LUA_OK) {
    lua_getfield(L, -1, "open");
    lua_pushstring(L, o->log);
    lua_pushstring(L, o->script ? o->argv[o->script] : "softworld");
    if (host_call(L, 2, 0) == LUA_OK) return lua_pop(L, 1), HOST_OK;
  }
  return host_report(L), HOST_FAILED;
}

int host_report(lua_State *L) {
  size_t length = 0;
  const char *text = lua_tolstring(L, -1, &length);
  fflush(stdout); /* the script's output comes first */
  fwrite(text ? text : "(no message)", 1, text ? length : 12, stderr);
  fputc('\n', stderr);
  if (text) log_text(L, text);
  const int stopped = host_ctrl_c_seen() && text && strstr(text, "interrupted");
  lua_pop(L, 1);
  return stopped ? HOST_INTERRUPTED : HOST_FAILED;
}

/* Prints a message instead of running a chunk; returns HOST_FAILED. */
static int refuse(const char *name, const char *why) {
  fprintf(stderr, "softworld: cannot run '%s': %s\n", name, why);
  return HOST_FAILED;
}

/* Refuses a script that is not there: it names the script with .lua, or the command that was meant.
 */
static int refuse_missing(lua_State *L, const char *name) {
  static const char *const commands[] = {"doc", "new", "lint"};
  const char *why = strerror(errno); /* before the next call changes it */
  const int top = lua_gettop(L);
  struct stat info;
  const char *near = lua_pushfstring(L, "%s.lua", name);
  if (stat(near, &info) != 0)
    near =
        sw_nearest_name(name, commands, sizeof commands[0], sizeof commands / sizeof commands[0]);
  refuse(name, near ? lua_pushfstring(L, "%s; did you mean 'softworld %s'?", why, near) : why);
  lua_settop(L, top);
  return HOST_FAILED;
}

/* Pushes the words after argv[at] and returns their number; at = 0: none. */
static int push_arguments(lua_State *L, const host_options *o, int at) {
  const int count = at ? o->argc - at - 1 : 0;
  luaL_checkstack(L, count, "too many arguments to the script");
  for (int i = 0; i < count; i++) lua_pushstring(L, o->argv[at + 1 + i]);
  return count;
}

/* Prints the text at a stack index, if there is one. Returns 1 if there is. */
static int tell_text(lua_State *L, int at) {
  if (!lua_isstring(L, at)) return 0;
  fflush(stdout);
  fprintf(stderr, "%s\n", lua_tostring(L, at));
  log_text(L, lua_tostring(L, at));
  return 1;
}

/* At a script's end, reports failed runs, and events of other runs, that the script has not read.
 * Returns HOST_FAILED if there are failed ones. */
static int tell_unread(lua_State *L) {
  const int top = lua_gettop(L);
  int status = HOST_OK;
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  if (lua_getfield(L, -1, "softworld.unread") == LUA_TTABLE &&
      lua_getfield(L, -1, "finish") == LUA_TFUNCTION) {
    if (host_call(L, 0, 2) != LUA_OK) {
      status = host_report(L);
    } else {
      if (tell_text(L, -2)) status = HOST_FAILED;
      tell_text(L, -1);
    }
  }
  lua_settop(L, top);
  return status;
}

/* Calls a function of softworld.unread, which keeps the results of checks. Returns a Lua status. */
static int call_unread(lua_State *L, const char *name, int results) {
  lua_getglobal(L, "require");
  lua_pushliteral(L, "softworld.unread");
  const int status = host_call(L, 1, 1);
  if (status != LUA_OK) return status;
  lua_getfield(L, -1, name);
  lua_remove(L, -2);
  return host_call(L, 0, results);
}

/* Prints the result of the checks of a script that has ended; returns the exit code of --check. */
static int check_exit(lua_State *L) {
  const int top = lua_gettop(L);
  int status;
  if (call_unread(L, "exit", 2) != LUA_OK) {
    status = host_report(L);
  } else {
    status = (int)lua_tointeger(L, -2);
    fflush(stdout);
    fprintf(stderr, "%s\n", lua_tostring(L, -1));
    log_text(L, lua_tostring(L, -1));
  }
  lua_settop(L, top);
  return status;
}

int host_run_code(lua_State *L, const char *code) {
  host_ctrl_c_reset();
  int status = luaL_loadbufferx(L, code, strlen(code), "=-e", "t");
  if (status == LUA_OK) status = host_call(L, 0, 0);
  return status == LUA_OK ? tell_unread(L) : host_report(L);
}

int host_run_script(lua_State *L, const host_options *o) {
  struct stat info;
  const char *name = o->script ? o->argv[o->script] : "-";
  const char *file = strcmp(name, "-") == 0 ? NULL : name;
  host_ctrl_c_reset();
  if (file && stat(file, &info) != 0) return refuse_missing(L, name);
  if (file && S_ISDIR(info.st_mode)) return refuse(name, "it is a directory");
  int status = luaL_loadfilex(L, file, "t");
  if (status == LUA_ERRFILE) {
    lua_pop(L, 1);
    return refuse(name, host_ctrl_c_seen() ? "interrupted" : strerror(errno));
  }
  if (status == LUA_ERRSYNTAX && strstr(lua_tostring(L, -1), "binary chunk")) {
    lua_pop(L, 1);
    return refuse(name, "it is compiled Lua; run its source");
  }
  if (status == LUA_OK && o->check) status = call_unread(L, "guard_exit", 0);
  if (status == LUA_OK) status = host_call(L, push_arguments(L, o, o->script), 0);
  if (status != LUA_OK) return host_report(L);
  const int unread = tell_unread(L);
  return o->check && unread != HOST_INTERRUPTED ? check_exit(L) : unread;
}

/* Pushes the module of the command's name and returns 1; if there is none, pushes an error text and
 * returns 0. */
static int push_command(lua_State *L, const char *name) {
  lua_getglobal(L, "require");
  lua_pushfstring(L, "softworld.program.%s", name);
  return host_call(L, 1, 1) == LUA_OK;
}

int host_run_command(lua_State *L, const host_options *o) {
  host_ctrl_c_reset();
  if (!push_command(L, o->argv[o->command])) return host_report(L);
  if (host_call(L, push_arguments(L, o, o->command), 1) != LUA_OK) return host_report(L);
  const int status = (int)lua_tointeger(L, -1);
  lua_pop(L, 1);
  return status;
}
