/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense matrices: small ones, or those of a slice of springs. */
#ifndef SW_CALIBRATE_DENSE_H
#define SW_CALIBRATE_DENSE_H

#include <stddef.h>

#include "base/status.h"

/* Solves a x = b for m right-hand sides, b[k * n ..] for number k; x replaces b. a: n x n,
 * symmetric, no eigenvalue below 0. a may be singular, as for a slice, which is free to move as a
 * whole. A right-hand side must then be in its range, and x is one of the solutions. left (m
 * numbers, may be NULL): relative residual of each right-hand side, about 1e-12 if it is in the
 * range [-]. SW_ENOMEM; SW_ESINGULAR if a is not finite. */
sw_status sw_dense_semidefinite(const double *a, size_t n, double *b, size_t m, double *left);

/* Finds the singular values s (n, descending) of a (rows x n, rows >= n) and directions v (n x n,
 * one per column). One-sided Jacobi: small values are accurate to the last digits too. */
sw_status sw_singular(const double *a, size_t rows, size_t n, double *s, double *v, sw_error *err);

#endif
