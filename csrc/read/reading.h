/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of a scene: its wires, energy, modes and series. */
#ifndef SW_READ_READING_H
#define SW_READ_READING_H

#include "scene/scene.h"
#include "scene/values.h"

sw_status sw_scene_wire_length(sw_scene *scene, sw_handle wire, double *length, sw_error *err);
sw_status sw_scene_wire_nodes(sw_scene *scene, sw_handle wire, size_t *nodes, sw_error *err);
sw_status sw_scene_wire_beam(sw_scene *scene, sw_handle wire, sw_beam *out, sw_error *err);
sw_status sw_scene_wire_at(sw_scene *scene, sw_handle wire, double s, sw_point_state *out,
                           sw_error *err);
/* The same; only position, tangent and velocity are valid. Cheaper after forces were added. */
sw_status sw_scene_wire_motion(sw_scene *scene, sw_handle wire, double s, sw_point_state *out,
                               sw_error *err);
/* Copies node positions (n x 3), arc lengths (n) and velocities (n x 3); each may be NULL. */
sw_status sw_scene_wire_copy(sw_scene *scene, sw_handle wire, double *positions, double *s,
                             double *velocities, sw_error *err);
/* All particles of a mesh, ring by ring; on other wires the nodes. */
sw_status sw_scene_wire_particles(sw_scene *scene, sw_handle wire, size_t *particles,
                                  sw_error *err);
sw_status sw_scene_wire_particle_copy(sw_scene *scene, sw_handle body, double *positions, double *s,
                                      double *velocities, sw_error *err);
/* Gives every free node a velocity: the linear field v + omega x (x - about). */
sw_status sw_scene_wire_set_velocity(sw_scene *scene, sw_handle wire, sw_vec v, sw_vec omega,
                                     sw_vec about, sw_error *err);
sw_status sw_scene_wire_extremes(sw_scene *scene, sw_handle wire, sw_wire_extremes *now,
                                 sw_wire_extremes *run, sw_error *err);

/* --- more read-outs ------------------------------------------------------------------ */

typedef struct sw_modes_args {
  long modes;       /* number of modes [-] */
  double tolerance; /* allowed distance from rest, over the wire's length [-] */
  int shapes;       /* 1: also the shapes */
  int alone;        /* 1: wires that are joined to it stay where they are */
} sw_modes_args;
extern const sw_params sw_modes_params;

typedef struct sw_modes_result {
  size_t count;        /* frequencies found [-] */
  size_t unstable;     /* motions that grow instead [-] */
  double growth;       /* of the fastest of them [1/s] */
  double *frequencies; /* (modes), the caller's array [Hz] */
  double *shapes;      /* (modes x nodes x 3), the caller's array, or NULL [1/sqrt(kg)] */
} sw_modes_result;

/* Finds the lowest natural frequencies of one wire about the present equilibrium; everything else
 * stays as it is. Changes nothing. SW_EINVAL when the wire is not at rest. */
sw_status sw_scene_wire_modes(sw_scene *scene, sw_handle wire, const sw_modes_args *args,
                              int (*interrupted)(void), sw_modes_result *out, sw_error *err);

/* Kinetic, contact, repel, join, and for each force class its own energy and the energy that it
 * corrects. */
enum { SW_ENERGY_KINDS = 4 + 2 * SW_FORCE_CLASSES };
typedef struct sw_energy {
  size_t count;
  const char *kind[SW_ENERGY_KINDS];
  double value[SW_ENERGY_KINDS]; /* [J] */
  double dissipated;             /* so far by forces with a history; not stored [J] */
  int has_dissipated;            /* 1: there are such forces */
} sw_energy;
sw_status sw_scene_energy(sw_scene *scene, sw_energy *out, sw_error *err);
/* The same for one wire or object of particles. */
sw_status sw_scene_body_energy(sw_scene *scene, sw_handle body, sw_energy *out, sw_error *err);

/* Deepest penetration of a wire's surface into an obstacle, at present and since the last run began
 * [m]. */
sw_status sw_scene_penetration(sw_scene *scene, double *now, sw_extreme *deepest, sw_error *err);
/* Returns the number of contact points with a force at present. */
size_t sw_scene_touches(sw_scene *scene);

/* Where a force is evaluated; NULL = at the scene's own state. Arrays are (nodes x 3). */
typedef struct sw_probe {
  const double *positions;  /* [m] */
  const double *velocities; /* [m/s] */
  const double *direction;  /* to be multiplied by the stiffness; NULL = no product [m] */
  double rate; /* adds rate times the damping to the stiffness, as a step of 1/rate does [1/s] */
  int statics; /* 0: leave out the geometric stiffness of edges under pressure, as steps do */
} sw_probe;

typedef struct sw_probe_result {
  size_t terms;    /* number of forces of this class on the wire */
  double energy;   /* [J] */
  double *force;   /* (nodes x 3), the caller's; or NULL [N] */
  double *product; /* (nodes x 3), the caller's; or NULL: stiffness times direction [N] */
} sw_probe_result;

/* Computes the effect of all forces of one class on a wire. Changes nothing. */
sw_status sw_scene_probe(sw_scene *scene, sw_handle wire, const sw_force_class *cls,
                         const sw_probe *at, sw_probe_result *out, sw_error *err);

#endif
