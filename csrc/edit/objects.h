/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Objects of particles that are not wires: fabric, foam, nets, chains. */
#ifndef SW_EDIT_OBJECTS_H
#define SW_EDIT_OBJECTS_H

#include "scene/scene.h"

typedef struct sw_particles_args {
  char name[SW_NAME_SIZE];
  double radius; /* distance of the surface from particles and its edges; NAN = chosen [m] */
} sw_particles_args;
extern const sw_params sw_particles_params;

/* Particles that push each other apart when nearer than a distance. */
typedef struct sw_repel_pairs {
  double distance;  /* [m] */
  double stiffness; /* force over the missing distance; 0 = none [N/m] */
} sw_repel_pairs;
extern const sw_params sw_repel_pairs_params;

enum { SW_ELEMENT_NODES = 8 };
typedef struct sw_particles_element {
  uint32_t count; /* 6: a prism, 8: a hexahedron; see force/solid.h [-] */
  uint32_t node[SW_ELEMENT_NODES];
  double mu, lambda; /* [Pa] */
} sw_particles_element;

typedef struct sw_particles_link {
  uint32_t a, b;
  double k;         /* [N/m] */
  double rest;      /* unstressed length; NAN = as it lies [m] */
  double yield;     /* strain at which it yields; NAN = never [-] */
  double hardening; /* gain of the yield force per plastic elongation, over k [-] */
} sw_particles_link;

typedef struct sw_particles_fold {
  uint32_t a, b, c; /* straight at rest */
  double stiffness; /* moment per angle [N m] */
} sw_particles_fold;

/* Surface that touches obstacles. */
enum {
  SW_SURFACE_USUAL, /* the links, or the boundary of the elements where there are any */
  SW_SURFACE_PARTICLES,
  SW_SURFACE_EDGES /* as given */
};

/* The parts of an object; particle numbers count from 0. */
typedef struct sw_particles_parts {
  size_t count;
  const double *positions; /* (count x 3) [m] */
  const double *masses;    /* (count) [kg] */
  const sw_particles_link *link;
  size_t links;
  const sw_particles_fold *fold;
  size_t folds;
  const sw_particles_element *element;
  size_t elements;
  int surface;
  const uint32_t *edge; /* (edges x 2) */
  size_t edges;
  sw_repel_pairs repel;
} sw_particles_parts;

/* Adds an object of particles. Copies the parts. Errors number particles and parts from 1. */
sw_status sw_scene_add_particles(sw_scene *scene, const sw_particles_args *args,
                                 const sw_particles_parts *parts, sw_handle *out, sw_error *err);
typedef struct sw_particles_info {
  size_t particles, links, folds, elements; /* [-] */
  double mass, radius;                      /* [kg], [m] */
} sw_particles_info;
sw_status sw_scene_particles_info(sw_scene *scene, sw_handle object, sw_particles_info *out,
                                  sw_error *err);
/* Place and velocity of one particle [m], [m/s]; of all: sw_scene_wire_particle_copy. */
sw_status sw_scene_particle(sw_scene *scene, sw_handle object, size_t particle, sw_vec *position,
                            sw_vec *velocity, sw_error *err);
/* velocities (particles x 3); held particles keep theirs [m/s]. */
sw_status sw_scene_particles_set_velocities(sw_scene *scene, sw_handle object,
                                            const double *velocities, sw_error *err);
/* Writes the edges of the surface as pairs of particles (2 x count), unless pairs is NULL; returns
 * count. */
size_t sw_scene_particles_edges(const sw_scene *scene, sw_handle object, uint32_t *pairs);
/* For all links: pulling force [N], elongation over rest length [-], its plastic part [-]; each may
 * be NULL. */
sw_status sw_scene_particles_links(sw_scene *scene, sw_handle object, double *force, double *strain,
                                   double *plastic, sw_error *err);

/* Holds some particles rigidly. They move with the hold's pose, which begins at `at` (NAN: their
 * middle) with the world's axes. */
sw_status sw_scene_hold_particles(sw_scene *scene, sw_handle object, const char *name,
                                  const uint32_t *particles, size_t count, sw_vec at,
                                  sw_handle *out, sw_error *err);

#endif
