/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small dense symmetric positive matrices. */
#ifndef SW_SOLVE_CHOLESKY_H
#define SW_SOLVE_CHOLESKY_H

#include <stddef.h>

/* Solve a x = b (n) in place: b becomes x, and a (n x n, row by row, of which the lower half
 * counts) its factor. 0: a is not positive, b is undefined. Nothing is allocated. */
int sw_cholesky_solve(double *a, size_t n, double *b);

#endif
