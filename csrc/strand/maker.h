/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a strand is made. Private to this room. */
#ifndef SW_STRAND_MAKER_H
#define SW_STRAND_MAKER_H

#include "strand/strand.h"

typedef struct sw_strand_maker {
  const sw_strand_plan *plan;
  const sw_beam *beam;
  const sw_lattice *lattice;
  const sw_mesh *mesh;
  const double *k; /* stiffness of each group of links or solids */
  const sw_strand_lie *lie;
  const unsigned char *ring; /* (mesh.n) 0: a single particle of a line; or NULL: all are rings */
  size_t *first;             /* (mesh.n + 1) first particle of each ring or line particle */
  uint32_t *around;          /* (around_count) particles of a section's surface, in order */
  size_t around_count;
  double *warp; /* section's displacements under unit strains, see sw_cell_warp; or NULL */
  sw_web *web;  /* NULL while parts are only counted */
  sw_strand *strand;
  size_t links, folds, creases, solids, slides; /* counted so far */
} sw_strand_maker;

static inline int sw_strand_is_ring(const sw_strand_maker *m, size_t r) {
  return r < m->mesh->n && (!m->ring || m->ring[r]);
}
static inline int sw_strand_is_line(const sw_strand_maker *m, size_t r) {
  return r < m->mesh->n && m->ring && !m->ring[r];
}

/* Returns the bending stiffness along the wire of a tube's wall, per length round it; 0: none
 * [N m]. */
double sw_strand_wall_along(const sw_strand_plan *plan, const sw_beam *beam);

/* Adds a spring of stiffness k [N/m] and rest length [m], or a fold of stiffness k [N m] and rest
 * angle [rad]. */
void sw_strand_add_link(sw_strand_maker *m, size_t a, size_t b, double k, double rest);
void sw_strand_add_fold(sw_strand_maker *m, size_t a, size_t b, size_t c, double k, double rest);

/* Adds the springs from particle r of a line to its successor, and the bending there. */
void sw_strand_add_line(sw_strand_maker *m, size_t r);
/* Adds the springs from ring r to the line after it. */
void sw_strand_add_end(sw_strand_maker *m, size_t r);
/* Returns the mass of ring or line particle r [kg]. */
double sw_strand_mass(const sw_strand_maker *m, size_t r);

/* Adds the elements of parts that slide on each other, between ring r and the next. */
void sw_strand_add_slides(sw_strand_maker *m, size_t r);

/* Finds the faces of the web's sections, once these are known. SW_ENOMEM. */
sw_status sw_strand_find_faces(sw_strand_maker *m);

/* Makes the whole web, once its particles are placed. SW_ENOMEM. */
sw_status sw_strand_fill(sw_strand_maker *m);

#endif
