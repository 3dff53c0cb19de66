/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GSL's distributions and singular values. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "calibrate/statistics.h"

double sw_student(double p, double freedom) {
  return isinf(freedom) ? gsl_cdf_ugaussian_Pinv(p) : gsl_cdf_tdist_Pinv(p, freedom);
}

double sw_chi2_above(double x, double freedom) { return gsl_cdf_chisq_Q(x, freedom); }

sw_status sw_singular(const double *a, size_t rows, size_t n, double *s, double *v, sw_error *err) {
  double *copy SW_LOCAL = sw_alloc(rows * n, sizeof *copy);
  if (!copy) return sw_fail(err, SW_ENOMEM, "singular values: out of memory");
  memcpy(copy, a, rows * n * sizeof *copy);
  gsl_error_handler_t *before = gsl_set_error_handler_off();
  gsl_matrix_view left = gsl_matrix_view_array(copy, rows, n),
                  right = gsl_matrix_view_array(v, n, n);
  gsl_vector_view values = gsl_vector_view_array(s, n);
  const int status = gsl_linalg_SV_decomp_jacobi(&left.matrix, &right.matrix, &values.vector);
  gsl_set_error_handler(before);
  if (status != GSL_SUCCESS)
    return sw_fail(err, SW_ESINGULAR, "singular values: %s", gsl_strerror(status));
  return SW_OK;
}
