/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires of a scene: how they are made, meshed anew, and touch each other. */
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
  int breaking_flag;    /* where that is from: index into sw_breaking_flags */
} sw_wire_args;
enum { SW_BREAKING_FLAGS = 4 };
extern const char *const sw_breaking_flags[];
enum { SW_REST_STRAIGHT = 0, SW_REST_PATH = 1 };
extern const sw_params sw_wire_params; /* model, path, segments, ... */

/* Of a wire whose model is a mesh of particles. */
typedef struct sw_wire_mesh_args {
  double spacing; /* of slices; NAN = chosen [m] */
  double squeeze; /* see sw_calibrate_args [Pa] */
  int body;       /* SW_BODY_SPRINGS, SW_BODY_SOLID */
  double wall;    /* bending stiffness of a tube's wall, per length; NAN = none [N m] */
  sw_lattice_args lattice;
  sw_section section; /* as given */
} sw_wire_mesh_args;
extern const sw_params sw_wire_mesh_params; /* without those of the lattice and the section */

/* points (count x 3): the polyline the wire lies along; NULL takes from and to. mesh: with a
 * model that is one, else NULL. SW_EINVAL for fewer than two different points. */
sw_status sw_scene_add_wire(sw_scene *scene, const sw_wire_args *args, const sw_beam *beam,
                            const sw_wire_mesh_args *mesh, const double *points, size_t count,
                            sw_handle *out, sw_error *err);

/* Give every wire a mesh of so many even segments (count: one number per wire), with
 * the nodes its holds need. A wire that has not moved since it was drawn is drawn anew;
 * any other keeps its length, shape, motion, strains and twist. After SW_ENOMEM some
 * wires may have the new mesh. */
sw_status sw_scene_remesh(sw_scene *scene, const size_t *segments, size_t count, sw_error *err);
/* What a rod is to be instead, its mesh as before. */
typedef struct sw_redrawing {
  int rolls;         /* 1: friction turns it about its axis; 0: it does not */
  double EA, EI, GJ; /* times what they are [-] */
} sw_redrawing;
/* Make such a rod of it, at once as if it had been made so. SW_EINVAL: it is no rod; or it has
 * moved, and EA is to change, frames are to go, or twist would be lost. */
sw_status sw_scene_redraw(sw_scene *scene, sw_handle wire, const sw_redrawing *as, sw_error *err);
/* Even segments that a wire's mesh stands for, holds' own nodes left out. */
sw_status sw_scene_wire_segments(sw_scene *scene, sw_handle wire, size_t *segments, sw_error *err);

/* The calibration of a wire that is a mesh; NULL: it is no mesh, or is gone. */
const sw_calibration *sw_scene_wire_calibration(const sw_scene *scene, sw_handle wire);
/* Name of its model; NULL: it is gone. */
const char *sw_scene_wire_model(const sw_scene *scene, sw_handle wire);

/* --- wires that touch each other ------------------------------------------------ */

typedef struct sw_wire_contact_args {
  double friction; /* [-] */
  int self, on;
} sw_wire_contact_args;
extern const sw_params sw_wire_contact_params;

/* From now on these wires (none = all, later ones too) touch each other. */
sw_status sw_scene_wire_contact(sw_scene *scene, const sw_wire_contact_args *args,
                                const sw_handle *wires, size_t count, sw_error *err);

/* A place where two wires press on each other. */
typedef struct sw_wire_touch {
  char wire[2][SW_NAME_SIZE];
  double s[2];          /* arc lengths [m] */
  sw_vec point, normal; /* between the surfaces [m]; towards the first wire [-] */
  sw_vec force;         /* on the first wire [N] */
  sw_vec friction;      /* part of it across the normal [N] */
  double normal_force;  /* [N] */
} sw_wire_touch;

/* How many such places the accepted state has, and the next of them, 0: there are no more; next:
 * {0, 0} for the first one. */
sw_status sw_scene_wire_touch_count(sw_scene *scene, size_t *count, sw_error *err);
int sw_scene_next_touch(sw_scene *scene, size_t next[2], sw_wire_touch *out);

/* The free nodes of a line get the speed with which they came from where they were (count x 3) [m]
 * a span ago [s]: after poses, which have none. */
sw_status sw_scene_wire_came_from(sw_scene *scene, sw_handle wire, const double *before,
                                  size_t count, double span, sw_error *err);

#endif
