/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves small dense systems. */
#ifndef SW_SOLVE_DENSE_H
#define SW_SOLVE_DENSE_H

#include <stddef.h>

enum { SW_DENSE_MOST = 16 }; /* rows [-] */

/* Solves a x = b (n <= SW_DENSE_MOST) in place: b becomes x; a (n x n, row by row) is overwritten.
 * Returns 0 if there is no solution. Allocates nothing. */
int sw_dense_solve(double *a, size_t n, double *b);

/* The same, but a singular a gives the shortest least-squares solution: directions in which a is
 * below `least` times its largest singular value are left out. */
int sw_dense_least(double *a, size_t n, double *b, double least);

/* Solves a x = b in place, for any size, by elimination. Returns the number of pivots below 0. In
 * order: for a symmetric a this is its number of negative eigenvalues; a pivot of 0 leaves NaN or
 * infinity in b. With row swaps a may be any matrix, and pivots of swapped rows do not count. */
enum { SW_DENSE_IN_ORDER, SW_DENSE_SWAPS };
size_t sw_dense_eliminate(double *a, size_t n, double *b, int swaps);

/* For a symmetric positive definite a: solves a x = b (n) in place: b becomes x, and a (n x n, row
 * by row; only the lower half is read) becomes its factor. Returns 0 if a is not positive definite;
 * b is then undefined. Allocates nothing. */
int sw_cholesky_solve(double *a, size_t n, double *b);

#endif
