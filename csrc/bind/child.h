/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Userdata of objects that belong to a scene: wire, clamp, obstacle, force, join. User value 1
 * is the scene, which they keep alive; they find out when it was closed. */
#ifndef LSW_CHILD_H
#define LSW_CHILD_H

#include "bind/class.h"

typedef struct lsw_scene_handle {
  lsw_handle h; /* object: sw_scene */
  int forces;   /* functions kept as forces so far */
} lsw_scene_handle;

typedef struct lsw_child {
  lsw_handle h; /* object: the lsw_scene_handle it belongs to */
  sw_handle id;
} lsw_child;

/* An object and its scene. */
typedef struct lsw_self {
  sw_scene *scene;
  sw_handle id;
} lsw_self;

extern const lsw_class lsw_class_scene, lsw_class_wire, lsw_class_particles, lsw_class_clamp,
    lsw_class_obstacle, lsw_class_tool, lsw_class_force, lsw_class_join, lsw_class_snapshot;

/* Pushes a closed scene handle; the caller opens it by setting its object. */
lsw_handle *lsw_new_scene(lua_State *L);

/* The scene at index 1. */
sw_scene *lsw_check_scene(lua_State *L);

/* Pushes a child of the scene at index 1. It has no object until the caller sets its id. */
lsw_child *lsw_new_child(lua_State *L, const lsw_class *c);

/* The child at index 1, whose method is called; raises when its scene is closed. */
lsw_self lsw_check_self(lua_State *L, const lsw_class *c);

/* The child at index, which must belong to the given scene. what: the method and its argument, for
 * errors. */
sw_handle lsw_check_child_of(lua_State *L, int index, const lsw_class *c, const sw_scene *scene,
                             const char *what);

/* The same for a wire or an object of particles. */
sw_handle lsw_check_body_of(lua_State *L, int index, const sw_scene *scene, const char *what);

/* As lsw_check_self, but does not raise: if the scene is closed, pushes a text for tostring and
 * returns 0. */
int lsw_find_self(lua_State *L, const lsw_class *c, lsw_self *out);

/* Pushes a text of less than 512 bytes, formatted as by printf; returns 1. */
__attribute__((format(printf, 2, 3))) int lsw_say(lua_State *L, const char *format, ...);
/* Pushes the text of tostring for an object that a restored snapshot has taken back; returns 1. */
int lsw_say_taken_back(lua_State *L, const lsw_class *c);

/* Raises: the object is no longer of its scene. */
int lsw_not_there(lua_State *L, const lsw_class *c, const sw_scene *scene);

/* 1 unless the object at index 1, whose method runs, or its scene was closed since the method
 * began: metamethods of its arguments and finalisers can do that. lsw_still_open raises then. */
int lsw_is_open(lua_State *L);
void lsw_still_open(lua_State *L);

/* No finaliser runs from here to the end of the running C function, so nothing closes or changes
 * the scene while the function reads its lists. The object at index 1 must still be open. Pushes a
 * value that must stay where it is. Nothing but a lack of memory may raise an error from here on:
 * in a coroutine that fails, the collector would stay stopped. */
void lsw_quiet(lua_State *L);

/* Raises unless status is SW_OK; errors of Lua callbacks keep their value. */
void lsw_must(lua_State *L, sw_status status, const sw_error *err);

/* Calls a function of the core, whose last argument is an sw_error, and raises its error. The
 * object at index 1 must still be open. */
#define LSW_DO(L, function, ...)                              \
  do {                                                        \
    sw_error lsw_err_ = {""};                                 \
    lsw_still_open(L);                                        \
    lsw_must(L, function(__VA_ARGS__, &lsw_err_), &lsw_err_); \
  } while (0)

/* scene:<kind>(wire, {...}) for holds; scene:obstacle{...}; scene:force{...} */
int lsw_scene_wire(lua_State *L);
int lsw_scene_particles(lua_State *L);
int lsw_hold_particles(lua_State *L);
void lsw_add_holds(lua_State *L); /* a method of scene for each class of holds */
int lsw_scene_join(lua_State *L);
int lsw_scene_obstacle(lua_State *L);
int lsw_scene_tool(lua_State *L);
int lsw_scene_force(lua_State *L);
int lsw_scene_evaluate(lua_State *L);
int lsw_scene_advance(lua_State *L); /* of scene:run */
int lsw_scene_settle(lua_State *L);
/* scene:wire_contact{...}; scene:touches() -> places where wires press on each other;
 * scene:penetration() -> largest of the run so far [m], where [m], when [s], present one [m];
 * scene:contacts() -> number of places with a contact force */
int lsw_scene_wire_contact(lua_State *L);
int lsw_scene_touches(lua_State *L);
int lsw_scene_penetration(lua_State *L);
int lsw_scene_contacts(lua_State *L);
/* scene:tell{...} books an event; scene:events() -> events of the run */
int lsw_scene_tell(lua_State *L);
int lsw_scene_events(lua_State *L);
int lsw_scene_frame(lua_State *L);
int lsw_scene_frame_count(lua_State *L);
int lsw_scene_clear_frames(lua_State *L);
int lsw_wire_frequencies(lua_State *L);
int lsw_wire_remodel(lua_State *L);
/* Returns the index in sw_wire_all() of the table's `model` (default: rod). */
int lsw_read_model(lua_State *L, int table);
/* Writes the further sections of parameters that a mesh model has to out and their defaults to
 * mesh. Returns how many: 2, or 0 if the model is no mesh. */
size_t lsw_mesh_sections(const sw_wire_class *cls, sw_wire_mesh_args *mesh, lsw_section *out);
int lsw_wire_calibration(lua_State *L);
/* wire:section(s), wire:width(s, direction), wire:contact_pressure([s]), wire:von_mises([s]) */
int lsw_wire_section(lua_State *L);
int lsw_wire_width(lua_State *L);
int lsw_wire_contact_pressure(lua_State *L);
int lsw_wire_von_mises(lua_State *L);

/* Number of live-view servers that run. A fork would not have their threads. */
int lsw_servers(void);

/* Between these two calls the core may call Lua functions as forces. They run on L, whose stack
 * index 1 is the scene. The returned value goes to lsw_end_forces. */
lua_State *lsw_begin_forces(lua_State *L);
void lsw_end_forces(lua_State *outer);
/* LSW_DO between lsw_begin_forces and lsw_end_forces. */
#define LSW_DO_FORCES(L, function, ...)                        \
  do {                                                         \
    sw_error lsw_err_ = {""};                                  \
    lsw_still_open(L);                                         \
    lua_State *lsw_outer_ = lsw_begin_forces(L);               \
    const sw_status lsw_s_ = function(__VA_ARGS__, &lsw_err_); \
    lsw_end_forces(lsw_outer_);                                \
    lsw_must(L, lsw_s_, &lsw_err_);                            \
  } while (0)
/* Forgets the Lua functions that no force of the scene (userdata at index) needs any more. */
void lsw_forget_forces(lua_State *L, int index, const sw_scene *scene);

/* Raises unless the value at index is a table of parameters. */
void lsw_check_table(lua_State *L, int index, const char *what);

/* Set item i (from 0) of the list on top of the stack. */
static inline void lsw_put_number(lua_State *L, size_t i, double value) {
  lua_pushnumber(L, value);
  lua_rawseti(L, -2, (lua_Integer)i + 1);
}
static inline void lsw_put_integer(lua_State *L, size_t i, lua_Integer value) {
  lua_pushinteger(L, value);
  lua_rawseti(L, -2, (lua_Integer)i + 1);
}
/* Pushes n numbers as a flat array. */
void lsw_push_flat(lua_State *L, const double *values, size_t n);
/* Pushes a list of such arrays, width numbers each. */
void lsw_push_rows(lua_State *L, const double *values, size_t rows, size_t width);

/* Asks the core for a number of items of a wire. */
typedef sw_status (*lsw_counter)(sw_scene *scene, sw_handle wire, size_t *count, sw_error *err);
/* Pushes a userdata with room for `each` numbers for each item, and returns it. A finaliser that
 * ran meanwhile may have changed the number of items; then it is asked again. */
double *lsw_room(lua_State *L, lsw_self w, lsw_counter counter, size_t each, size_t *count);

/* Reads a flat array of exactly n finite numbers; raises for anything else. */
void lsw_read_flat(lua_State *L, int index, double *out, size_t n);

/* Returns n numbers of the list at index, each as by lsw_number; pushes the userdata that owns
 * them. */
double *lsw_numbers(lua_State *L, int index, size_t n, const char *what, const char *unit);

/* Pushes a table of each kind of energy and their total [J]. */
void lsw_push_energy(lua_State *L, const sw_energy *energy);

/* Set a field of the table on top of the stack. points: at (count x 3) as a list of {x, y, z};
 * momentum: p as { linear, angular }. */
void lsw_set_text(lua_State *L, const char *name, const char *text);
void lsw_set_flag(lua_State *L, const char *name, int flag);
void lsw_set_number(lua_State *L, const char *name, double value);
void lsw_set_known(lua_State *L, const char *name, double value); /* does nothing for NAN */
void lsw_set_integer(lua_State *L, const char *name, size_t value);
void lsw_set_vector(lua_State *L, const char *name, sw_vec value);
void lsw_set_flat(lua_State *L, const char *name, const double *values, size_t n);
void lsw_set_points(lua_State *L, const char *name, const double *at, size_t count);
void lsw_set_momentum(lua_State *L, const char *name, const double p[6]);

#endif
