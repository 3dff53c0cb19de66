/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small dense matrices of any kind. */
#ifndef SW_SOLVE_DENSE_H
#define SW_SOLVE_DENSE_H

#include <stddef.h>

enum { SW_DENSE_MOST = 16 }; /* rows [-] */

/* Solve a x = b (n <= SW_DENSE_MOST) in place: b becomes x; a (n x n, row by row) is lost. 0: there
 * is no solution. Nothing is allocated. */
int sw_dense_solve(double *a, size_t n, double *b);

/* x, or the shortest least-squares solution: directions in which a is below `least` of its largest
 * value are left out. Otherwise as sw_dense_solve. */
int sw_dense_least(double *a, size_t n, double *b, double least);

/* Solve a x = b likewise, of any size, by elimination, which counts pivots below 0. Without swaps
 * of rows that is how many eigenvalues a symmetric a has there; a pivot of 0 leaves no numbers in
 * b. With swaps a may be any matrix, and pivots of swapped rows do not count. */
enum { SW_DENSE_IN_ORDER, SW_DENSE_SWAPS };
size_t sw_dense_eliminate(double *a, size_t n, double *b, int swaps);

/* Of a symmetric positive a: solve a x = b (n) in place: b becomes x, and a (n x n, row by row, of
 * which the lower half counts) its factor. 0: a is not positive, b is undefined. Nothing is
 * allocated. */
int sw_cholesky_solve(double *a, size_t n, double *b);

#endif
