/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes error texts that point to the user's line. Calls inside the library's Lua
 * files and the host are left out, because the user cannot change those. */
#include <ctype.h>
#include <lauxlib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/host.h"

enum {
  SCANNED = 60, /* levels read from each end; an endless recursion has 2e5 [-] */
  SHOWN = 10    /* calls printed from each end [-] */
};

typedef enum kind { USER, LIBRARY, NATIVE } kind;

static int get_level(lua_State *L, int level, lua_Debug *ar) {
  return lua_getstack(L, level, ar) && lua_getinfo(L, "Sln", ar);
}

static kind kind_of(lua_State *L, const lua_Debug *ar) {
  if (*ar->what == 'C') return NATIVE;
  return host_is_library(L, ar->source) ? LIBRARY : USER;
}

/* 1 if the call is shown: the user's calls, and C functions that the user's code called,
 * except error and assert, which only pass the error on. */
static int is_shown(lua_State *L, int level, const lua_Debug *ar) {
  lua_Debug caller;
  const kind k = kind_of(L, ar);
  if (k != NATIVE) return k == USER;
  if (!ar->name || strcmp(ar->name, "error") == 0 || strcmp(ar->name, "assert") == 0) return 0;
  return get_level(L, level + 1, &caller) && kind_of(L, &caller) == USER;
}

/* --- the message's position ----------------------------------------------- */

/* Length of "file.lua:12: " at the start of text if it names this frame's
 * file, else 0. */
static size_t position_length(const char *text, const lua_Debug *ar) {
  const size_t file = strlen(ar->short_src);
  if (strncmp(text, ar->short_src, file) != 0 || text[file] != ':') return 0;
  const char *p = text + file + 1;
  if (!isdigit((unsigned char)*p)) return 0;
  while (isdigit((unsigned char)*p)) p++;
  return p[0] == ':' && p[1] == ' ' ? (size_t)(p + 2 - text) : 0;
}

void host_move_position(lua_State *L, lua_State *co, int level) {
  lua_Debug ar;
  size_t length, skip = 0;
  const char *text = lua_tolstring(L, -1, &length);
  for (const int end = level + SCANNED; level < end && get_level(co, level, &ar); level++) {
    const kind k = kind_of(L, &ar);
    if (k == LIBRARY && !skip) skip = position_length(text, &ar);
    if (k != USER) continue;
    if (!skip || ar.currentline < 0) return;
    lua_pushfstring(L, "%s:%d: ", ar.short_src, ar.currentline);
    lua_pushlstring(L, text + skip, length - skip);
    lua_concat(L, 2);
    lua_remove(L, -2);
    return;
  }
}

/* --- the calls ------------------------------------------------------------ */

/* Pushes "\n\tscript.lua:3: in function 'lay'". */
static void push_call(lua_State *L, const lua_Debug *ar) {
  lua_pushfstring(L, "\n\t%s:", ar->short_src);
  if (ar->currentline > 0) {
    lua_pushfstring(L, "%d:", ar->currentline);
    lua_concat(L, 2);
  }
  if (ar->name && *ar->namewhat) {
    lua_pushfstring(L, " in %s '%s'", ar->namewhat, ar->name);
  } else if (*ar->what == 'm') {
    lua_pushliteral(L, " in main chunk");
  } else if (*ar->what == 'C') {
    lua_pushliteral(L, " in a function");
  } else {
    lua_pushfstring(L, " in the function at line %d", ar->linedefined);
  }
  lua_concat(L, 2);
}

static int count_levels(lua_State *L) {
  lua_Debug ar;
  int low = 0, high = 1;
  while (lua_getstack(L, high, &ar)) low = high, high *= 2;
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    if (lua_getstack(L, middle, &ar))
      low = middle;
    else
      high = middle;
  }
  return low + 1;
}

/* True if these calls are a line typed at the prompt and the C function it calls: the message tells
 * as much. */
static int is_typed(lua_State *L, const int *seen, int count) {
  lua_Debug ar;
  for (int i = 0; i + 1 < count; i++)
    if (!get_level(L, seen[i], &ar) || *ar.what != 'C') return 0;
  return get_level(L, seen[count - 1], &ar) && *ar.what == 'm' &&
         strcmp(ar.short_src, "input") == 0;
}

/* Appends the calls to the text on top. */
static void add_calls(lua_State *L) {
  lua_Debug ar;
  int seen[2 * SCANNED], count = 0;
  const int top = lua_gettop(L), levels = count_levels(L);
  size_t length;
  for (int level = 1; level < levels; level++) {
    if (level == SCANNED && levels > 2 * SCANNED) level = levels - SCANNED;
    if (get_level(L, level, &ar) && is_shown(L, level, &ar)) seen[count++] = level;
  }
  const char *text = lua_tolstring(L, top, &length);
  if (count == 1 && get_level(L, seen[0], &ar) && *ar.what == 'm' && position_length(text, &ar))
    return; /* the message has this position already */
  if (count == 0 || is_typed(L, seen, count)) return;
  luaL_checkstack(L, 2 * SHOWN + 8, NULL);
  lua_pushliteral(L, "\ncalled from:");
  for (int i = 0; i < count; i++) {
    if (i == SHOWN && count > 2 * SHOWN) {
      i = count - SHOWN;
      lua_pushfstring(L, "\n\t... (%d calls in between)", seen[i] - seen[SHOWN - 1] - 1);
    }
    if (get_level(L, seen[i], &ar)) push_call(L, &ar);
  }
  lua_concat(L, lua_gettop(L) - top + 1);
}

/* --- values that were called ----------------------------------------------- */

/* Finds in a text such as "attempt to call a number value (method 'time')" the name of the value
 * that is no function. 0 if the text is another one. */
static int called_value(const char *text, const char **name, size_t *length) {
  static const char *const kinds[] = {"number", "string", "boolean"};
  static const char *const places[] = {"method", "field"};
  const char *at = strstr(text, "attempt to call a ");
  if (!at) return 0;
  at += strlen("attempt to call a ");
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
    for (size_t p = 0; p < sizeof places / sizeof places[0]; p++) {
      char start[40];
      const int n = snprintf(start, sizeof start, "%s value (%s '", kinds[k], places[p]);
      if (strncmp(at, start, (size_t)n) != 0) continue;
      *name = at + n;
      *length = strcspn(*name, "'");
      return (*name)[*length] == '\'';
    }
  return 0;
}

/* Adds to the text on top how this value is read. */
static void hint_at_value(lua_State *L) {
  const char *name;
  size_t length;
  if (!called_value(lua_tostring(L, -1), &name, &length)) return;
  lua_pushlstring(L, name, length);
  lua_pushfstring(L, "%s; '%s' is a value, not a method: read it as .%s", lua_tostring(L, -2),
                  lua_tostring(L, -1), lua_tostring(L, -1));
  lua_replace(L, -3);
  lua_pop(L, 1);
}

/* --- the handler ---------------------------------------------------------- */

static int value_text(lua_State *L) {
  luaL_tolstring(L, 1, NULL);
  return 1;
}

static int shown_value(lua_State *L) {
  lua_getglobal(L, "require");
  lua_pushliteral(L, "softworld.prompt.pretty");
  lua_call(L, 1, 1);
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  luaL_checktype(L, -1, LUA_TSTRING);
  return 1;
}

/* Pushes the text that the function makes of the value at index 1 and returns 1; if the
 * function fails, pushes nothing and returns 0. */
static int push_text(lua_State *L, lua_CFunction function) {
  lua_pushcfunction(L, function);
  lua_pushvalue(L, 1);
  if (lua_pcall(L, 1, 1, 0) == LUA_OK) return 1;
  lua_pop(L, 1);
  return 0;
}

/* Replaces the error value at index 1 by a text. */
static void make_text(lua_State *L) {
  const char *type = luaL_typename(L, 1);
  if (lua_isstring(L, 1)) {
    lua_tostring(L, 1); /* a number becomes a string in place */
    return;
  }
  if (luaL_getmetafield(L, 1, "__tostring") != LUA_TNIL) {
    lua_pop(L, 1);
    if (!push_text(L, value_text))
      lua_pushfstring(L, "(the error value is a %s whose __tostring fails)", type);
  } else if (lua_isnoneornil(L, 1)) {
    lua_pushliteral(L, "(the error value is nil)");
  } else if (push_text(L, shown_value)) {
    lua_pushfstring(L, "(the error value is a %s: %s)", type, lua_tostring(L, -1));
  } else {
    lua_pushfstring(L, "(the error value is a %s)", type);
  }
  lua_replace(L, 1);
}

int host_traceback(lua_State *L) {
  const char *wish = getenv("SOFTWORLD_TRACEBACK");
  lua_settop(L, 1);
  make_text(L);
  lua_settop(L, 1);
  if (wish && strcmp(wish, "full") == 0) {
    size_t length;
    const char *text = lua_tolstring(L, 1, &length);
    luaL_traceback(L, L, NULL, 1);
    lua_pushlstring(L, text, length), lua_pushliteral(L, "\n");
    lua_rotate(L, -3, 2);
    lua_concat(L, 3);
    return 1;
  }
  host_move_position(L, L, 1);
  hint_at_value(L);
  add_calls(L);
  return 1;
}
