/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The prompt: reads a chunk, runs it, prints its values, and repeats. Completion and
 * printing of tables are in lua/softworld/prompt/repl.lua; the prompt also works without
 * that file. */
#include <lauxlib.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "host/ctrl_c.h"
#include "host/host.h"
#include "softworld.h"

static const char show_key; /* its address is the registry key of repl.show */

/* --- setting up ----------------------------------------------------------- */

/* Pushes require(name); nil after a note if that fails. */
static void require_module(lua_State *L, const char *name) {
  lua_getglobal(L, "require");
  lua_pushstring(L, name);
  if (lua_pcall(L, 1, 1, 0) == LUA_OK) return;
  const char *text = luaL_tolstring(L, -1, NULL);
  fprintf(stderr, "note: %s cannot be loaded: %.*s\n", name, (int)strcspn(text, "\n"), text);
  lua_pop(L, 2);
  lua_pushnil(L);
}

/* Sets the globals sw, help and time. */
static int set_globals(lua_State *L) {
  require_module(L, "softworld");
  if (lua_isnil(L, -1)) return 0;
  lua_pushvalue(L, -1);
  lua_setglobal(L, "sw");
  if (lua_istable(L, -1) && lua_getfield(L, -1, "help") != LUA_TNIL &&
      lua_getglobal(L, "help") == LUA_TNIL) {
    lua_pop(L, 1);
    lua_setglobal(L, "help");
  }
  require_module(L, "softworld.prompt.repl");
  if (lua_istable(L, -1) && lua_getfield(L, -1, "time") == LUA_TFUNCTION &&
      lua_getglobal(L, "time") == LUA_TNIL) {
    lua_pop(L, 1);
    lua_setglobal(L, "time");
  }
  return 0;
}

/* Sets the printing and completion from softworld.prompt.repl. */
static int set_tools(lua_State *L) {
  require_module(L, "softworld.prompt.repl");
  if (!lua_istable(L, -1)) lua_newtable(L);
  lua_getfield(L, -1, "show");
  lua_rawsetp(L, LUA_REGISTRYINDEX, &show_key);
  lua_getfield(L, -1, "complete");
  host_line_open(L);
  return 0;
}

static void set_up(lua_State *L) {
  lua_CFunction parts[] = {set_tools, set_globals};
  if (isatty(STDIN_FILENO))
    fputs("SoftWorld " SW_VERSION " (" LUA_RELEASE
          ")  Tab completes, Ctrl-C stops, Ctrl-D leaves\n"
          "Try:  help()   ?wire   help \"start\"\n",
          isatty(STDOUT_FILENO) ? stdout : stderr);
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
    host_ctrl_c_reset();
    lua_pushcfunction(L, parts[i]);
    if (host_call(L, 0, 0) != LUA_OK) host_report(L);
  }
}

/* --- reading a chunk ------------------------------------------------------ */

/* 1 if the syntax error on top means that more lines may complete the text. */
static int is_unfinished(lua_State *L) {
  static const char mark[] = "<eof>";
  size_t length;
  const char *text = lua_tolstring(L, -1, &length);
  return length >= sizeof mark - 1 && strcmp(text + length - (sizeof mark - 1), mark) == 0;
}

static int load_with(lua_State *L, int text, const char *before) {
  size_t length;
  lua_pushstring(L, before);
  lua_pushvalue(L, text);
  lua_pushliteral(L, "\n"); /* without it an open quote would look unfinished */
  lua_concat(L, 3);
  const char *whole = lua_tolstring(L, -1, &length);
  const int status = luaL_loadbufferx(L, whole, length, "=input", "t");
  lua_remove(L, -2);
  return status;
}

/* Loads the text on top as an expression, or else as statements. Replaces it by
 * the function (LUA_OK) or by a message (LUA_ERRSYNTAX); leaves it if more lines
 * are needed (LUA_YIELD). */
static int load_text(lua_State *L) {
  const int text = lua_gettop(L);
  int status = load_with(L, text, "return ");
  int unfinished = 0;
  if (status != LUA_OK) {
    unfinished = is_unfinished(L);
    lua_pop(L, 1);
    status = load_with(L, text, "");
    unfinished |= status != LUA_OK && is_unfinished(L);
  }
  if (status != LUA_OK && unfinished) {
    lua_pop(L, 1);
    return LUA_YIELD;
  }
  lua_remove(L, text);
  return status;
}

/* Replaces the marks of a line: "=x" means "return x"; "?x" asks for help on x. */
static void expand_mark(lua_State *L) {
  size_t length;
  const char *line = lua_tolstring(L, -1, &length);
  if (*line == '?') {
    lua_pushliteral(L, "require 'softworld.prompt.repl'.ask [=========[");
    lua_pushlstring(L, line + 1, length - 1);
    lua_pushliteral(L, "]=========]");
    lua_concat(L, 3);
    lua_remove(L, -2);
    return;
  }
  if (*line != '=') return;
  lua_pushliteral(L, "return ");
  lua_pushlstring(L, line + 1, length - 1);
  lua_concat(L, 2);
  lua_remove(L, -2);
}

/* Adds the line on top to the text at index. */
static void append_line(lua_State *L, int index) {
  lua_pushvalue(L, index);
  lua_pushliteral(L, "\n");
  lua_pushvalue(L, -3);
  lua_concat(L, 3);
  lua_replace(L, index);
}

/* Reads the rest of the chunk whose first line is on top, twice. Replaces the upper one by the
 * chunk's function (LUA_OK), a message (LUA_ERRSYNTAX) or nothing (LUA_YIELD: cancelled), and
 * makes the other one the text as it was typed. */
static int read_rest(lua_State *L) {
  const int text = lua_gettop(L);
  expand_mark(L);
  for (;;) {
    int status = load_text(L);
    if (status != LUA_YIELD) return status;
    const int got = host_line(L, ">> ");
    if (got == LINE_READ) {
      append_line(L, text - 1);
      append_line(L, text);
      lua_pop(L, 1);
      continue;
    }
    if (got == LINE_CANCELLED) {
      lua_settop(L, text - 1);
      return LUA_YIELD;
    }
    status = load_with(L, text, ""); /* no more lines: the message names the missing part */
    lua_remove(L, text);
    return status;
  }
}

/* Same for a first line that is there once. The chunk is one entry of the history. */
static int read_chunk(lua_State *L) {
  const int typed = lua_gettop(L);
  lua_pushvalue(L, typed);
  const int status = read_rest(L);
  host_history_add(lua_tostring(L, typed));
  lua_remove(L, typed);
  return status;
}

/* --- running it ----------------------------------------------------------- */

static int print_plainly(lua_State *L) {
  const int count = lua_gettop(L);
  for (int i = 1; i <= count; i++) {
    size_t length;
    const char *text = luaL_tolstring(L, i, &length);
    fwrite(text, 1, length, stdout);
    fputc(i < count ? '\t' : '\n', stdout);
    lua_pop(L, 1);
  }
  return 0;
}

/* Runs the function at base + 1, the top of the stack, and prints its results. */
static int run_chunk(lua_State *L, int base) {
  host_ctrl_c_reset();
  int status = host_call(L, 0, LUA_MULTRET);
  const int count = lua_gettop(L) - base;
  if (status == LUA_OK && count > 0) {
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &show_key) != LUA_TFUNCTION) {
      lua_pop(L, 1);
      lua_pushcfunction(L, print_plainly);
    }
    lua_insert(L, base + 1);
    luaL_checkstack(L, 4, NULL);
    status = host_call(L, count, 0);
  }
  return status;
}

/* Prints, once, a note about locals. Each line is a chunk, so a local is lost at the
 * line's end; users who paste `local sw = require "softworld"` run into this. */
static void hint_about_locals(lua_State *L) {
  static int told;
  const char *line = lua_tostring(L, -1);
  if (told || !isatty(STDIN_FILENO)) return;
  if (strncmp(line, "local ", 6) != 0 || strncmp(line, "local function", 14) == 0) return;
  told = 1;
  fputs("note: at the prompt a local ends with its line; leave out 'local' to keep the variable\n",
        stderr);
}

/* True if the line is exit or quit, with or without brackets, and this is no variable. */
static int wants_to_leave(lua_State *L) {
  static const char *const words[] = {"exit", "quit"};
  const char *line = lua_tostring(L, -1);
  line += strspn(line, " \t");
  for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
    const size_t length = strlen(words[k]);
    if (strncmp(line, words[k], length) != 0) continue;
    const char *rest = line + length;
    if (strncmp(rest, "()", 2) == 0) rest += 2;
    if (rest[strspn(rest, " \t\n")] != '\0') continue;
    const int unknown = lua_getglobal(L, words[k]) == LUA_TNIL;
    lua_pop(L, 1);
    return unknown;
  }
  return 0;
}

/* Reads and runs one chunk; 0 at the end of input. */
static int round_trip(lua_State *L) {
  const int base = lua_gettop(L);
  const int got = host_line(L, "> ");
  if (got == LINE_CANCELLED) return 1;
  if (got == LINE_END || wants_to_leave(L)) return 0;
  hint_about_locals(L);
  int status = read_chunk(L);
  if (status == LUA_OK) status = run_chunk(L, base);
  if (status != LUA_OK && status != LUA_YIELD) host_report(L);
  fflush(stdout);
  lua_settop(L, base);
  host_ctrl_c_reset();
  return 1;
}

int host_repl(lua_State *L) {
  host_ctrl_c_reset();
  set_up(L);
  host_ctrl_c_reset();
  while (round_trip(L)) continue;
  return host_ctrl_c_seen() && !isatty(STDIN_FILENO) ? HOST_INTERRUPTED : HOST_OK;
}
