/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric matrices of 3 x 3 blocks between nodes, for meshes of particles. One interface, two
 * kinds: nodes in rings, coupled to their own and the neighbouring rings, and nodes in any pattern.
 * Factorised as L' D L without pivoting, so that the signs of pivots count negative directions. The
 * pattern is fixed; values are set anew each time and survive factoring. A matrix owns work space:
 * one thread at a time. */
#ifndef SW_SOLVE_BLOCKS_H
#define SW_SOLVE_BLOCKS_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

typedef struct sw_blocks sw_blocks;

/* Nodes i and j, i != j, whose block is not zero. */
typedef struct sw_blocks_pair {
  uint32_t i, j;
} sw_blocks_pair;

/* Node n = ring * per_ring + place. Blocks exist between all nodes of the same ring and of
 * neighbouring rings. SW_EINVAL for no nodes, SW_ENOMEM. */
sw_status sw_blocks_new_rings(size_t rings, size_t per_ring, sw_blocks **out);

/* Blocks exist for the nodes themselves and for these pairs, which may repeat. order (nodes): in
 * which nodes are eliminated, NULL: one that is found. SW_EINVAL for no nodes or a pair that is
 * none, SW_ELIMIT for too many, SW_ENOMEM. */
sw_status sw_blocks_new_sparse(size_t nodes, const sw_blocks_pair *pairs, size_t count,
                               const int32_t *order, sw_blocks **out);
void sw_blocks_free(sw_blocks *blocks); /* NULL is allowed */

size_t sw_blocks_nodes(const sw_blocks *blocks);

/* Where values are added; the address stays for the life of the matrix. */
double *sw_blocks_values(sw_blocks *blocks);

/* From one row of a block to the next [doubles]. */
size_t sw_blocks_stride(const sw_blocks *blocks);

/* Start of the block of node i's rows and node j's columns in the values, i >= j; SIZE_MAX: there
 * is none. Only the lower half of a node's own block (i == j) is read; it may be written whole. */
size_t sw_blocks_slot(const sw_blocks *blocks, size_t i, size_t j);

/* All values to zero. */
void sw_blocks_clear(sw_blocks *blocks);

/* Factorise; values stay as they are. fixed (nodes, or NULL): 1 takes a node's unknowns out, by
 * rows and columns of the identity in the factor. negative (may be NULL) receives the number of
 * negative pivots. SW_ESINGULAR when a pivot vanishes or is not finite, SW_ENOMEM. */
sw_status sw_blocks_factor(sw_blocks *blocks, const unsigned char *fixed, size_t *negative);

/* Solve in place for x (nodes x 3), after sw_blocks_factor gave SW_OK. Values at fixed nodes
 * must be 0, and stay 0. */
void sw_blocks_solve(const sw_blocks *blocks, double *x);

/* y = values times x, fixed nodes like all others; y is not x. */
void sw_blocks_multiply(const sw_blocks *blocks, const double *x, double *y);

/* y = one node's rows of the values, times x (nodes x 3). */
void sw_blocks_row_times(const sw_blocks *blocks, size_t node, const double *x, double y[3]);

#endif
