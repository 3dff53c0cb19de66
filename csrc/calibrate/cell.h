/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beam stiffness of an endless mesh of springs and solid elements. The mesh is one slice of
 * particles repeated along z, with springs within the slice and to later ones and elements to the
 * next slice. Stiffness against stretch, bending and twist is exact. */
#ifndef SW_CALIBRATE_CELL_H
#define SW_CALIBRATE_CELL_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

/* A spring between particle `from` of a slice and particle `to` of the slice number `slices`
 * further on. With bend: a spring against the angle at particle `from` in its line of particles
 * along z (slices = 1, to = from). */
typedef struct sw_cell_link {
  uint32_t from, to;
  uint32_t group;
  int slices;    /* 0: the same slice [-] */
  int bend;      /* [-] */
  double weight; /* its stiffness over the group's [-] */
} sw_cell_link;

/* A solid element. The first nodes / 2 particles belong to a slice, anticlockwise seen from the
 * next slice; the others are the same corners in the next slice. */
typedef struct sw_cell_solid {
  int nodes;            /* 6 or 8 [-] */
  uint32_t particle[8]; /* numbers within one slice */
  uint32_t group;       /* its k is the modulus [Pa] */
  double nu;            /* Poisson's ratio [-] */
} sw_cell_solid;

/* A slice. The arrays belong to the caller. */
typedef struct sw_cell {
  double spacing; /* of slices along z [m] */
  size_t particles, links, groups;
  const double *at; /* x, y, z of each particle of slice 0 [m] */
  const sw_cell_link *link;
  size_t solids;
  const sw_cell_solid *solid;
} sw_cell;

enum { SW_CELL_PARTICLES = 512 }; /* most in one slice [-] */

/* Strains of the beam, in the order of the stiffness rows. A curvature about x bends in the plane
 * of y and z. */
enum { SW_CELL_STRETCH, SW_CELL_ABOUT_X, SW_CELL_ABOUT_Y, SW_CELL_TWIST, SW_CELL_STRAINS };
enum { SW_CELL_SIZE = SW_CELL_STRAINS * SW_CELL_STRAINS };

typedef struct sw_cell_result {
  double S[SW_CELL_SIZE]; /* EA, EI, EI, GJ and couplings [N, N m, N m2] */
  double squeeze; /* line force over approach of two plates at the least and largest x, with the
                   * beam's strains held at 0; 0 if the section flattens freely [Pa] */
} sw_cell_result;

/* Computes the beam stiffness. k: stiffness of each group [N/m; of bending N m; of elements Pa],
 * none below 0. parts (may be NULL): SW_CELL_SIZE + 1 numbers per group, its share of every entry
 * of S and of the compliance under the plates (as a share of the whole). These are the derivatives
 * of S and of log squeeze by log k. Displacements of the section are relaxed (least energy). The
 * beam's axis is z, whether or not it is the neutral line. SW_EINVAL, SW_ENOMEM, SW_ESINGULAR. */
sw_status sw_cell_stiffness(const sw_cell *cell, const double *k, sw_cell_result *out,
                            double *parts, sw_error *err);

/* Computes a section's displacements under unit strains of the beam, without rigid shift and turn:
 * warp, SW_CELL_STRAINS times (particles x 3) [m per strain: m, m2, m2, m2]. share (particles):
 * each particle's share of the slice's mass. Statuses as above. */
sw_status sw_cell_warp(const sw_cell *cell, const double *k, const double *share, double *warp,
                       sw_error *err);

/* Computes S for sections that stay plane and keep their shape: an upper bound, linear in k. Fills
 * only S, and of parts only the shares of S. */
void sw_cell_affine(const sw_cell *cell, const double *k, double S[SW_CELL_SIZE], double *parts);

/* Returns the length of a spring [m]. */
double sw_cell_length(const sw_cell *cell, const sw_cell_link *link);

#endif
