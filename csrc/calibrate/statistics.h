/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a fit's errors are made of. */
#ifndef SW_CALIBRATE_STATISTICS_H
#define SW_CALIBRATE_STATISTICS_H

#include <stddef.h>

#include "base/status.h"

/* The x that Student's t is below with probability p in (0, 1); freedom: degrees [-], infinite for
 * the normal distribution. */
double sw_student(double p, double freedom);

/* The probability that chi squared of so many degrees of freedom is above x. */
double sw_chi2_above(double x, double freedom);

/* Singular values s (n, falling) of a (rows x n, rows >= n) and directions v (n x n, one a column);
 * one-sided Jacobi, exact to the last digits for small values as well. */
sw_status sw_singular(const double *a, size_t rows, size_t n, double *s, double *v, sw_error *err);

#endif
