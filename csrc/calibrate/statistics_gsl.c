/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions and quasi-random sequences by GSL. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>
#include <math.h>

#include "calibrate/statistics.h"

double sw_student(double p, double freedom) {
  return isinf(freedom) ? gsl_cdf_ugaussian_Pinv(p) : gsl_cdf_tdist_Pinv(p, freedom);
}

double sw_chi2_above(double x, double freedom) { return gsl_cdf_chisq_Q(x, freedom); }

sw_status sw_quasi(int sobol, size_t n, size_t count, double *out, sw_error *err) {
  const size_t most = sobol ? SW_QUASI_SOBOL_MOST : SW_QUASI_HALTON_MOST;
  if (n < 1 || n > most)
    return sw_fail(err, SW_EINVAL, "kind = '%s' is for 1 to %zu parameters, not %zu",
                   sobol ? "sobol" : "halton", most, n);
  gsl_qrng *q = gsl_qrng_alloc(sobol ? gsl_qrng_sobol : gsl_qrng_halton, (unsigned)n);
  if (!q) return sw_fail(err, SW_ENOMEM, "out of memory");
  for (size_t k = 0; k < count; k++) gsl_qrng_get(q, out + k * n);
  gsl_qrng_free(q);
  return SW_OK;
}

double sw_normal_below(double x) { return gsl_cdf_ugaussian_P(x); }

double sw_normal_at(double share) { return gsl_cdf_ugaussian_Pinv(share); }
