/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric matrices of square blocks with any pattern: chains of nodes that are coupled to one
 * another, by contact or at branches. Factorised without pivoting as L D L' in an order that keeps
 * L sparse; the signs of the pivots count negative directions. The pattern is analysed once; values
 * are set anew each time. */
#ifndef SW_SOLVE_SPARSE_H
#define SW_SOLVE_SPARSE_H

#include <stddef.h>
#include <stdint.h>

#include "base/couple.h"
#include "base/status.h"

typedef struct sw_sparse sw_sparse;

enum { SW_SPARSE_BLOCK_MAX = 4 };

/* Makes a matrix of nodes x nodes blocks of block x block values (3 or 4), zero except for the
 * diagonal and the given pairs, which may repeat. old: NULL, or a matrix of the same block with
 * some pairs fewer: it saves part of the search for an order, the new one takes over its work
 * space, and it may only be freed then. SW_ENOMEM. */
sw_status sw_sparse_new(size_t nodes, size_t block, const sw_couple *pairs, size_t count,
                        sw_sparse *old, sw_sparse **out);
/* A matrix that is made with this one as `old` will take over its work space only. */
void sw_sparse_forget_order(sw_sparse *sparse);
void sw_sparse_free(sw_sparse *sparse); /* NULL is allowed */

/* Sets all values to zero. */
void sw_sparse_clear(sw_sparse *sparse);

/* Returns where to add the values of a node's own block (block x block, row by row). */
double *sw_sparse_own(sw_sparse *sparse, size_t node);

/* Adds a block, row by row with i's rows, to pair number k of the list. */
void sw_sparse_add(sw_sparse *sparse, size_t pair, const double *values);

/* Factorises in place. negative (may be NULL) receives the number of negative pivots. SW_ESINGULAR
 * if a pivot block vanishes or is not finite. */
sw_status sw_sparse_factor(sw_sparse *sparse, size_t *negative);

/* Solves in place for b (nodes x block). */
void sw_sparse_solve(sw_sparse *sparse, double *b);
/* The same for two right-hand sides at once, in little more time than for one; other may be NULL.
 */
void sw_sparse_solve_two(sw_sparse *sparse, double *one, double *other);

/* Returns the number of blocks below the diagonal of the factor. */
size_t sw_sparse_fill(const sw_sparse *sparse);

#endif
