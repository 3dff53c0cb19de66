/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files that change a wire's model: the middle line that is carried over, and
 * momentum. */
#ifndef SW_REMODEL_LINE_H
#define SW_REMODEL_LINE_H

#include "body/region.h"
#include "scene/parts.h"
#include "state/mesh.h"

/* The middle line at equidistant or given arc lengths. */
typedef struct sw_line {
  size_t n;
  double length;               /* [m] */
  double start;                /* arc length of its first point in the mesh [m] */
  double *s, *tension;         /* (n) from the start [m], [N] */
  double *x, *v;               /* (n x 3) [m], [m/s] */
  double *frame;               /* (n x 6) tangent, direction across [-] */
  double *turn;                /* (n) twist since the start [rad] */
  double *strain;              /* (n x 4) of the beam, as a cell has them [-], [1/m] */
  const sw_stations *stations; /* which points are rings; n 0: all */
  void *block;
} sw_line;

/* Reads the line off a built wire at n points, with arc lengths at (n); at = NULL: equidistant. */
sw_status sw_line_read(sw_scene *scene, sw_handle wire, size_t n, const double *at, sw_line *out,
                       sw_error *err);
/* Turns all sections about the line so that their first direction across is `towards` at s. Returns
 * 0, and turns none, if the sine of the angle between `towards` and the line is `least` or less. */
int sw_line_face(sw_line *line, const sw_beam *beam, double s, sw_vec towards, double least);
void sw_line_free(sw_line *line);
/* Arc lengths of about `segments` even edges with nodes for the wire's living holds: out (count,
 * to be freed) [m]. SW_ENOMEM. */
sw_status sw_line_places(const sw_scene *scene, size_t wire, double length, size_t segments,
                         double **out, size_t *count);
/* Puts nodes on the line; for a rod also its twist, edge by edge. SW_ENOMEM. */
sw_status sw_line_mesh(const sw_scene_wire *wire, const sw_line *line, sw_mesh *out);
sw_status sw_line_twist(const sw_line *line, sw_scene_wire *out);
/* Sets the velocities v of the particles at x: sections turn with the line. */
void sw_line_spin(const sw_line *line, const sw_web *web, const double *x, double *v);

/* Momentum of a wire of a built scene, and its moment about the wire's centre of mass, which goes
 * to about [N s], [N m s]. */
void sw_momentum_of(const sw_scene *scene, size_t wire, sw_vec *about, double out[6]);
/* The same about a given point. */
void sw_momentum_about(const sw_scene *scene, size_t wire, sw_vec about, double out[6]);
/* Adds the smallest rigid motion that gives the built wire's free nodes the wanted momentum. */
sw_status sw_momentum_match(sw_scene *scene, size_t wire, sw_vec about, const double wanted[6]);
/* Writes the inertia forces of all wires at accelerations a (nodes x 3) to out [N]. */
void sw_inertia_of(const sw_system *system, const double *a, double *out);
double sw_scene_total_energy(sw_scene *scene, sw_error *err); /* [J] */

/* Replaces the wire by `with` and takes over its parts. The wire's living holds take hold of the
 * new wire, each at its present pose. The scene is not built. SW_ENOMEM. */
sw_status sw_scene_replace_wire(sw_scene *scene, size_t wire, sw_scene_wire *with, sw_error *err);

#endif
