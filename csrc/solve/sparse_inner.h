/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a sparse matrix: the analysis makes its lists, the factorisation runs through them.
 * Private to the sparse files. */
#ifndef SW_SOLVE_SPARSE_INNER_H
#define SW_SOLVE_SPARSE_INNER_H

#include <stddef.h>
#include <stdint.h>

#include "solve/blocks.h"
#include "solve/sparse.h"

/* Two right-hand sides at once: solving for one chain is mostly waiting. */
typedef double sw_two __attribute__((vector_size(16)));

struct sw_sparse {
  size_t n, block;
  sw_blocks *fronts;     /* the matrix, if L is dense enough; then only slot is used as well */
  int along;             /* 1: the fronts are eliminated in the order from end to end */
  uint32_t *place;       /* (n) node -> its number in the elimination */
  uint32_t *start, *row; /* (n + 1), (fill): rows of each column of L, ascending */
  uint32_t *slot;        /* (pairs) block of L, times 2, + 1 if given transposed */
  uint32_t *target;      /* blocks to which the products of two rows of a column are added */
  size_t targets, fill, widest;
  sw_two *x;         /* (n x block) */
  double *own, *off; /* (n), (fill) blocks */
  double *column;    /* (widest) blocks */
};

#endif
