/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires of a scene: making them, meshing them anew, and contact between them. */
#ifndef SW_EDIT_WIRES_H
#define SW_EDIT_WIRES_H

#include "calibrate/calibrate.h"
#include "scene/scene.h"
#include "wire/wire.h"

typedef struct sw_wire_args {
  char name[SW_NAME_SIZE];
  int model;            /* index into sw_wire_all() */
  sw_vec from, to;      /* straight wire; NAN = not given [m] */
  long segments;        /* 0 = chosen [-] */
  int rest;             /* shape without load: SW_REST_STRAIGHT, SW_REST_PATH */
  sw_vec normal;        /* first axis of the section; NAN = not given [-] */
  double rest_twist;    /* without load [rad/m] */
  int rolls;            /* 1: spins about its axis, with inertia, under friction */
  double breaking_load; /* NAN = not known [N] */
  int breaking_flag;    /* source of the breaking load: index into sw_breaking_flags */
} sw_wire_args;
enum { SW_BREAKING_FLAGS = 4 };
extern const char *const sw_breaking_flags[];
enum { SW_REST_STRAIGHT = 0, SW_REST_PATH = 1 };
extern const sw_params sw_wire_params; /* model, path, segments, ... */

/* Further arguments of a wire whose model is a mesh of particles. */
typedef struct sw_wire_mesh_args {
  double spacing; /* of slices; NAN = chosen [m] */
  double squeeze; /* see sw_calibrate_args [Pa] */
  int body;       /* SW_BODY_SPRINGS, SW_BODY_SOLID */
  double wall;    /* bending stiffness of a tube's wall, per length; NAN = none [N m] */
  sw_lattice_args lattice;
  sw_section section;              /* as given */
  struct sw_strand_recent *recent; /* calibrations to take over and to keep; or NULL */
} sw_wire_mesh_args;
extern const sw_params sw_wire_mesh_params; /* without those of the lattice and the section */

/* Returns room for the calibrations of recent meshes, for sw_wire_mesh_args, or NULL without
 * memory. Only one thread may use it. */
struct sw_strand_recent *sw_wire_recent_new(void);
void sw_wire_recent_free(struct sw_strand_recent *recent); /* NULL is allowed */

/* Adds a wire. points (count x 3): the polyline it lies along; NULL takes from and to. mesh: for
 * models that are meshes, else NULL. SW_EINVAL for fewer than two different points. */
sw_status sw_scene_add_wire(sw_scene *scene, const sw_wire_args *args, const sw_beam *beam,
                            const sw_wire_mesh_args *mesh, const double *points, size_t count,
                            sw_handle *out, sw_error *err);

/* Gives every wire a mesh of this many even segments (count: one number per wire), with the nodes
 * its holds need. A wire that has not moved since it was drawn is drawn anew; any other keeps its
 * length, shape, motion, strains and twist. After SW_ENOMEM some wires may have the new mesh. */
sw_status sw_scene_remesh(sw_scene *scene, const size_t *segments, size_t count, sw_error *err);
/* Changes of a rod that keep its mesh. */
typedef struct sw_redrawing {
  int rolls;         /* 1: friction turns it about its axis; 0: it does not */
  double EA, EI, GJ; /* factors on the present values [-] */
} sw_redrawing;
/* Changes the rod at once, as if it had been made like this. SW_EINVAL: it is no rod; or it has
 * moved, and EA would change, frames would go, or twist would be lost. */
sw_status sw_scene_redraw(sw_scene *scene, sw_handle wire, const sw_redrawing *as, sw_error *err);
/* Returns the number of even segments of a wire's mesh, without the nodes of holds. */
sw_status sw_scene_wire_segments(sw_scene *scene, sw_handle wire, size_t *segments, sw_error *err);

/* Returns the calibration of a wire that is a mesh; NULL: it is no mesh, or is gone. */
const sw_calibration *sw_scene_wire_calibration(const sw_scene *scene, sw_handle wire);
/* Returns the name of its model; NULL: it is gone. */
const char *sw_scene_wire_model(const sw_scene *scene, sw_handle wire);

/* --- wires that touch each other ------------------------------------------------ */

typedef struct sw_wire_contact_args {
  double friction; /* [-] */
  int self, on;
} sw_wire_contact_args;
extern const sw_params sw_wire_contact_params;

/* Lets these wires (none = all, later ones too) touch each other from now on. */
sw_status sw_scene_wire_contact(sw_scene *scene, const sw_wire_contact_args *args,
                                const sw_handle *wires, size_t count, sw_error *err);

/* A place where two wires press on each other. */
typedef struct sw_wire_touch {
  char wire[2][SW_NAME_SIZE];
  double s[2];          /* arc lengths [m] */
  sw_vec point, normal; /* between the surfaces [m]; towards the first wire [-] */
  sw_vec force;         /* on the first wire [N] */
  sw_vec friction;      /* its part across the normal [N] */
  double normal_force;  /* [N] */
} sw_wire_touch;

/* Places where wires touch in the accepted state: their number, and the next one; 0: there are no
 * more. next: {0, 0} for the first one. */
sw_status sw_scene_wire_touch_count(sw_scene *scene, size_t *count, sw_error *err);
int sw_scene_next_touch(sw_scene *scene, size_t next[2], sw_wire_touch *out);

/* Sets the velocity of a line's free nodes to their way from `before` (count x 3) [m] over the span
 * [s]: for use after poses, which have no velocity. */
sw_status sw_scene_wire_came_from(sw_scene *scene, sw_handle wire, const double *before,
                                  size_t count, double span, sw_error *err);

#endif
