/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Objects that belong to a scene: wire, clamp, obstacle, force, join. They keep the
 * scene alive (user value 1) and find out when it was closed. */
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

/* Which object of which scene. */
typedef struct lsw_self {
  sw_scene *scene;
  sw_handle id;
} lsw_self;

extern const lsw_class lsw_class_scene, lsw_class_wire, lsw_class_particles, lsw_class_clamp,
    lsw_class_obstacle, lsw_class_tool, lsw_class_force, lsw_class_join, lsw_class_snapshot;

/* Push a scene that is still closed, to be opened by its object. */
lsw_handle *lsw_new_scene(lua_State *L);

/* The scene at index 1. */
sw_scene *lsw_check_scene(lua_State *L);

/* Push a child of the scene at index 1; no object is there until its id is set. */
lsw_child *lsw_new_child(lua_State *L, const lsw_class *c);

/* The child at index 1, whose method is called; raises when it or its scene is gone. */
lsw_self lsw_check_self(lua_State *L, const lsw_class *c);

/* The child at index, which must belong to the given scene. */
sw_handle lsw_check_child_of(lua_State *L, int index, const lsw_class *c, const sw_scene *scene,
                             const char *what);

/* A wire or an object of particles, as above. */
sw_handle lsw_check_body_of(lua_State *L, int index, const sw_scene *scene, const char *what);

/* As lsw_check_self without raising: when its scene is gone 0, and what tostring may say is
 * pushed. */
int lsw_find_self(lua_State *L, const lsw_class *c, lsw_self *out);

/* Push a text of less than 512 bytes, as C formats it; return 1. */
__attribute__((format(printf, 2, 3))) int lsw_say(lua_State *L, const char *format, ...);
/* For tostring of what is there no more. */
int lsw_say_taken_back(lua_State *L, const lsw_class *c);

/* Raise: a restored snapshot has taken it back. */
int lsw_not_there(lua_State *L, const lsw_class *c, const sw_scene *scene);

/* Raise unless status is SW_OK; callback errors keep their value. */
void lsw_must(lua_State *L, sw_status status, const sw_error *err);

/* Call a function of the core, whose last argument is an sw_error, and raise what it fails by. */
#define LSW_DO(L, function, ...)                              \
  do {                                                        \
    sw_error lsw_err_ = {""};                                 \
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
 * scene:penetration() -> deepest of the run so far [m], where [m], when [s], now [m];
 * scene:contacts() -> number of places with a force */
int lsw_scene_wire_contact(lua_State *L);
int lsw_scene_touches(lua_State *L);
int lsw_scene_penetration(lua_State *L);
int lsw_scene_contacts(lua_State *L);
/* scene:tell{...} books an event; scene:events() -> those of the run */
int lsw_scene_tell(lua_State *L);
int lsw_scene_events(lua_State *L);
int lsw_scene_frame(lua_State *L);
int lsw_scene_frame_count(lua_State *L);
int lsw_scene_clear_frames(lua_State *L);
int lsw_wire_frequencies(lua_State *L);
int lsw_wire_remodel(lua_State *L);
/* Index of the word under `model` of the table: of sw_wire_all(). */
int lsw_read_model(lua_State *L, int table);
/* Further parameters of a model that is a mesh: rows into out, 0 or 2 of them; defaults into
 * mesh. */
size_t lsw_mesh_sections(const sw_wire_class *cls, sw_wire_mesh_args *mesh, lsw_section *out);
int lsw_wire_calibration(lua_State *L);
/* wire:section(s), wire:width(s, direction), wire:contact_pressure([s]), wire:von_mises([s]) */
int lsw_wire_section(lua_State *L);
int lsw_wire_width(lua_State *L);
int lsw_wire_contact_pressure(lua_State *L);
int lsw_wire_von_mises(lua_State *L);

/* Servers of live views that run now: their threads would not be in a fork. */
int lsw_servers(void);

/* While the core may call Lua functions as forces: they run on L, whose stack
 * index 1 is the scene. The value goes back to lsw_end_forces. */
lua_State *lsw_begin_forces(lua_State *L);
void lsw_end_forces(lua_State *outer);
/* As LSW_DO meanwhile. */
#define LSW_DO_FORCES(L, function, ...)                        \
  do {                                                         \
    sw_error lsw_err_ = {""};                                  \
    lua_State *lsw_outer_ = lsw_begin_forces(L);               \
    const sw_status lsw_s_ = function(__VA_ARGS__, &lsw_err_); \
    lsw_end_forces(lsw_outer_);                                \
    lsw_must(L, lsw_s_, &lsw_err_);                            \
  } while (0)
/* Let go of functions that no force of the scene userdata at index needs. */
void lsw_forget_forces(lua_State *L, int index, const sw_scene *scene);

/* Raise unless the value at index is one table of parameters. */
void lsw_check_table(lua_State *L, int index, const char *what);

/* Push n numbers as a flat array. */
void lsw_push_flat(lua_State *L, const double *values, size_t n);

/* Read a flat array of exactly n finite numbers. */
void lsw_read_flat(lua_State *L, int index, double *out, size_t n);

/* Push a table of each kind of energy and their total [J]. */
void lsw_push_energy(lua_State *L, const sw_energy *energy);

/* Set fields of the table on top of the stack; points: a list of at (count x 3), momentum: linear
 * and angular. */
void lsw_set_text(lua_State *L, const char *name, const char *text);
void lsw_set_flag(lua_State *L, const char *name, int flag);
void lsw_set_number(lua_State *L, const char *name, double value);
void lsw_set_known(lua_State *L, const char *name, double value); /* not when NAN */
void lsw_set_integer(lua_State *L, const char *name, size_t value);
void lsw_set_vector(lua_State *L, const char *name, sw_vec value);
void lsw_set_flat(lua_State *L, const char *name, const double *values, size_t n);
void lsw_set_points(lua_State *L, const char *name, const double *at, size_t count);
void lsw_set_momentum(lua_State *L, const char *name, const double p[6]);

#endif
