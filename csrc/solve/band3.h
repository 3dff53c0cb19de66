/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric matrices of 3 x 3 blocks with two blocks beside the diagonal, as for a chain of nodes
 * with bending. Factorised without pivoting as U' D U, so that the signs of the pivots count
 * negative directions. */
#ifndef SW_SOLVE_BAND3_H
#define SW_SOLVE_BAND3_H

#include <stddef.h>

#include "base/status.h"

/* One block row: the diagonal block's upper half (xx xy xz yy yz zz), then the full blocks to the
 * next node and to the one after it, row by row. */
enum { SW_ROW_OWN = 0, SW_ROW_NEXT = 6, SW_ROW_SECOND = 15, SW_ROW_SIZE = 24 };

/* Factorises n block rows a (n x SW_ROW_SIZE) into factor (same size; may be a). negative (may be
 * NULL) receives the number of negative pivots. SW_ESINGULAR if a pivot block vanishes or is not
 * finite. */
sw_status sw_band3_factor(const double *a, size_t n, double *factor, size_t *negative);

/* Solves in place for b (n x 3). */
void sw_band3_solve(const double *factor, size_t n, double *b);

/* y = A x for block rows a (n x SW_ROW_SIZE), x and y (n x 3). */
void sw_band3_multiply(const double *a, size_t n, const double *x, double *y);

#endif
