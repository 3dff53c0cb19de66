/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions, and quasi-random points, which fill a cube more evenly than random ones. */
#ifndef SW_CALIBRATE_STATISTICS_H
#define SW_CALIBRATE_STATISTICS_H

#include <stddef.h>

#include "base/status.h"

/* Returns the p quantile of Student's t, p in (0, 1). freedom: degrees of freedom [-]; infinite for
 * the normal distribution. */
double sw_student(double p, double freedom);

/* Returns the probability that chi squared of this many degrees of freedom exceeds x. */
double sw_chi2_above(double x, double freedom);

enum { SW_QUASI_SOBOL_MOST = 40, SW_QUASI_HALTON_MOST = 100 }; /* most dimensions [-] */

/* Makes count points of n coordinates in (0, 1), one after another in out [-]. sobol: Sobol's
 * sequence (Antonov, Saleev 1979), else Halton's, whose coordinates have prime bases. */
sw_status sw_quasi(int sobol, size_t n, size_t count, double *out, sw_error *err);

/* The normal distribution (mean 0, deviation 1): share of numbers below x; and x for a share, 0 to
 * 1 [-]. */
double sw_normal_below(double x);
double sw_normal_at(double share);

#endif
