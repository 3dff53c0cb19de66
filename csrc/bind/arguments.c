/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads argument tables by parameter rows. */
#include <string.h>

#include "bind/class.h"
#include "bind/inherited.h"

static int unknown_key(lua_State *L, const char *object, const lsw_section *sections, int count,
                       const char *key) {
  for (int k = 0; k < count; k++) {
    const sw_params *params = sections[k].params;
    if (!params->count) continue; /* there may be no rows to point at */
    const char *how = lsw_turned_by(object, params, key);
    if (how) return luaL_error(L, "%s: there is no parameter '%s'; %s", object, key, how);
    const char *near =
        sw_nearest_name(key, &params->rows[0].name, sizeof params->rows[0], params->count);
    if (near)
      return luaL_error(L, "%s: there is no parameter '%s'; did you mean '%s'?", object, key, near);
  }
  luaL_Buffer b;
  luaL_buffinit(L, &b);
  for (int k = 0; k < count; k++)
    for (size_t i = 0; i < sections[k].params->count; i++) {
      if (k || i) luaL_addchar(&b, ' ');
      luaL_addstring(&b, sections[k].params->rows[i].name);
    }
  luaL_pushresult(&b);
  return luaL_error(L, "%s: there is no parameter '%s'; known are: %s", object, key,
                    lua_tostring(L, -1));
}

size_t lsw_word(lua_State *L, const char *what, const char *also, const char *const *names,
                size_t count) {
  const char *word = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
  for (size_t i = 0; word && i < count; i++)
    if (strcmp(names[i], word) == 0) return i;
  const char *near = word ? sw_nearest_name(word, names, sizeof names[0], count) : NULL;
  if (near) luaL_error(L, "%s '%s'; did you mean '%s'?", what, word, near);
  const char *shown = word ? lua_pushfstring(L, "'%s'", word) : lsw_describe(L, -1);
  lua_pushstring(L, also);
  for (size_t i = 0; i < count; i++) {
    lua_pushfstring(L, "%s%s", i || *also ? ", " : "", names[i]);
    lua_concat(L, 2);
  }
  luaL_error(L, "%s %s; known are: %s", what, shown, lua_tostring(L, -1));
  return 0;
}

static int read_choice(lua_State *L, const char *object, const sw_param *row) {
  size_t count = 0;
  while (row->choices[count]) count++;
  const char *word = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
  for (size_t i = 0; word && i < count; i++)
    if (strcmp(word, row->choices[i]) == 0) return (int)i;
  luaL_Buffer b;
  const char *shown = word ? lua_pushfstring(L, "'%s'", word) : luaL_typename(L, -1);
  const char *near =
      word ? sw_nearest_name(word, row->choices, sizeof row->choices[0], count) : NULL;
  const char *hint = near ? lua_pushfstring(L, "; did you mean '%s'?", near) : "";
  luaL_buffinit(L, &b);
  for (size_t i = 0; i < count; i++) {
    if (i) luaL_addstring(&b, ", ");
    luaL_addstring(&b, row->choices[i]);
  }
  luaL_pushresult(&b);
  return luaL_error(L, "%s: %s = %s is not one of: %s%s", object, row->name, shown,
                    lua_tostring(L, -1), hint);
}

/* Words for a character that breaks lines of tables, CSV files and messages, or NULL. */
static const char *unfit(lua_State *L, unsigned char c) {
  if (c == 0) return "a zero byte";
  if (c == '\n' || c == '\r') return "a line end";
  if (c == '\t') return "a tab";
  return c < ' ' || c == 127 ? lua_pushfstring(L, "the control character %d", (int)c) : NULL;
}

const char *lsw_name(lua_State *L, int index, const char *what) {
  size_t length = 0;
  if (lua_type(L, index) != LUA_TSTRING)
    luaL_error(L, "%s must be a string, got %s", what, lsw_describe(L, index));
  const char *text = lua_tolstring(L, index, &length);
  for (size_t i = 0; i < length; i++) {
    const char *why = unfit(L, (unsigned char)text[i]);
    if (why)
      luaL_error(L, "%s has %s, at place %d; it must be one line without such characters", what,
                 why, (int)i + 1);
  }
  if (length >= SW_NAME_SIZE)
    luaL_error(L, "%s is too long; at most %d bytes, got %d", what, SW_NAME_SIZE - 1, (int)length);
  return text;
}

static void read_text(lua_State *L, const char *object, const sw_param *row, char *place) {
  const char *what = lua_pushfstring(L, "%s: %s", object, row->name);
  const char *text = lsw_name(L, -2, what);
  memcpy(place, text, strlen(text) + 1);
  lua_pop(L, 1);
}

static void read_vector(lua_State *L, const char *object, const sw_param *row, char *place) {
  sw_error err;
  const char *what = lua_pushfstring(L, "%s: %s", object, row->name);
  const sw_vec a =
      strcmp(row->unit, "m") == 0 ? lsw_place(L, -2, what) : lsw_vector(L, -2, what, row->unit);
  lua_pop(L, 1);
  const double parts[3] = {a.x, a.y, a.z};
  for (int i = 0; i < 3; i++)
    if (sw_param_check(object, row, parts[i], &err) != SW_OK) luaL_error(L, "%s", err.text);
  memcpy(place, &a, sizeof a);
}

/* The value is on top of the stack; leaves the stack as it was. */
static void read_value(lua_State *L, const char *object, const sw_param *row, void *args) {
  sw_error err;
  char *place = (char *)args + row->offset;
  switch (row->type) {
    case SW_PARAM_NUMBER:
    case SW_PARAM_INTEGER: {
      if (lua_type(L, -1) != LUA_TNUMBER)
        luaL_error(L, "%s: %s must be a number [%s], got %s", object, row->name, row->unit,
                   lsw_describe(L, -1));
      const double value = lua_tonumber(L, -1);
      if (sw_param_check(object, row, value, &err) != SW_OK) luaL_error(L, "%s", err.text);
      sw_param_store(row, args, value);
      break;
    }
    case SW_PARAM_BOOLEAN:
      if (!lua_isboolean(L, -1))
        luaL_error(L, "%s: %s must be true or false, got %s", object, row->name,
                   lsw_describe(L, -1));
      sw_param_store(row, args, lua_toboolean(L, -1));
      break;
    case SW_PARAM_CHOICE: sw_param_store(row, args, read_choice(L, object, row)); break;
    case SW_PARAM_TEXT: read_text(L, object, row, place); break;
    case SW_PARAM_VECTOR: read_vector(L, object, row, place); break;
    case SW_PARAM_ROTATION: {
      const sw_quat q = lsw_rotation(L, -2, lua_pushfstring(L, "%s: %s", object, row->name));
      lua_pop(L, 1);
      memcpy(place, &q, sizeof q);
      break;
    }
    case SW_PARAM_OTHER: break;
  }
}

/* Returns the section that has a row of the key at -2, and the row; raises if there is none. */
static const lsw_section *find_key(lua_State *L, const char *object, const lsw_section *sections,
                                   int count, const sw_param **row) {
  if (lua_type(L, -2) != LUA_TSTRING) {
    const int plain = lua_type(L, -2) == LUA_TNUMBER || lua_type(L, -2) == LUA_TBOOLEAN;
    const char *shown = plain ? luaL_tolstring(L, -2, NULL) : lsw_describe(L, -2);
    luaL_error(L, "%s: parameters have names; [%s] is not a name", object, shown);
  }
  const char *key = lua_tostring(L, -2);
  for (int k = 0; k < count; k++)
    if ((*row = sw_params_find(sections[k].params, key)) != NULL) return &sections[k];
  unknown_key(L, object, sections, count, key);
  return NULL;
}

static void read_key(lua_State *L, const char *object, const lsw_section *sections, int count) {
  const int top = lua_gettop(L);
  const sw_param *row = NULL;
  const lsw_section *section = find_key(L, object, sections, count, &row);
  read_value(L, object, row, section->args);
  lua_settop(L, top);
}

/* Reads one parameter that the table at the absolute index inherits. A function that gives it is
 * refused, because other names that it gives cannot be checked. */
static void read_base(lua_State *L, int index, const char *object, const sw_param *row,
                      void *args) {
  const int top = lua_gettop(L);
  if (row->type == SW_PARAM_OTHER) return; /* the binding reads it */
  lua_pushstring(L, row->name);
  const int own = lua_rawget(L, index) != LUA_TNIL;
  if (!own && lsw_inherited(L, index, row->name))
    read_value(L, object, row, args);
  else if (!own && lsw_gives(L, index, row->name))
    luaL_error(L,
               "%s: %s comes from a function, the __index of a metatable; write it into the table, "
               "or into one that it inherits from",
               object, row->name);
  lua_settop(L, top);
}

/* Reads the parameters that the table at the absolute index inherits. Unknown ones raise, too. */
static void read_inherited(lua_State *L, int index, const char *object, const lsw_section *sections,
                           int count) {
  const int top = lua_gettop(L);
  const sw_param *row = NULL;
  if (!lsw_inherits(L, index)) return;
  for (int k = 0; k < count; k++)
    for (size_t i = 0; i < sections[k].params->count; i++)
      read_base(L, index, object, &sections[k].params->rows[i], sections[k].args);
  lua_pushvalue(L, index);
  for (int n = 0; n < LSW_LONGEST_CHAIN && lsw_base(L); n++)
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1))
      if (lsw_is_field(L)) find_key(L, object, sections, count, &row);
  lua_settop(L, top);
}

static void require_keys(lua_State *L, int index, const char *object, const sw_params *params) {
  for (size_t i = 0; i < params->count; i++) {
    const sw_param *row = &params->rows[i];
    if (!(row->flags & SW_PARAM_REQUIRED)) continue;
    if (index == 0 || lua_getfield(L, index, row->name) == LUA_TNIL)
      luaL_error(L, "%s: %s is required [%s]: %s", object, row->name, row->unit, row->doc);
    lua_pop(L, 1);
  }
}

void lsw_sections(lua_State *L, int index, const char *object, const lsw_section *sections,
                  int count) {
  for (int k = 0; k < count; k++) sw_params_default(sections[k].params, sections[k].args);
  const int given = !lua_isnoneornil(L, index);
  index = given ? lua_absindex(L, index) : 0;
  if (given && !lua_istable(L, index))
    luaL_error(L, "%s takes one table of parameters, got %s", object, lsw_describe(L, index));
  if (given) {
    lua_pushnil(L);
    while (lua_next(L, index)) {
      read_key(L, object, sections, count);
      lua_pop(L, 1);
    }
    read_inherited(L, index, object, sections, count);
  }
  for (int k = 0; k < count; k++) require_keys(L, index, object, sections[k].params);
}

void lsw_arguments(lua_State *L, int index, const char *object, const sw_params *params,
                   void *args) {
  const lsw_section one = {params, args};
  lsw_sections(L, index, object, &one, 1);
}

static int refuse_change(lua_State *L, const char *object, const sw_params *params,
                         const char *name) {
  luaL_Buffer b;
  luaL_buffinit(L, &b);
  for (size_t i = 0; i < params->count; i++)
    if (params->rows[i].flags & SW_PARAM_CHANGES) {
      luaL_addchar(&b, ' ');
      luaL_addstring(&b, params->rows[i].name);
    }
  luaL_pushresult(&b);
  if (!*lua_tostring(L, -1))
    return luaL_error(L, "%s: %s is given when the object is made; this object has nothing to set",
                      object, name);
  return luaL_error(L, "%s: %s is given when the object is made; the parameters to set are:%s",
                    object, name, lua_tostring(L, -1));
}

/* Refuses inherited parameters that cannot be changed. */
static void refuse_inherited(lua_State *L, int index, const char *object, const sw_params *params) {
  if (!lsw_inherits(L, index)) return;
  for (size_t i = 0; i < params->count; i++) {
    const sw_param *row = &params->rows[i];
    if (row->flags & SW_PARAM_CHANGES || !lsw_inherited(L, index, row->name)) continue;
    refuse_change(L, object, params, row->name);
  }
}

void lsw_changes(lua_State *L, int index, const char *object, const sw_params *params, void *args) {
  const lsw_section one = {params, args};
  index = lua_absindex(L, index);
  if (!lua_istable(L, index))
    luaL_error(L, "%s takes one table of parameters, got %s", object, lsw_describe(L, index));
  lua_pushnil(L);
  while (lua_next(L, index)) {
    const sw_param *row =
        lua_type(L, -2) == LUA_TSTRING ? sw_params_find(params, lua_tostring(L, -2)) : NULL;
    if (row && !(row->flags & SW_PARAM_CHANGES)) refuse_change(L, object, params, row->name);
    read_key(L, object, &one, 1);
    lua_pop(L, 1);
  }
  refuse_inherited(L, index, object, params);
  read_inherited(L, index, object, &one, 1);
}

static void push_number(lua_State *L, const char *place) {
  double x;
  memcpy(&x, place, sizeof x);
  if (isfinite(x)) lua_pushnumber(L, x);
}

static void push_integer(lua_State *L, const char *place) {
  long x;
  memcpy(&x, place, sizeof x);
  lua_pushinteger(L, x);
}

static int flag_at(const char *place) {
  int flag;
  memcpy(&flag, place, sizeof flag);
  return flag;
}

static void push_vector(lua_State *L, const char *place) {
  sw_vec v;
  memcpy(&v, place, sizeof v);
  if (!isnan(v.x)) lsw_push_vector(L, v);
}

static void push_rotation(lua_State *L, const char *place) {
  sw_quat q;
  memcpy(&q, place, sizeof q);
  if (!isnan(q.w)) lsw_push_quaternion(L, q);
}

/* Pushes the value; nothing for a value that was not given, is infinite (no limit), or is read by
 * the binding itself. */
static void push_value(lua_State *L, const sw_param *row, const char *place) {
  switch (row->type) {
    case SW_PARAM_NUMBER: push_number(L, place); break;
    case SW_PARAM_INTEGER: push_integer(L, place); break;
    case SW_PARAM_BOOLEAN: lua_pushboolean(L, flag_at(place)); break;
    case SW_PARAM_CHOICE: lua_pushstring(L, row->choices[flag_at(place)]); break;
    case SW_PARAM_TEXT: lua_pushstring(L, place); break;
    case SW_PARAM_VECTOR: push_vector(L, place); break;
    case SW_PARAM_ROTATION: push_rotation(L, place); break;
    case SW_PARAM_OTHER: break;
  }
}

void lsw_push_values(lua_State *L, const sw_params *params, const void *args) {
  lua_createtable(L, 0, (int)params->count);
  for (size_t i = 0; i < params->count; i++) {
    const sw_param *row = &params->rows[i];
    const int top = lua_gettop(L);
    push_value(L, row, (const char *)args + row->offset);
    if (lua_gettop(L) > top) lua_setfield(L, -2, row->name);
  }
}

static const char *const type_names[] = {"number", "integer", "boolean",  "choice",
                                         "text",   "vector",  "rotation", "other"};

static int has_range(const sw_param *row) {
  return row->type == SW_PARAM_NUMBER || row->type == SW_PARAM_INTEGER ||
         row->type == SW_PARAM_VECTOR;
}

/* Sets min and max if they are finite; above, below: the limit itself is not allowed. */
static void push_range(lua_State *L, const sw_param *row) {
  if (isfinite(row->min)) lua_pushnumber(L, row->min), lua_setfield(L, -2, "min");
  if (isfinite(row->max)) lua_pushnumber(L, row->max), lua_setfield(L, -2, "max");
  lua_pushboolean(L, (row->flags & SW_PARAM_ABOVE_MIN) != 0), lua_setfield(L, -2, "above");
  lua_pushboolean(L, (row->flags & SW_PARAM_BELOW_MAX) != 0), lua_setfield(L, -2, "below");
}

void lsw_push_params(lua_State *L, const sw_params *params) {
  lua_createtable(L, (int)params->count, 0);
  for (size_t i = 0; i < params->count; i++) {
    const sw_param *row = &params->rows[i];
    lua_createtable(L, 0, 11);
    lua_pushstring(L, row->name), lua_setfield(L, -2, "name");
    lua_pushstring(L, type_names[row->type]), lua_setfield(L, -2, "type");
    lua_pushstring(L, row->unit), lua_setfield(L, -2, "unit");
    lua_pushstring(L, row->doc), lua_setfield(L, -2, "doc");
    lua_pushboolean(L, (row->flags & SW_PARAM_REQUIRED) != 0), lua_setfield(L, -2, "required");
    lua_pushboolean(L, (row->flags & SW_PARAM_CHANGES) != 0), lua_setfield(L, -2, "changes");
    if (!isnan(row->def)) lua_pushnumber(L, row->def), lua_setfield(L, -2, "default");
    if (has_range(row)) push_range(L, row);
    if (row->choices) {
      lua_newtable(L);
      for (int k = 0; row->choices[k]; k++)
        lua_pushstring(L, row->choices[k]), lua_rawseti(L, -2, k + 1);
      lua_setfield(L, -2, "choices");
    }
    lua_rawseti(L, -2, (int)i + 1);
  }
}

double *lsw_read_points(lua_State *L, int table, const char *key, const char *object,
                        size_t *count) {
  *count = 0;
  if (lua_getfield(L, table, key) == LUA_TNIL) return NULL;
  if (!lua_istable(L, -1))
    luaL_error(L, "%s: %s must be a list of points {x, y, z} [m], got %s", object, key,
               lsw_describe(L, -1));
  lsw_only_items(L, -2, lua_pushfstring(L, "%s: %s", object, key));
  lua_pop(L, 1);
  const size_t n = lua_rawlen(L, -1);
  if (n > 10000000) luaL_error(L, "%s: %s has %d points; at most 10000000", object, key, (int)n);
  double *points = lua_newuserdatauv(L, (3 * n + 1) * sizeof *points, 0);
  for (size_t i = 0; i < n; i++) {
    lua_geti(L, -2, (lua_Integer)i + 1);
    const char *what = lua_pushfstring(L, "%s: %s, point %d", object, key, (int)i + 1);
    sw_store(points + 3 * i, lsw_place(L, -2, what));
    lua_pop(L, 2);
  }
  *count = n;
  return points;
}
