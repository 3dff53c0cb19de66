/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What may be read of a scene: of its wires, its energy, its modes, its series. */
#ifndef SW_READ_READING_H
#define SW_READ_READING_H

#include "scene/scene.h"
#include "scene/values.h"

sw_status sw_scene_wire_length(sw_scene *scene, sw_handle wire, double *length, sw_error *err);
sw_status sw_scene_wire_nodes(sw_scene *scene, sw_handle wire, size_t *nodes, sw_error *err);
sw_status sw_scene_wire_beam(sw_scene *scene, sw_handle wire, sw_beam *out, sw_error *err);
sw_status sw_scene_wire_at(sw_scene *scene, sw_handle wire, double s, sw_point_state *out,
                           sw_error *err);
/* Node positions (n x 3) and arc lengths (n); each may be NULL. */
sw_status sw_scene_wire_copy(sw_scene *scene, sw_handle wire, double *positions, double *s,
                             double *velocities, sw_error *err);
/* All particles of a wire that is a mesh, ring by ring; of any other its nodes. */
sw_status sw_scene_wire_particles(sw_scene *scene, sw_handle wire, size_t *particles,
                                  sw_error *err);
sw_status sw_scene_wire_particle_copy(sw_scene *scene, sw_handle body, double *positions, double *s,
                                      double *velocities, sw_error *err);
/* Give every node a velocity: linear field v + omega x (x - about). */
sw_status sw_scene_wire_set_velocity(sw_scene *scene, sw_handle wire, sw_vec v, sw_vec omega,
                                     sw_vec about, sw_error *err);
sw_status sw_scene_wire_extremes(sw_scene *scene, sw_handle wire, sw_wire_extremes *now,
                                 sw_wire_extremes *run, sw_error *err);

/* --- what else may be asked ---------------------------------------------------------- */

typedef struct sw_modes_args {
  long modes;       /* how many [-] */
  double tolerance; /* how far from rest the wire may be, of its length [-] */
  int shapes;       /* wanted? */
  int alone;        /* do wires that are joined to it stay where they are? */
} sw_modes_args;
extern const sw_params sw_modes_params;

typedef struct sw_modes_result {
  size_t count;        /* frequencies found [-] */
  size_t unstable;     /* motions that grow instead [-] */
  double growth;       /* of the fastest of those [1/s] */
  double *frequencies; /* (modes), the caller's [Hz] */
  double *shapes;      /* (modes x nodes x 3), the caller's, or NULL [1/sqrt(kg)] */
} sw_modes_result;

/* Lowest natural frequencies of one wire about the present equilibrium, all else
 * held as it is. Changes nothing. SW_EINVAL when the wire is not at rest. */
sw_status sw_scene_wire_modes(sw_scene *scene, sw_handle wire, const sw_modes_args *args,
                              int (*interrupted)(void), sw_modes_result *out, sw_error *err);

/* Kinetic, contact, repel, join, and of each class of force its own and what it corrects. */
enum { SW_ENERGY_KINDS = 4 + 2 * SW_FORCE_CLASSES };
typedef struct sw_energy {
  size_t count;
  const char *kind[SW_ENERGY_KINDS];
  double value[SW_ENERGY_KINDS]; /* [J] */
  double dissipated;             /* by forces with a history so far, not stored [J] */
  int has_dissipated;            /* there are such forces */
} sw_energy;
sw_status sw_scene_energy(sw_scene *scene, sw_energy *out, sw_error *err);
/* The same of one wire or object of particles alone. */
sw_status sw_scene_body_energy(sw_scene *scene, sw_handle body, sw_energy *out, sw_error *err);

/* Deepest penetration of a wire's surface into an obstacle now and since the
 * last run began [m]. */
sw_status sw_scene_penetration(sw_scene *scene, double *now, sw_extreme *deepest, sw_error *err);
/* Number of contact points with a force now. */
size_t sw_scene_touches(sw_scene *scene);

/* Where a force is asked; NULL = the scene's own state. Arrays are (nodes x 3). */
typedef struct sw_probe {
  const double *positions;  /* [m] */
  const double *velocities; /* [m/s] */
  const double *direction;  /* to be multiplied by the stiffness; NULL = no product [m] */
  double rate; /* adds rate times the damping to the stiffness, as a step of 1/rate does [1/s] */
  int statics; /* 0: leave out the geometric stiffness of edges under pressure, as steps do */
} sw_probe;

typedef struct sw_probe_result {
  size_t terms;    /* forces of this kind on the wire */
  double energy;   /* [J] */
  double *force;   /* (nodes x 3), the caller's; or NULL [N] */
  double *product; /* (nodes x 3), the caller's; or NULL: stiffness times direction [N] */
} sw_probe_result;

/* What all forces of one class do to a wire. Changes nothing. */
sw_status sw_scene_probe(sw_scene *scene, sw_handle wire, const sw_force_class *cls,
                         const sw_probe *at, sw_probe_result *out, sw_error *err);

#endif
