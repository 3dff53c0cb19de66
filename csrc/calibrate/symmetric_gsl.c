/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "calibrate/symmetric.h"

sw_status sw_symmetric_eigen(const double *a, size_t n, double *values, double *vectors) {
  for (size_t k = 0; k < n * n; k++)
    if (!isfinite(a[k])) return SW_EDIVERGED;
  gsl_error_handler_t *before = gsl_set_error_handler_off();
  gsl_eigen_symmv_workspace *work = gsl_eigen_symmv_alloc(n);
  gsl_matrix *m = gsl_matrix_alloc(n, n), *z = gsl_matrix_alloc(n, n);
  gsl_vector_view w = gsl_vector_view_array(values, n);
  sw_status status = SW_ENOMEM;
  if (work && m && z) {
    memcpy(m->data, a, n * n * sizeof *a);
    status = gsl_eigen_symmv(m, &w.vector, z, work) ? SW_EDIVERGED : SW_OK;
    gsl_eigen_symmv_sort(&w.vector, z, GSL_EIGEN_SORT_VAL_ASC);
    for (size_t k = 0; k < n; k++)
      for (size_t i = 0; i < n; i++) vectors[k * n + i] = gsl_matrix_get(z, i, k);
  }
  if (work) gsl_eigen_symmv_free(work);
  gsl_matrix_free(m);
  gsl_matrix_free(z);
  gsl_set_error_handler(before);
  return status;
}
