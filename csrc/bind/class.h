/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Userdata classes and argument tables. One lsw_class per kind of object, all
 * listed in classes.def; this file gives each of them its life cycle. */
#ifndef LSW_CLASS_H
#define LSW_CLASS_H

#include <lauxlib.h>
#include <lua.h>

#include "softworld.h"

/* What every userdata starts with. A handle is born closed (object NULL); it
 * is opened as the last act of its constructor, so that a failure in between
 * is safe. */
typedef struct lsw_handle {
  void *object;
} lsw_handle;

typedef struct lsw_class {
  const char *name; /* "scene": the word used in messages, type() and tostring */
  sw_kind kind;     /* kind of the scene's object; SW_OF_NONE: it is no object of a scene */
  size_t size;      /* of the userdata; starts with an lsw_handle [B] */
  const luaL_Reg *methods;
  void (*more)(lua_State *L);        /* adds methods to the table on top, or NULL */
  lua_CFunction describe;            /* what tostring says of an open one, or NULL */
  const luaL_Reg *properties;        /* getters called as f(object), or NULL */
  void (*close)(lsw_handle *h);      /* frees h->object; never called with NULL there. NULL: the
                                      * object is another's, nothing to close */
  const char *gone;                  /* message for a closed handle: "the scene has been closed" */
  int (*busy)(const lsw_handle *h);  /* 1: must not be closed now; NULL = always may */
  const char *(*word)(lua_State *L); /* for messages on the one at index 1: what it is called; NULL
                                        = by name, as where it returns NULL. May push */
} lsw_class;

/* Make a closed handle of the class with the given number of user values and
 * push it. */
void *lsw_new(lua_State *L, const lsw_class *c, int user_values);

/* The open handle at index; raises a clear error for anything else. */
void *lsw_check(lua_State *L, int index, const lsw_class *c);

/* The handle at index whether open or closed, or NULL when it is of another
 * type. */
void *lsw_test(lua_State *L, int index, const lsw_class *c);

/* Push a zeroed userdata of a kind that is no class: end(it) frees what it has, also when it was
 * closed before. methods: NULL = none. */
void *lsw_keep(lua_State *L, size_t size, const char *name, const luaL_Reg *methods,
               lua_CFunction end);

/* The class of the userdata at index, or NULL for anything that is not ours. */
const lsw_class *lsw_class_of(lua_State *L, int index);

/* Push a name for a wrong argument, for messages: "number 3", "string '3'", "scene", "table". */
const char *lsw_describe(lua_State *L, int index);

/* Make the metatables of every class in classes.def and push a table of
 * method tables by class name (Lua files add methods to them). */
void lsw_open_classes(lua_State *L);

/* Raise the error for a failed core call: err's text, or the status's. */
/* Raise "interrupted" when the user wants to stop. */
void lsw_poll(lua_State *L);

int lsw_raise(lua_State *L, sw_status status, const sw_error *err);

/* Read the table at index into args by the rows: defaults first, then every
 * key; unknown keys, wrong types and values out of range raise. object names
 * the thing in messages ("scene:wire"). nil or none at index = empty table. */
void lsw_arguments(lua_State *L, int index, const char *object, const sw_params *params,
                   void *args);

/* The same for one table whose keys belong to several row tables, each with
 * its own argument struct (an obstacle's keys and its shape's). */
typedef struct lsw_section {
  const sw_params *params;
  void *args;
} lsw_section;
void lsw_sections(lua_State *L, int index, const char *object, const lsw_section *sections,
                  int count);

/* Which of the names is the word on top of the stack; raises what ("wire: there is no model") and
 * the nearest of them, or all after also. */
size_t lsw_word(lua_State *L, const char *what, const char *also, const char *const *names,
                size_t count);

/* object:set{...}: read over what args has; rows that do not change raise. */
void lsw_changes(lua_State *L, int index, const char *object, const sw_params *params, void *args);

/* The points under a key of the table as a flat array owned by a new userdata on the stack (so that
 * errors free it), or NULL without the key. */
double *lsw_read_points(lua_State *L, int table, const char *key, const char *object,
                        size_t *count);

/* object:get(): push a table of what args has. */
void lsw_push_values(lua_State *L, const sw_params *params, const void *args);

/* Read three finite numbers {x, y, z} (or fields x, y, z) at index. what is for
 * messages: "scene:wire: from". */
sw_vec lsw_vector(lua_State *L, int index, const char *what, const char *unit);

/* Read a rotation: nil = identity, {axis=, angle=} [rad] or {w, x, y, z}. */
sw_quat lsw_rotation(lua_State *L, int index, const char *what);

/* A finite number at index, named in the error. */
double lsw_number(lua_State *L, int index, const char *what, const char *unit);

/* An integer at index, named in the error. */
lua_Integer lsw_integer(lua_State *L, int index, const char *what);

void lsw_push_vector(lua_State *L, sw_vec a);      /* {x, y, z} */
void lsw_push_quaternion(lua_State *L, sw_quat q); /* {w, x, y, z} */

/* Push the rows as a Lua array of tables (name, type, unit, default, min, max,
 * doc, choices): what help() and the reference pages read. */
void lsw_push_params(lua_State *L, const sw_params *params);

#endif
