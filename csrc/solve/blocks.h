/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric matrices of 3 x 3 blocks between nodes, for meshes of particles. One interface for two
 * kinds: nodes in rings, coupled within their ring and to the neighbouring rings, and nodes with
 * any pattern. Factorised as L' D L without pivoting, so that the signs of pivots count negative
 * directions. The pattern is fixed; values are set anew each time and survive factorising. A matrix
 * owns its work space: only one thread at a time may use it. */
#ifndef SW_SOLVE_BLOCKS_H
#define SW_SOLVE_BLOCKS_H

#include <stddef.h>
#include <stdint.h>

#include "base/couple.h"
#include "base/status.h"

typedef struct sw_blocks sw_blocks;

/* Makes a matrix of rings: node n = ring * per_ring + place. Blocks exist between all nodes of the
 * same ring and of neighbouring rings. SW_EINVAL for no nodes, SW_ENOMEM. */
sw_status sw_blocks_new_rings(size_t rings, size_t per_ring, sw_blocks **out);

/* Makes a matrix with blocks for the nodes themselves and for these pairs, which may repeat. order
 * (nodes): of the elimination; NULL: an order is found. old: NULL, or a matrix whose work space it
 * takes over; old may only be freed then. SW_EINVAL for no nodes or an invalid pair,
 * SW_ELIMIT for too many, SW_ENOMEM. */
sw_status sw_blocks_new_sparse(size_t nodes, const sw_couple *pairs, size_t count,
                               const int32_t *order, sw_blocks *old, sw_blocks **out);
void sw_blocks_free(sw_blocks *blocks); /* NULL is allowed */

size_t sw_blocks_nodes(const sw_blocks *blocks);

/* Returns the array to which values are added; its address stays for the life of the matrix. */
double *sw_blocks_values(sw_blocks *blocks);

/* Distance from one row of a block to the next [doubles]. */
size_t sw_blocks_stride(const sw_blocks *blocks);

/* Returns where the block with node i's rows and node j's columns begins in the values, i >= j;
 * SIZE_MAX if there is none. Only the lower half of a node's own block (i == j) is read; all of it
 * may be written. */
size_t sw_blocks_slot(const sw_blocks *blocks, size_t i, size_t j);

/* Sets all values to zero. */
void sw_blocks_clear(sw_blocks *blocks);

/* Factorises; values stay as they are. fixed (nodes, or NULL): 1 takes a node's unknowns out, by
 * rows and columns of the identity in the factor. negative (may be NULL) receives the number of
 * negative pivots. SW_ESINGULAR if a pivot vanishes or is not finite, SW_ENOMEM. */
sw_status sw_blocks_factor(sw_blocks *blocks, const unsigned char *fixed, size_t *negative);

/* Returns about how many products a factorisation needs [-]; the second one before a matrix of
 * rings is made. */
double sw_blocks_work(const sw_blocks *blocks);
double sw_blocks_rings_work(size_t rings, size_t per_ring);

/* Solves in place for x (nodes x 3), after sw_blocks_factor returned SW_OK. Values at fixed nodes
 * must be 0, and stay 0. */
void sw_blocks_solve(const sw_blocks *blocks, double *x);

/* y = values times x, with fixed nodes treated like all others; y must not be x. */
void sw_blocks_multiply(const sw_blocks *blocks, const double *x, double *y);

/* y = one node's rows of the values times x (nodes x 3). */
void sw_blocks_row_times(const sw_blocks *blocks, size_t node, const double *x, double y[3]);

#endif
