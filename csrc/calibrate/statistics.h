/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions, and points that fill a cube more evenly than random ones do. */
#ifndef SW_CALIBRATE_STATISTICS_H
#define SW_CALIBRATE_STATISTICS_H

#include <stddef.h>

#include "base/status.h"

/* The x that Student's t is below with probability p in (0, 1); freedom: degrees [-], infinite for
 * the normal distribution. */
double sw_student(double p, double freedom);

/* The probability that chi squared of so many degrees of freedom is above x. */
double sw_chi2_above(double x, double freedom);

enum { SW_QUASI_SOBOL_MOST = 40, SW_QUASI_HALTON_MOST = 100 }; /* dimensions [-] */

/* count points of n coordinates in (0, 1), one after the other in out [-]. sobol: Sobol's sequence
 * (Antonov, Saleev 1979), else Halton's, in which each coordinate has a prime as its base. */
sw_status sw_quasi(int sobol, size_t n, size_t count, double *out, sw_error *err);

/* Share of normally distributed numbers below x (mean 0, deviation 1); and x of a share, 0 to 1
 * [-]. */
double sw_normal_below(double x);
double sw_normal_at(double share);

#endif
