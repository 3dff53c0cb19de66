/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the supernodes of a sparse symmetric matrix, dense pieces for its elimination, with CHOLMOD
 * (Chen, Davis, Hager and Rajamanickam 2008). CHOLMOD does no arithmetic here: its dense kernels
 * depend on the installed BLAS, and it has none for indefinite matrices. */
#ifndef SW_SOLVE_CHOLMOD_ADAPTER_H
#define SW_SOLVE_CHOLMOD_ADAPTER_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

typedef struct sw_cholmod_plan {
  size_t fronts;
  uint32_t *order; /* (nodes) step k eliminates node order[k] */
  uint32_t *pivot; /* (fronts + 1) a front's first step */
  uint32_t *start; /* (fronts + 1) start of its rows in row */
  uint32_t *row;   /* (start[fronts]) steps, ascending: a front's own, then the coupled ones */
} sw_cholmod_plan;

/* Node i is coupled to nodes column[first[i]] .. column[first[i + 1] - 1], ascending, itself last.
 * order: of the elimination, up to equivalent changes; NULL: an order is found. SW_ENOMEM,
 * SW_ELIMIT; then there is no plan to free. */
sw_status sw_cholmod_analyse(size_t nodes, const uint32_t *first, const uint32_t *column,
                             const int32_t *order, sw_cholmod_plan *plan);
void sw_cholmod_free_plan(sw_cholmod_plan *plan);

#endif
