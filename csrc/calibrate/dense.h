/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense symmetric matrices that may be singular, as those of a slice of springs are:
 * nothing resists moving it as a whole. */
#ifndef SW_CALIBRATE_DENSE_H
#define SW_CALIBRATE_DENSE_H

#include <stddef.h>

#include "base/status.h"

/* Solve a x = b for m right sides, b[k * n ..] for number k, each replaced by its x. a: n x n,
 * symmetric, no eigenvalue below 0. Where a is singular, a right side must be in its range; x
 * is one of the solutions. left (m numbers, may be NULL): share of each right side that was
 * not reached, about 1e-12 where it is in the range [-]. SW_ENOMEM, SW_ESINGULAR when a is not
 * finite. */
sw_status sw_dense_semidefinite(const double *a, size_t n, double *b, size_t m, double *left);

#endif
