/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric matrices of 4 x 4 blocks with two blocks beside the diagonal: a chain of nodes, each
 * with the spin of the edge that starts there. Otherwise like band3. */
#ifndef SW_SOLVE_BAND4_H
#define SW_SOLVE_BAND4_H

#include <stddef.h>

#include "base/status.h"

/* One block row: the full diagonal block, the block to the next node and the one to the node after
 * it, each row by row. */
enum { SW_ROW4_NEXT = 16, SW_ROW4_SECOND = 32, SW_ROW4_SIZE = 48 };

/* Factorises n >= 2 block rows a (n x SW_ROW4_SIZE) in place. negative (may be NULL) receives the
 * number of negative pivots. SW_ESINGULAR if a pivot vanishes or is not finite. */
sw_status sw_band4_factor(double *a, size_t n, size_t *negative);

/* Solves in place for b (n x 4). */
void sw_band4_solve(const double *factor, size_t n, double *b);

#endif
