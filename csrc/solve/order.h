/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orders in which the nodes of a sparse matrix are eliminated. Private to this room. */
#ifndef SW_SOLVE_ORDER_H
#define SW_SOLVE_ORDER_H

#include "solve/sparse.h"

/* Makes lists of neighbours in both directions: those of node i are next[first[i]] .. next[first[i
 * + 1] - 1]; repeated pairs stay repeated. The caller frees both, on failure too. SW_ENOMEM. */
sw_status sw_sparse_neighbours(size_t n, const sw_couple *pairs, size_t count, int32_t **first,
                               int32_t **next);

/* Finds an order of n nodes with little fill, for such lists: order[k] is the node to eliminate as
 * number k. SW_ENOMEM. */
sw_status sw_sparse_order(size_t n, const int32_t *first, const int32_t *next, int32_t *order);

/* Finds another order, from end to end of long structures. work: number of blocks that the
 * elimination changes [-]. SW_ENOMEM. */
sw_status sw_sparse_order_along(size_t n, const sw_couple *pairs, size_t count, int32_t *order,
                                double *work);

#endif
