/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Userdata classes and argument tables. One lsw_class per kind of object, all
 * listed in classes.def; this file gives each of them its life cycle. */
#ifndef LSW_CLASS_H
#define LSW_CLASS_H

#include <lauxlib.h>
#include <lua.h>

#include "softworld.h"

/* Start of every userdata. A new handle is closed (object NULL). Its constructor
 * opens it as the last step, so that a failure before is safe. */
typedef struct lsw_handle {
  void *object;
} lsw_handle;

typedef struct lsw_class {
  const char *name; /* "scene": the word used in messages, type() and tostring */
  sw_kind kind;     /* kind of object of a scene; SW_OF_NONE: not an object of a scene */
  size_t size;      /* of the userdata; starts with an lsw_handle [B] */
  const luaL_Reg *methods;
  void (*more)(lua_State *L);        /* adds methods to the table on top, or NULL */
  lua_CFunction describe;            /* tostring of an open object, or NULL */
  const luaL_Reg *properties;        /* getters called as f(object), or NULL */
  void (*close)(lsw_handle *h);      /* frees h->object, which is not NULL. NULL: another userdata
                                      * owns the object, there is nothing to close */
  const char *gone;                  /* message for a closed handle: "the scene has been closed" */
  int (*busy)(const lsw_handle *h);  /* 1: must not be closed now; NULL: may always be closed */
  const char *(*word)(lua_State *L); /* word for the object at index 1 in messages; may push. NULL,
                                        or where it returns NULL: the class's name is used */
} lsw_class;

/* Pushes and returns a new closed handle of the class with the given number of user values. */
void *lsw_new(lua_State *L, const lsw_class *c, int user_values);

/* The open handle at index; raises a clear error for anything else. */
void *lsw_check(lua_State *L, int index, const lsw_class *c);

/* The handle at index, open or closed; NULL for a value of another type. */
void *lsw_test(lua_State *L, int index, const lsw_class *c);

/* Pushes and returns a zeroed userdata that is not of a class. end(userdata) frees what it holds;
 * it may be called more than once. methods: NULL = none. */
void *lsw_keep(lua_State *L, size_t size, const char *name, const luaL_Reg *methods,
               lua_CFunction end);

/* The class of the userdata at index, or NULL for any other value. */
const lsw_class *lsw_class_of(lua_State *L, int index);

/* Returns words for a wrong argument, for messages: "number 3", "string '3'", "scene", "table". May
 * push. */
const char *lsw_describe(lua_State *L, int index);

/* Adds methods of the class to the table on top. They refuse arguments that they do not take. They
 * may read upvalue 1, the class, but have no upvalues of their own. */
void lsw_set_methods(lua_State *L, const lsw_class *c, const luaL_Reg *methods);

/* Name of the method that is the running C function, or NULL. */
const char *lsw_running_method(lua_State *L);

/* Makes the metatables of all classes in classes.def. Pushes a table of their
 * method tables by class name; Lua files add methods to these. */
void lsw_open_classes(lua_State *L);

/* Makes the tables of lsw_quiet (child.h). */
void lsw_open_quiet(lua_State *L);

/* Raises "interrupted" when the user wants to stop. */
void lsw_poll(lua_State *L);

/* Same if a stop was asked for since sw_interrupt_count() was count, also if the user's own code
 * has caught that error. */
void lsw_stop_since(lua_State *L, unsigned count);

/* Raises the error of a failed core call: err's text, or the status's if err is NULL or empty. */
int lsw_raise(lua_State *L, sw_status status, const sw_error *err);

/* Reads the table at index into args by the rows: first the defaults, then every
 * key. Unknown keys, wrong types and values out of range raise. object is for
 * messages ("scene:wire"). nil or none at index = empty table. */
void lsw_arguments(lua_State *L, int index, const char *object, const sw_params *params,
                   void *args);

/* The same for a table whose keys belong to several tables of rows, each with
 * its own argument struct (an obstacle's keys and its shape's). */
typedef struct lsw_section {
  const sw_params *params;
  void *args;
} lsw_section;
void lsw_sections(lua_State *L, int index, const char *object, const lsw_section *sections,
                  int count);

/* Returns in words how an object with rotation is turned, if a key that it lacks asks for that;
 * else NULL. */
const char *lsw_turned_by(const char *object, const sw_params *params, const char *key);

/* Returns the index among names of the word on top of the stack. If it is not there, raises an
 * error with `what` ("wire: there is no model"), the word, and the nearest name; if none is near,
 * with `also` and all names. */
size_t lsw_word(lua_State *L, const char *what, const char *also, const char *const *names,
                size_t count);

/* object:set{...}: overwrites the given values in args. Rows that cannot be changed raise. */
void lsw_changes(lua_State *L, int index, const char *object, const sw_params *params, void *args);

/* Returns the points under a key of the table as a flat array, or NULL without the key. A new
 * userdata on the stack owns the array, so that errors free it. */
double *lsw_read_points(lua_State *L, int table, const char *key, const char *object,
                        size_t *count);

/* object:get(): pushes a table of the values in args. */
void lsw_push_values(lua_State *L, const sw_params *params, const void *args);

/* Raises an error for a key of the table at index that is neither an integer nor one of these
 * names. The n of table.pack may be there. */
void lsw_only(lua_State *L, int index, const char *what, const char *const *names, size_t count);
/* The same for a list: it has no names at all. */
void lsw_only_items(lua_State *L, int index, const char *what);

/* Returns the three finite numbers {x, y, z} (or fields x, y, z) at index. what is
 * for messages: "scene:wire: from". */
sw_vec lsw_vector(lua_State *L, int index, const char *what, const char *unit);
/* The same for a place [m], whose coordinates are within SW_PLACE_FARTHEST. */
sw_vec lsw_place(lua_State *L, int index, const char *what);
/* The same of a table that may have more fields, which the caller looks at. */
sw_vec lsw_place_in(lua_State *L, int index, const char *what);

/* Returns the rotation at index: nil = identity, {axis=, angle=} [rad] or {w, x, y, z}. */
sw_quat lsw_rotation(lua_State *L, int index, const char *what);
/* The turn { axis =, angle = } as axis times angle [rad]. */
sw_vec lsw_turn(lua_State *L, int index, const char *what);

/* Returns the finite number at index; what names it in the error. */
double lsw_number(lua_State *L, int index, const char *what, const char *unit);

/* Returns the text at index, which must fit into SW_NAME_SIZE and have no control characters. what
 * names it in the error. Pushes nothing. */
const char *lsw_name(lua_State *L, int index, const char *what);

/* Returns the integer at index; what names it in the error. */
lua_Integer lsw_integer(lua_State *L, int index, const char *what);

/* Sets the fields `vector` and `rotation` of the module on top of the stack: the metatables of the
 * lists that the next two push, empty here (lua/softworld/vector.lua fills them). */
void lsw_open_vectors(lua_State *L);
void lsw_push_vector(lua_State *L, sw_vec a);      /* {x, y, z} */
void lsw_push_quaternion(lua_State *L, sw_quat q); /* {w, x, y, z} */

/* Pushes the rows as a Lua array of tables (name, type, unit, default, min, max,
 * doc, choices), for help() and the reference pages. */
void lsw_push_params(lua_State *L, const sw_params *params);

#endif
