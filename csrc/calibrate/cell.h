/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beam that an endless mesh of springs and solid elements is: one slice of particles that
 * repeats along z, its springs to its own slice and the next ones, its elements between its own
 * slice and the next, and the exact stiffness of the whole against stretch, bending and twist. */
#ifndef SW_CALIBRATE_CELL_H
#define SW_CALIBRATE_CELL_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

/* A spring between particle from of a slice and particle to of the slice number `slices`
 * further on, or, with bend, one against the angle at particle from in its line of particles
 * along z (slices = 1, to = from). */
typedef struct sw_cell_link {
  uint32_t from, to;
  uint32_t group;
  int slices;    /* 0: its own slice [-] */
  int bend;      /* [-] */
  double weight; /* its stiffness is weight times the group's [-] */
} sw_cell_link;

/* A solid element: its first nodes / 2 particles are of a slice, anticlockwise seen from the
 * next one; the others, of the next slice, stand for the same corners. */
typedef struct sw_cell_solid {
  int nodes;            /* 6 or 8 [-] */
  uint32_t particle[8]; /* by the numbers of one slice */
  uint32_t group;       /* k of it is the modulus [Pa] */
  double nu;            /* Poisson's ratio [-] */
} sw_cell_solid;

/* The caller's arrays. */
typedef struct sw_cell {
  double spacing; /* of slices along z [m] */
  size_t particles, links, groups;
  const double *at; /* x, y, z of each particle of slice 0 [m] */
  const sw_cell_link *link;
  size_t solids;
  const sw_cell_solid *solid;
} sw_cell;

enum { SW_CELL_PARTICLES = 512 }; /* most of one slice [-] */

/* Strains of the beam, the order of rows of its stiffness. A curvature about x bends in the
 * plane of y and z. */
enum { SW_CELL_STRETCH, SW_CELL_ABOUT_X, SW_CELL_ABOUT_Y, SW_CELL_TWIST, SW_CELL_STRAINS };
enum { SW_CELL_SIZE = SW_CELL_STRAINS * SW_CELL_STRAINS };

typedef struct sw_cell_result {
  double S[SW_CELL_SIZE]; /* EA, EI, EI, GJ and couplings [N, N m, N m2] */
  double squeeze; /* line force over approach of two plates at the least and largest x, strains
                   * of the beam held at 0; 0 when the section flattens freely [Pa] */
} sw_cell_result;

/* k: stiffness of each group [N/m; of bending N m; of elements Pa], none below 0. parts (may be
 * NULL): for each group SW_CELL_SIZE + 1 numbers, its share of every entry of S and of the
 * compliance under the plates (as a share of the whole): the derivatives by log k of S, and of log
 * squeeze. Couplings by which the section is free to go are relaxed; the beam's axis is z whether
 * it is the neutral line or not. SW_EINVAL, SW_ENOMEM, SW_ESINGULAR. */
sw_status sw_cell_stiffness(const sw_cell *cell, const double *k, sw_cell_result *out,
                            double *parts, sw_error *err);

/* How a section gives way to unit strains of the beam, without shift and turn of the whole: warp,
 * SW_CELL_STRAINS times (particles x 3) [m per strain: m, m2, m2, m2]. share (particles): of the
 * slice's mass. Statuses as above. */
sw_status sw_cell_warp(const sw_cell *cell, const double *k, const double *share, double *warp,
                       sw_error *err);

/* The same with every particle moving with its section, which stays plane and keeps its shape:
 * an upper bound, linear in k. Only S, and of the parts only those of S. */
void sw_cell_affine(const sw_cell *cell, const double *k, double S[SW_CELL_SIZE], double *parts);

/* Length of a spring [m]. */
double sw_cell_length(const sw_cell *cell, const sw_cell_link *link);

#endif
