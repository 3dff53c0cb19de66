/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness between nodes that are not neighbours in a wire: of touching wires and of branches.
 * Bodies with bridges are solved together in one sparse matrix; the others keep their bands. */
#ifndef SW_SYSTEM_BRIDGE_H
#define SW_SYSTEM_BRIDGE_H

#include <stdint.h>

#include "solve/sparse.h"
#include "system/system.h"

/* One block: rows of node i, columns of node j, i < j. */
typedef struct sw_bridge {
  uint32_t i, j;   /* in the system's arrays */
  double k[9];     /* [N/m] */
  uint32_t number; /* of its pair in the pattern, once that is prepared */
} sw_bridge;

struct sw_bridges {
  sw_bridge *list; /* of this evaluation */
  size_t count, capacity;

  /* pattern for which the sparse matrix was analysed */
  sw_sparse *matrix, *spare; /* spare: of an earlier plan, kept for its work space */
  sw_couple *pairs; /* of the bodies' chains, then of the bridges; in the matrix's numbers */
  size_t pair_capacity, chain_pairs, pair_count;
  sw_couple *known; /* bridges of the pattern: planned ones, then those added in the step */
  size_t known_count, known_capacity;
  sw_couple *planned, *taken; /* for the present step; those in the pattern */
  size_t planned_count, planned_capacity, taken_count, taken_capacity;
  size_t from_plan; /* number of planned ones in known */
  int anew;         /* 1: a plan was made after the pattern */
  uint32_t *table;  /* hash: number in known + 1, 0 = empty */
  size_t table_capacity, table_size;
  uint32_t *number;  /* (system's nodes) in the matrix, or NONE */
  size_t *first;     /* (bodies) first node in the matrix */
  size_t nodes;      /* of the matrix */
  size_t block;      /* unknowns per node: 3, or 4 with spins if a bridged body has frames */
  double *x, *right; /* (nodes x block); right: sum of the right-hand sides of the last solution */
  size_t x_capacity, right_capacity;
  double *spans; /* work space for twist */
  size_t span_capacity;
};

/* Makes the matrix for this evaluation's bridges: the planned pattern plus any pairs added. */
sw_status sw_bridges_prepare(sw_system *system);

/* Begins an evaluation, with no bridges. */
void sw_bridges_begin(sw_system *system);

/* 1 if this evaluation has bridges. */
int sw_bridges_any(const sw_system *system);

/* Solves for the bridged bodies, with twist, and marks them. Input: rows and right-hand sides (in
 * delta) of all bodies, without held nodes. Adds to negative. */
sw_status sw_bridges_solve(sw_system *system, size_t *negative);

/* In place: turns forces on nodes (nodes x 3) and spins (nodes) into the change of the bridged
 * bodies' solution by these forces, with the present factors. */
void sw_bridges_solve_shift(sw_system *system, double *nodes, double *spins);

/* Adds the bridges' forces from the last update to the reactions of held nodes. */
void sw_bridges_react(sw_system *system);

void sw_bridges_free(sw_system *system);

#endif
