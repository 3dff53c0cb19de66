/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the program and its Lua files. In the source tree the program is
 * build/softworld beside lua/. Installed it is bin/softworld beside
 * share/lua/5.4. */
#include <lauxlib.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/host.h"

static const char library_key; /* its address is the registry key of the prefix */

/* Pushes the absolute path and returns 1 if path is an executable file; else returns 0. */
static int push_runnable(lua_State *L, const char *path) {
  struct stat info;
  char *real = realpath(path, NULL);
  if (!real) return 0;
  const int good = stat(real, &info) == 0 && S_ISREG(info.st_mode) && access(real, X_OK) == 0;
  if (good) lua_pushstring(L, real);
  free(real);
  return good;
}

/* Pushes the program's absolute path; if it cannot be found, its name as called. */
static void push_executable(lua_State *L, const char *name) {
  char path[PATH_MAX];
  const ssize_t n = readlink("/proc/self/exe", path, sizeof path - 1);
  if (n > 0) {
    lua_pushlstring(L, path, (size_t)n);
    return;
  }
  if (strchr(name, '/')) {
    if (!push_runnable(L, name)) lua_pushstring(L, name);
    return;
  }
  const char *list = getenv("PATH");
  for (const char *p = list; p && *p; p += strspn(p, ":")) {
    const size_t length = strcspn(p, ":");
    lua_pushlstring(L, p, length);
    const char *candidate = lua_pushfstring(L, "%s/%s", lua_tostring(L, -1), name);
    lua_remove(L, -2);
    const int found = push_runnable(L, candidate);
    lua_remove(L, found ? -2 : -1);
    if (found) return;
    p += length;
  }
  lua_pushstring(L, name);
}

/* Pushes path without its last component ("." if it has only one). */
static void push_parent(lua_State *L, const char *path) {
  const char *slash = strrchr(path, '/');
  if (!slash) {
    lua_pushliteral(L, ".");
  } else {
    lua_pushlstring(L, path, slash == path ? 1 : (size_t)(slash - path));
  }
}

/* Pushes the directory that contains the folder softworld and returns 1; if there is none, pushes
 * nothing and returns 0. */
static int push_library(lua_State *L, const char *executable) {
  static const char *const places[] = {"lua", "share/lua/5.4"};
  struct stat info;
  push_parent(L, executable);
  push_parent(L, lua_tostring(L, -1));
  lua_remove(L, -2);
  const char *root = lua_tostring(L, -1);
  for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
    const char *folder = lua_pushfstring(L, "%s/%s", root, places[i]);
    const char *inside = lua_pushfstring(L, "%s/softworld", folder);
    const int found = stat(inside, &info) == 0 && S_ISDIR(info.st_mode);
    lua_pop(L, found ? 1 : 2);
    if (found) {
      lua_remove(L, -2);
      return 1;
    }
  }
  lua_pop(L, 1);
  return 0;
}

/* Adds the folder's templates to the buffer, unless its name contains characters that
 * have a meaning in templates. */
static void add_templates(luaL_Buffer *b, const char *folder) {
  if (strpbrk(folder, ";?")) return;
  luaL_addstring(b, folder), luaL_addstring(b, "/?.lua;");
  luaL_addstring(b, folder), luaL_addstring(b, "/?/init.lua;");
}

/* Sets package.path: first library (or NULL), so that no other installed copy is used
 * with this program's core; then the script's folder; then the old value. */
static void set_package_path(lua_State *L, const char *library, const char *script) {
  luaL_Buffer b;
  const int top = lua_gettop(L);
  const char *folder = NULL;
  if (script && strcmp(script, "-") != 0) {
    push_parent(L, script);
    folder = lua_tostring(L, -1);
  }
  lua_getglobal(L, "package");
  const int package = lua_gettop(L);
  lua_getfield(L, package, "path");
  const char *before = luaL_optstring(L, -1, "");
  luaL_buffinit(L, &b);
  if (library) add_templates(&b, library);
  if (folder) add_templates(&b, folder);
  luaL_addstring(&b, before);
  luaL_pushresult(&b);
  lua_setfield(L, package, "path");
  lua_settop(L, top);
}

/* Width of the terminal for messages (stderr) [characters]. */
static int host_columns(lua_State *L) {
  struct winsize size = {0};
  const char *told = getenv("COLUMNS");
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    size.ws_col = told && atoi(told) > 0 && atoi(told) < 10000 ? (unsigned short)atoi(told) : 80;
  lua_pushinteger(L, size.ws_col);
  return 1;
}

void host_paths_open(lua_State *L, const host_options *o) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_createtable(L, 0, 4);
  push_executable(L, o->argv[0] ? o->argv[0] : "softworld");
  const char *executable = lua_tostring(L, -1);
  const int found = push_library(L, executable);
  if (found) {
    lua_pushfstring(L, "@%s/softworld/", lua_tostring(L, -1));
    lua_rawsetp(L, LUA_REGISTRYINDEX, &library_key);
  }
  set_package_path(L, found ? lua_tostring(L, -1) : NULL, o->script ? o->argv[o->script] : NULL);
  lua_pop(L, found);
  lua_setfield(L, -2, "executable");
  lua_pushboolean(L, o->interactive), lua_setfield(L, -2, "interactive");
  lua_pushboolean(L, isatty(STDERR_FILENO)), lua_setfield(L, -2, "terminal");
  lua_pushcfunction(L, host_columns), lua_setfield(L, -2, "columns");
  lua_setfield(L, -2, "softworld.host");
  lua_pop(L, 1);
}

int host_is_library(lua_State *L, const char *source) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &library_key);
  const char *prefix = lua_tostring(L, -1);
  const int inside = prefix && strncmp(source, prefix, strlen(prefix)) == 0;
  lua_pop(L, 1);
  return inside;
}
