/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense matrices, small or of a slice of springs. */
#ifndef SW_CALIBRATE_DENSE_H
#define SW_CALIBRATE_DENSE_H

#include <stddef.h>

#include "base/status.h"

/* A matrix may be singular, as that of a slice is: nothing resists moving it as a whole.
 * Solve a x = b for m right sides, b[k * n ..] for number k, each replaced by its x. a: n x n,
 * symmetric, no eigenvalue below 0. Where a is singular, a right side must be in its range; x
 * is one of the solutions. left (m numbers, may be NULL): share of each right side that was
 * not reached, about 1e-12 where it is in the range [-]. SW_ENOMEM, SW_ESINGULAR when a is not
 * finite. */
sw_status sw_dense_semidefinite(const double *a, size_t n, double *b, size_t m, double *left);

/* Eigenvalues, ascending, and eigenvectors of length 1, one after the other, of a symmetric matrix
 * a (n x n, of which the lower half is read). SW_ENOMEM; SW_EDIVERGED where it is not finite. */
sw_status sw_symmetric_eigen(const double *a, size_t n, double *values, double *vectors);

/* Singular values s (n, falling) of a (rows x n, rows >= n) and directions v (n x n, one a column);
 * one-sided Jacobi, exact to the last digits for small values as well. */
sw_status sw_singular(const double *a, size_t rows, size_t n, double *s, double *v, sw_error *err);

#endif
