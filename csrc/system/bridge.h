/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness between nodes that no wire connects: wires that touch, branches. While
 * there is any, the bodies it bridges are solved together; the others keep their bands. */
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
  sw_sparse_pair *known; /* bridges of the pattern: those planned, then what came besides */
  size_t known_count, known_capacity;
  sw_sparse_pair *planned, *taken; /* for the present step; for the pattern */
  size_t planned_count, planned_capacity, taken_count, taken_capacity;
  size_t from_plan; /* so many of those known are of the plan */
  int anew;         /* 1: a step was planned since the pattern was looked at */
  uint32_t *table;  /* hash: number in known + 1, 0 = empty */
  size_t table_capacity, table_size;
  uint32_t *number; /* (system's nodes) in the matrix, or NONE */
  size_t *first;    /* (bodies) first node in the matrix */
  size_t nodes;     /* of the matrix */
  size_t block;     /* unknowns a node: 3, or 4 with spins where a bridged body has frames */
  double *x;        /* (nodes x block) */
  size_t x_capacity;
  double *spans; /* work for twist */
  size_t span_capacity;
};

/* Make the matrix for this evaluation's bridges: the planned pattern, and what came besides. */
sw_status sw_bridges_prepare(sw_system *system);
/* Number of a bridge of nodes i < j in the pattern. */
uint32_t sw_bridges_find(const struct sw_bridges *bridges, uint32_t i, uint32_t j);

/* An evaluation begins: no bridges. */
void sw_bridges_begin(sw_system *system);

/* Any in this evaluation? */
int sw_bridges_any(const sw_system *system);

/* With rows and right hand sides (in delta) of all bodies assembled, held nodes taken
 * out: solve for the bridged bodies, twist included; marks them. Adds to negative. */
sw_status sw_bridges_solve(sw_system *system, size_t *negative);

/* By how much forces on nodes (nodes x 3) and spins (nodes) change the solution of the bridged
 * bodies, by the factors that there are; in place. */
void sw_bridges_solve_shift(sw_system *system, double *nodes, double *spins);

/* What the last update makes bridges pull at the held nodes, added to their reactions. */
void sw_bridges_react(sw_system *system);

void sw_bridges_free(sw_system *system);

#endif
