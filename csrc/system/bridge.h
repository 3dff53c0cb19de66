/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness between nodes that no wire connects: of wires that touch, and of branches. Bodies with
 * bridges are solved together; the others keep their bands. */
#ifndef SW_SYSTEM_BRIDGE_H
#define SW_SYSTEM_BRIDGE_H

#include <stdint.h>

#include "solve/sparse.h"
#include "system/system.h"

/* One block, rows of node i, columns of node j, i < j. */
typedef struct sw_bridge {
  uint32_t i, j; /* in the system's arrays */
  double k[9];   /* [N/m] */
} sw_bridge;

struct sw_bridges {
  sw_bridge *list; /* of this evaluation */
  size_t count, capacity;

  /* the pattern: what the sparse matrix was analysed for */
  sw_sparse *matrix;
  sw_sparse_pair *pairs; /* of the bodies' chains, then bridges; in the matrix' numbers */
  size_t pair_capacity, chain_pairs, pair_count;
  sw_sparse_pair *known; /* bridges of the pattern: planned ones, then those added in the step */
  size_t known_count, known_capacity;
  sw_sparse_pair *planned, *taken; /* for the present step; for the pattern */
  size_t planned_count, planned_capacity, taken_count, taken_capacity;
  size_t from_plan; /* number of planned ones among them */
  int anew;         /* 1: a plan was made after the pattern */
  uint32_t *table;  /* hash: number in known + 1, 0 = empty */
  size_t table_capacity, table_size;
  uint32_t *number;  /* (system's nodes) in the matrix, or NONE */
  size_t *first;     /* (bodies) first node in the matrix */
  size_t nodes;      /* of the matrix */
  size_t block;      /* unknowns a node: 3, or 4 with spins where a bridged body has frames */
  double *x, *right; /* (nodes x block); the right-hand sides of the last solution, summed up */
  size_t x_capacity, right_capacity;
  double *spans; /* work for twist */
  size_t span_capacity;
};

/* Make the matrix for this evaluation's bridges: the planned pattern and the added pairs. */
sw_status sw_bridges_prepare(sw_system *system);
/* Number of a bridge of nodes i < j in the pattern. */
uint32_t sw_bridges_find(const struct sw_bridges *bridges, uint32_t i, uint32_t j);

/* An evaluation begins: no bridges. */
void sw_bridges_begin(sw_system *system);

/* Any in this evaluation? */
int sw_bridges_any(const sw_system *system);

/* Solve for the bridged bodies, with twist, and mark them. Rows and right-hand sides (in delta) of
 * all bodies are assembled, held nodes are out. Adds to negative. */
sw_status sw_bridges_solve(sw_system *system, size_t *negative);

/* Change of the bridged bodies' solution by forces on nodes (nodes x 3) and spins (nodes), with the
 * present factors; in place. */
void sw_bridges_solve_shift(sw_system *system, double *nodes, double *spins);

/* Add the bridges' pull by the last update to the reactions of held nodes. */
void sw_bridges_react(sw_system *system);

void sw_bridges_free(sw_system *system);

#endif
