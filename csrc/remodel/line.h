/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Of the files that change a wire's model: the middle line that goes over, and momentum. */
#ifndef SW_REMODEL_LINE_H
#define SW_REMODEL_LINE_H

#include "body/region.h"
#include "scene/parts.h"
#include "state/mesh.h"

/* The middle line at even arc lengths, or at given ones. */
typedef struct sw_line {
  size_t n;
  double length;               /* [m] */
  double start;                /* arc length of the first one in the mesh [m] */
  double *s, *tension;         /* (n) from the start [m], [N] */
  double *x, *v;               /* (n x 3) [m], [m/s] */
  double *frame;               /* (n x 6) tangent, direction across [-] */
  double *turn;                /* (n) twist since the start [rad] */
  double *strain;              /* (n x 4) of the beam, as a cell has them [-], [1/m] */
  const sw_stations *stations; /* which of them are rings; n 0: all */
  void *block;
} sw_line;

/* Read it off a built wire: so many nodes, at arc lengths at (n) or NULL: even ones. */
sw_status sw_line_read(sw_scene *scene, sw_handle wire, size_t n, const double *at, sw_line *out,
                       sw_error *err);
void sw_line_free(sw_line *line);
/* Nodes on the line; of a rod also its twist, by parts. SW_ENOMEM. */
sw_status sw_line_mesh(const sw_scene_wire *wire, const sw_line *line, sw_mesh *out);
sw_status sw_line_twist(const sw_line *line, sw_scene_wire *out);
/* Sections turn with the line: the velocities of their particles at x. */
void sw_line_spin(const sw_line *line, const sw_web *web, const double *x, double *v);

/* Momentum of a wire of a built scene, and its moment about its centre of mass [N s], [N m s]. */
void sw_momentum_of(const sw_scene *scene, size_t wire, sw_vec *about, double out[6]);
/* The same about a point. */
void sw_momentum_about(const sw_scene *scene, size_t wire, sw_vec about, double out[6]);
/* Give the free nodes of the built wire the momentum wanted, by the smallest rigid motion. */
sw_status sw_momentum_match(sw_scene *scene, size_t wire, sw_vec about, const double wanted[6]);
/* Forces of inertia of all wires that go with accelerations a (nodes x 3), into out [N]. */
void sw_inertia_of(const sw_system *system, const double *a, double *out);
double sw_scene_total_energy(sw_scene *scene, sw_error *err); /* [J] */

/* Replace the wire by `with`, whose parts it takes over. Its living holds take hold of the new
 * wire, each at its present pose. The scene is not built. SW_ENOMEM. */
sw_status sw_scene_replace_wire(sw_scene *scene, size_t wire, sw_scene_wire *with, sw_error *err);

#endif
