/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Factors of sparse symmetric matrices of 3 x 3 blocks, L' D L without pivoting, by dense fronts
 * (Duff and Reid 1983). A front is the sum of its part of the matrix and of the remainders of its
 * children, which are eliminated earlier. It eliminates its own nodes and passes the rest to its
 * parent. Nodes are numbered from the last one eliminated to the first. */
#ifndef SW_SOLVE_BLOCKS_TREE_H
#define SW_SOLVE_BLOCKS_TREE_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

typedef struct sw_tree sw_tree;

/* Makes a tree. Node i has the blocks first[i] .. first[i + 1] - 1, with ascending columns
 * column[..], its own block last. Both lists must outlive the tree. order: of the elimination, or
 * NULL. old: NULL, or a tree whose work space it takes over; old may only be freed then. SW_ENOMEM,
 * SW_ELIMIT. */
sw_status sw_tree_new(size_t nodes, const uint32_t *first, const uint32_t *column,
                      const int32_t *order, sw_tree *old, sw_tree **out);
void sw_tree_free(sw_tree *tree); /* NULL is allowed */

/* values: 9 per block, row by row. Otherwise like sw_blocks_factor. */
sw_status sw_tree_factor(sw_tree *tree, const double *values, const unsigned char *fixed,
                         size_t *negative);

/* Returns about how many products a factorisation needs [-]. */
double sw_tree_work(const sw_tree *tree);

/* Solves in place for x (nodes x 3). */
void sw_tree_solve(const sw_tree *tree, double *x);

#endif
