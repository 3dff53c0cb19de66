/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense symmetric eigenproblems by GSL. */
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "modal/eigen.h"

typedef struct dense {
  gsl_matrix *a, *b, *z;
  gsl_vector *w;
  gsl_eigen_symmv_workspace *plain;
  gsl_eigen_gensymmv_workspace *general;
} dense;

static int open_dense(dense *d, size_t n, int general) {
  d->a = gsl_matrix_alloc(n, n);
  d->z = gsl_matrix_alloc(n, n);
  d->w = gsl_vector_alloc(n);
  if (general) {
    d->b = gsl_matrix_alloc(n, n);
    d->general = gsl_eigen_gensymmv_alloc(n);
  } else {
    d->plain = gsl_eigen_symmv_alloc(n);
  }
  return d->a && d->z && d->w && (general ? d->b && d->general : d->plain != NULL);
}

static void close_dense(dense *d) {
  gsl_matrix_free(d->a);
  gsl_matrix_free(d->b);
  gsl_matrix_free(d->z);
  gsl_vector_free(d->w);
  if (d->plain) gsl_eigen_symmv_free(d->plain);
  if (d->general) gsl_eigen_gensymmv_free(d->general);
}

static int fill(gsl_matrix *m, const double *values, size_t n) {
  int finite = 1;
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++) {
      finite &= isfinite(values[i * n + j]) != 0;
      gsl_matrix_set(m, i, j, values[i * n + j]);
    }
  return finite;
}

static sw_status solve(dense *d, const double *a, const double *b, size_t n, double *values,
                       double *vectors) {
  if (!fill(d->a, a, n) || (b && !fill(d->b, b, n))) return SW_EDIVERGED;
  const int failed = b ? gsl_eigen_gensymmv(d->a, d->b, d->w, d->z, d->general)
                       : gsl_eigen_symmv(d->a, d->w, d->z, d->plain);
  if (failed) return SW_EDIVERGED;
  if (b)
    gsl_eigen_gensymmv_sort(d->w, d->z, GSL_EIGEN_SORT_VAL_ASC);
  else
    gsl_eigen_symmv_sort(d->w, d->z, GSL_EIGEN_SORT_VAL_ASC);
  for (size_t k = 0; k < n; k++) {
    double norm2 = 0; /* GSL's general vectors have length 1, not z' B z = 1 */
    for (size_t i = 0; b && i < n; i++)
      for (size_t j = 0; j < n; j++)
        norm2 += gsl_matrix_get(d->z, i, k) * b[i * n + j] * gsl_matrix_get(d->z, j, k);
    values[k] = gsl_vector_get(d->w, k);
    for (size_t i = 0; i < n; i++)
      vectors[k * n + i] = gsl_matrix_get(d->z, i, k) / (b ? sqrt(norm2) : 1.0);
  }
  return SW_OK;
}

sw_status sw_eigen_dense(const double *a, const double *b, size_t n, double *values,
                         double *vectors) {
  dense d;
  memset(&d, 0, sizeof d);
  gsl_error_handler_t *before = gsl_set_error_handler_off();
  const sw_status status =
      open_dense(&d, n, b != NULL) ? solve(&d, a, b, n, values, vectors) : SW_ENOMEM;
  close_dense(&d);
  gsl_set_error_handler(before);
  return status;
}
