/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a strand is made. Of this room only. */
#ifndef SW_STRAND_MAKER_H
#define SW_STRAND_MAKER_H

#include "strand/strand.h"

typedef struct sw_strand_maker {
  const sw_strand_plan *plan;
  const sw_beam *beam;
  const sw_lattice *lattice;
  const sw_mesh *mesh;
  const double *k; /* of groups */
  const sw_strand_lie *lie;
  const unsigned char *ring; /* (mesh.n) 0: a single particle of a line; or NULL: all are rings */
  size_t *first;             /* (mesh.n + 1) particle that each begins with */
  uint32_t *around;          /* (around_count) of a section's surface, in their order */
  size_t around_count;
  double *warp; /* of a section by unit strains, see sw_cell_warp; or NULL */
  sw_web *web;  /* NULL while parts are only counted */
  sw_strand *strand;
  size_t links, folds, creases, solids, slides; /* so far */
} sw_strand_maker;

static inline int sw_strand_is_ring(const sw_strand_maker *m, size_t r) {
  return r < m->mesh->n && (!m->ring || m->ring[r]);
}
static inline int sw_strand_is_line(const sw_strand_maker *m, size_t r) {
  return r < m->mesh->n && m->ring && !m->ring[r];
}

/* Bending stiffness of a tube's wall along the wire, per length round it; 0: it has none [N m]. */
double sw_strand_wall_along(const sw_strand_plan *plan, const sw_beam *beam);

/* One more spring, or fold of rest angle rest [N/m], [m]; [N m], [rad]. */
void sw_strand_add_link(sw_strand_maker *m, size_t a, size_t b, double k, double rest);
void sw_strand_add_fold(sw_strand_maker *m, size_t a, size_t b, size_t c, double k, double rest);

/* Springs that join particle r of a line to its successor, and the bending there. */
void sw_strand_add_line(sw_strand_maker *m, size_t r);
/* Springs that join ring r to the line after it. */
void sw_strand_add_end(sw_strand_maker *m, size_t r);
/* Mass that ring or line number r has [kg]. */
double sw_strand_mass(const sw_strand_maker *m, size_t r);

/* Parts that slide on each other, between ring r and the next one. */
void sw_strand_add_slides(sw_strand_maker *m, size_t r);

/* Once the web has its sections: their faces. SW_ENOMEM. */
sw_status sw_strand_find_faces(sw_strand_maker *m);

/* The web of all this, its particles placed. SW_ENOMEM. */
sw_status sw_strand_fill(sw_strand_maker *m);

#endif
