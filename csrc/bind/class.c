/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Metatables of all classes, checks of their arguments, and conversion of errors to Lua errors. */
#include "bind/class.h"

#include <math.h>
#include <string.h>

#define X(name) extern const lsw_class lsw_class_##name;
#include "bind/classes.def"
#undef X

static const lsw_class *const classes[] = {
#define X(name) &lsw_class_##name,
#include "bind/classes.def"
#undef X
};

void *lsw_new(lua_State *L, const lsw_class *c, int user_values) {
  lsw_handle *h = lua_newuserdatauv(L, c->size, user_values);
  memset(h, 0, c->size);
  lua_rawgetp(L, LUA_REGISTRYINDEX, c);
  lua_setmetatable(L, -2);
  return h;
}

void *lsw_test(lua_State *L, int index, const lsw_class *c) {
  void *h = lua_touserdata(L, index);
  if (!h || !lua_getmetatable(L, index)) return NULL;
  lua_rawgetp(L, LUA_REGISTRYINDEX, c);
  const int same = lua_rawequal(L, -1, -2);
  lua_pop(L, 2);
  return same ? h : NULL;
}

void *lsw_keep(lua_State *L, size_t size, const char *name, const luaL_Reg *methods,
               lua_CFunction end) {
  void *kept = lua_newuserdatauv(L, size, 0);
  memset(kept, 0, size);
  if (luaL_newmetatable(L, name)) {
    lua_pushcfunction(L, end), lua_setfield(L, -2, "__gc");
    lua_pushcfunction(L, end), lua_setfield(L, -2, "__close");
    lua_newtable(L);
    if (methods) luaL_setfuncs(L, methods, 0);
    lua_setfield(L, -2, "__index");
    lua_pushliteral(L, "a part of the library"), lua_setfield(L, -2, "__metatable");
  }
  lua_setmetatable(L, -2);
  return kept;
}

const lsw_class *lsw_class_of(lua_State *L, int index) {
  if (!lua_touserdata(L, index) || !lua_getmetatable(L, index)) return NULL;
  lua_rawgetp(L, -1, classes);
  const lsw_class *c = lua_touserdata(L, -1);
  lua_pop(L, 2);
  return c;
}

enum { LONGEST_SHOWN = 32 }; /* longest text shown in a message [B] */

/* 1 for a short text of printable ASCII characters. */
static int may_be_shown(const char *text, size_t length) {
  for (size_t i = 0; i < length; i++)
    if (text[i] < ' ' || text[i] > '~') return 0;
  return length <= LONGEST_SHOWN;
}

const char *lsw_describe(lua_State *L, int index) {
  index = lua_absindex(L, index);
  const int type = lua_type(L, index);
  if (type == LUA_TNUMBER || type == LUA_TBOOLEAN) {
    const char *text = luaL_tolstring(L, index, NULL);
    return lua_pushfstring(L, "%s %s", luaL_typename(L, index), text);
  }
  if (type == LUA_TSTRING) {
    size_t length;
    const char *text = lua_tolstring(L, index, &length);
    if (may_be_shown(text, length)) return lua_pushfstring(L, "string '%s'", text);
  }
  if (type == LUA_TUSERDATA && luaL_getmetafield(L, index, "__name") == LUA_TSTRING)
    return lua_tostring(L, -1);
  if (type == LUA_TNONE) return "nothing";
  return luaL_typename(L, index);
}

void *lsw_check(lua_State *L, int index, const lsw_class *c) {
  lsw_handle *h = lsw_test(L, index, c);
  if (!h) {
    const char *method = index == 1 ? lsw_running_method(L) : NULL;
    if (method)
      luaL_error(L, "%s:%s is a method: call it with a colon (%s expected, got %s)", c->name,
                 method, c->name, lsw_describe(L, index));
    luaL_argerror(L, index,
                  lua_pushfstring(L, "%s expected, got %s", c->name, lsw_describe(L, index)));
    return NULL;
  }
  if (!h->object) luaL_error(L, "%s", c->gone);
  return h;
}

/* --- life cycle ----------------------------------------------------------- */

static const lsw_class *class_of(lua_State *L) { return lua_touserdata(L, lua_upvalueindex(1)); }

static int meta_gc(lua_State *L) {
  const lsw_class *c = class_of(L);
  lsw_handle *h = lsw_test(L, 1, c);
  if (!h)
    return luaL_error(L, "%s:close is a method: call it with a colon (%s expected, got %s)",
                      c->name, c->name, lsw_describe(L, 1));
  if (h->object) {
    if (c->busy && c->busy(h))
      return luaL_error(L, "this %s cannot be closed from inside a step or a function of time",
                        c->name);
    void *object = h->object;
    h->object = NULL; /* before closing, which may run a finaliser that reads the handle */
    lsw_handle old = {object};
    c->close(&old);
  }
  return 0;
}

static const luaL_Reg close_method[] = {{"close", meta_gc}, {NULL, NULL}};

static int meta_tostring(lua_State *L) {
  const lsw_class *c = class_of(L);
  lsw_handle *h = lsw_test(L, 1, c);
  if (h && h->object) {
    if (c->describe) return lua_settop(L, 1), c->describe(L);
    lua_pushfstring(L, "%s: %p", c->name, h->object);
  } else {
    lua_pushfstring(L, "%s (closed)", c->name);
  }
  return 1;
}

static int meta_eq(lua_State *L) {
  const lsw_class *c = class_of(L);
  lsw_handle *a = lsw_test(L, 1, c), *b = lsw_test(L, 2, c);
  /* new handles are zeroed, so padding compares equal */
  lua_pushboolean(L, a && b && (a == b || (a->object && memcmp(a, b, c->size) == 0)));
  return 1;
}

/* Word for the object at index 1 in messages. */
static const char *word_of(lua_State *L) {
  const lsw_class *c = class_of(L);
  const char *word = c->word && lsw_test(L, 1, c) ? c->word(L) : NULL;
  return word ? word : c->name;
}

/* Is the word a measure of an interval that the method over gives, as in gripper.peak_force? */
static int is_measure(lua_State *L, const char *word) {
  if (strncmp(word, "peak_", 5) != 0 && strncmp(word, "mean_", 5) != 0 &&
      strcmp(word, "impulse") != 0)
    return 0;
  lua_getfield(L, lua_upvalueindex(2), "over");
  const int has = !lua_isnil(L, -1);
  lua_pop(L, 1);
  return has;
}

/* Raises for the name at index 2, which the class does not have. Upvalues as of meta_index. */
static int unknown_field(lua_State *L) {
  if (lua_type(L, 2) != LUA_TSTRING) return luaL_error(L, "%s has no such field", word_of(L));
  const char **names = NULL;
  size_t count = 0;
  for (int pass = 0; pass < 2; pass++) { /* counts the names, then collects them */
    if (pass) names = lua_newuserdatauv(L, (count + 1) * sizeof *names, 0);
    count = 0;
    for (int up = 2; up <= 3; up++)
      for (lua_pushnil(L); lua_next(L, lua_upvalueindex(up)); lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) continue;
        if (pass) names[count] = lua_tostring(L, -2);
        count++;
      }
  }
  const char *word = lua_tostring(L, 2);
  const char *near = sw_nearest_name(word, names, sizeof names[0], count);
  if (near) return luaL_error(L, "%s has no '%s'; did you mean '%s'?", word_of(L), word, near);
  if (is_measure(L, word))
    return luaL_error(L, "%s has no '%s'; :over().%s may give it, see its method over", word_of(L),
                      word, word);
  return luaL_error(L,
                    "%s has no '%s'; help(it) at the prompt or `softworld doc` lists what it has",
                    word_of(L), word);
}

/* Returns the method or property of a name. Any other name is an error with a hint.
 * Upvalues: the class, its methods, its properties. */
static int meta_index(lua_State *L) {
  lua_settop(L, 2);
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(3)) != LUA_TNIL) {
    lua_pushvalue(L, 1);
    lua_call(L, 1, 1);
    return 1;
  }
  return unknown_field(L);
}

/* Raises: fields of an object cannot be set; its parameters are given when it is made. Upvalues as
 * of meta_index. */
static int meta_newindex(lua_State *L) {
  lua_settop(L, 2);
  for (int up = 2; up <= 3; up++) {
    lua_pushvalue(L, 2);
    const int there = lua_rawget(L, lua_upvalueindex(up)) != LUA_TNIL;
    if (there && up == 2)
      return luaL_error(L, "%s: '%s' is a method and cannot be set: call it, with a colon",
                        word_of(L), lua_tostring(L, 2));
    if (there)
      return luaL_error(L, "%s: '%s' can only be read; give it when the object is made", word_of(L),
                        lua_tostring(L, 2));
    lua_settop(L, 2);
  }
  return unknown_field(L);
}

/* Returns the names of all methods and properties, for completion at the prompt. */
static int meta_names(lua_State *L) {
  lua_newtable(L);
  for (int up = 2; up <= 3; up++) {
    lua_pushnil(L);
    while (lua_next(L, lua_upvalueindex(up))) {
      lua_pop(L, 1);
      lua_pushvalue(L, -1);
      lua_rawseti(L, -3, (lua_Integer)lua_rawlen(L, -3) + 1);
    }
  }
  return 1;
}

static void push_indexer(lua_State *L, const lsw_class *c, int methods, lua_CFunction f) {
  lua_pushlightuserdata(L, (void *)c);
  lua_pushvalue(L, methods);
  lua_newtable(L);
  if (c->properties) luaL_setfuncs(L, c->properties, 0);
  lua_pushcclosure(L, f, 3);
}

static void open_class(lua_State *L, const lsw_class *c) {
  const struct {
    const char *name;
    lua_CFunction function;
  } life[] = {{"__gc", meta_gc}, /* the first two only if there is something to close */
              {"__close", meta_gc},
              {"__tostring", meta_tostring},
              {"__eq", meta_eq}};
  lua_newtable(L);
  for (size_t i = c->close ? 0 : 2; i < sizeof life / sizeof life[0]; i++) {
    lua_pushlightuserdata(L, (void *)c);
    lua_pushcclosure(L, life[i].function, 1);
    lua_setfield(L, -2, life[i].name);
  }
  lua_pushlightuserdata(L, (void *)c);
  lua_rawsetp(L, -2, classes); /* so the class of a userdata is found at once */
  lua_pushstring(L, c->name);
  lua_setfield(L, -2, "__name");
  lua_newtable(L);
  lsw_set_methods(L, c, c->methods);
  if (c->more) c->more(L);
  if (c->close) lsw_set_methods(L, c, close_method);
  const int methods = lua_gettop(L);
  push_indexer(L, c, methods, meta_index);
  lua_setfield(L, methods - 1, "__index");
  push_indexer(L, c, methods, meta_newindex);
  lua_setfield(L, methods - 1, "__newindex");
  push_indexer(L, c, methods, meta_names);
  lua_setfield(L, methods - 1, "__names");
  lua_insert(L, -2);
  lua_rawsetp(L, LUA_REGISTRYINDEX, c);
}

void lsw_open_classes(lua_State *L) {
  lua_newtable(L);
  for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++) {
    open_class(L, classes[i]);
    lua_setfield(L, -2, classes[i]->name);
  }
}

int lsw_raise(lua_State *L, sw_status status, const sw_error *err) {
  const int why = status != SW_EINTR && err && err->text[0];
  if (status == SW_EINTR) sw_interrupt_clear(); /* this error handles the Ctrl-C */
  return luaL_error(L, "%s", why ? err->text : sw_status_text(status));
}

void lsw_poll(lua_State *L) {
  if (sw_interrupted()) lsw_raise(L, SW_EINTR, NULL);
}

void lsw_stop_since(lua_State *L, unsigned count) {
  if (sw_interrupt_count() != count) lsw_raise(L, SW_EINTR, NULL);
}

/* --- values --------------------------------------------------------------- */

double lsw_number(lua_State *L, int index, const char *what, const char *unit) {
  const char *space = strcmp(unit, "-") == 0 ? "" : " ";
  const char *shown = *space ? unit : "";
  lsw_poll(L); /* a list may have millions of numbers */
  if (lua_type(L, index) != LUA_TNUMBER)
    return luaL_error(L, "%s must be a number%s%s%s, got %s", what, *space ? " [" : "", shown,
                      *space ? "]" : "", lsw_describe(L, index));
  const double value = lua_tonumber(L, index);
  if (!isfinite(value))
    return luaL_error(L, "%s = %f%s%s is not allowed; it must be a finite number", what,
                      isnan(value) ? fabs(value) : value, /* -nan is no other number */
                      space, shown);
  return value;
}

lua_Integer lsw_integer(lua_State *L, int index, const char *what) {
  int whole = 0;
  const lua_Integer value =
      lua_type(L, index) == LUA_TNUMBER ? lua_tointegerx(L, index, &whole) : 0;
  if (!whole)
    luaL_error(L, "%s must be an integer, got %s", what,
               lua_type(L, index) == LUA_TNUMBER ? lua_pushfstring(L, "%f", lua_tonumber(L, index))
                                                 : lsw_describe(L, index));
  return value;
}
