/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In which order the nodes of a sparse matrix are eliminated. Of this room only. */
#ifndef SW_SOLVE_ORDER_H
#define SW_SOLVE_ORDER_H

#include "solve/sparse.h"

/* Lists of neighbours, both directions: those of node i are next[first[i]] .. next[first[i + 1] -
 * 1]; repeated pairs stay repeated. The caller frees both, on failure too. SW_ENOMEM. */
sw_status sw_sparse_neighbours(size_t n, const sw_sparse_pair *pairs, size_t count, int32_t **first,
                               int32_t **next);

/* An order of n nodes in which few zeros fill, for such lists: order[k] is the node to eliminate as
 * number k. SW_ENOMEM. */
sw_status sw_sparse_order(size_t n, const int32_t *first, const int32_t *next, int32_t *order);

/* Another one, from end to end of what is long. work: blocks that elimination changes [-]. */
sw_status sw_sparse_order_along(size_t n, const sw_sparse_pair *pairs, size_t count, int32_t *order,
                                double *work);

#endif
