/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric matrices of 3 x 3 blocks with any pattern, as in solve/blocks.h. Stores the blocks of
 * the lower half row by row, with ascending columns. */
#ifndef SW_SOLVE_BLOCKS_SPARSE_H
#define SW_SOLVE_BLOCKS_SPARSE_H

#include <stddef.h>
#include <stdint.h>

#include "solve/blocks.h"
#include "solve/numbers.h"

typedef struct sw_tree sw_tree;

typedef struct sw_blocks_sparse {
  size_t nodes;
  uint32_t *first;   /* (nodes + 1) a node's first block; its own block is the last one */
  uint32_t *column;  /* (blocks) nodes, ascending in each row */
  uint32_t *under;   /* (nodes + 1) index in below of a node's first block in later rows */
  uint32_t *below;   /* (blocks x 2) row and number of these blocks */
  sw_numbers values; /* (blocks x 9) */
  sw_tree *tree;
} sw_blocks_sparse;

sw_status sw_blocks_sparse_new(size_t nodes, const sw_couple *pairs, size_t count,
                               const int32_t *order, sw_blocks_sparse *old, sw_blocks_sparse **out);
void sw_blocks_sparse_free(sw_blocks_sparse *s); /* NULL is allowed */
size_t sw_blocks_sparse_slot(const sw_blocks_sparse *s, size_t i, size_t j);
void sw_blocks_sparse_clear(sw_blocks_sparse *s);
sw_status sw_blocks_sparse_factor(sw_blocks_sparse *s, const unsigned char *fixed,
                                  size_t *negative);
void sw_blocks_sparse_solve(const sw_blocks_sparse *s, double *x);
void sw_blocks_sparse_multiply(const sw_blocks_sparse *s, const double *x, double *y);
void sw_blocks_sparse_row_times(const sw_blocks_sparse *s, size_t node, const double *x,
                                double y[3]);

#endif
