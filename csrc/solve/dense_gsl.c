/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small dense systems by GSL: QR, singular values, Cholesky. */
#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

#include "solve/dense.h"

static int is_finite(const double *x, size_t n) {
  for (size_t i = 0; i < n; i++)
    if (!isfinite(x[i])) return 0;
  return 1;
}

/* Householder's QR factorisation: it has no pivots that could fail. */
int sw_dense_solve(double *a, size_t n, double *b) {
  double t[SW_DENSE_MOST];
  if (n > SW_DENSE_MOST || !is_finite(a, n * n) || !is_finite(b, n)) return 0;
  if (n == 0) return 1;
  gsl_matrix_view A = gsl_matrix_view_array(a, n, n);
  gsl_vector_view tau = gsl_vector_view_array(t, n), x = gsl_vector_view_array(b, n);
  gsl_error_handler_t *before = gsl_set_error_handler_off(); /* otherwise GSL ends the program */
  const int solved = gsl_linalg_QR_decomp(&A.matrix, &tau.vector) == GSL_SUCCESS &&
                     gsl_linalg_QR_svx(&A.matrix, &tau.vector, &x.vector) == GSL_SUCCESS;
  gsl_set_error_handler(before);
  return solved && is_finite(b, n);
}

int sw_dense_least(double *a, size_t n, double *b, double least) {
  double v[SW_DENSE_MOST * SW_DENSE_MOST], values[SW_DENSE_MOST], along[SW_DENSE_MOST];
  if (n > SW_DENSE_MOST || !is_finite(a, n * n) || !is_finite(b, n)) return 0;
  if (n == 0) return 1;
  gsl_matrix_view U = gsl_matrix_view_array(a, n, n), V = gsl_matrix_view_array(v, n, n);
  gsl_vector_view s = gsl_vector_view_array(values, n), x = gsl_vector_view_array(b, n),
                  y = gsl_vector_view_array(along, n);
  gsl_error_handler_t *before = gsl_set_error_handler_off(); /* otherwise GSL ends the program */
  int solved = gsl_linalg_SV_decomp_jacobi(&U.matrix, &V.matrix, &s.vector) == GSL_SUCCESS &&
               gsl_blas_dgemv(CblasTrans, 1.0, &U.matrix, &x.vector, 0.0, &y.vector) == GSL_SUCCESS;
  for (size_t i = 0; i < n; i++)
    along[i] = solved && values[i] > least * values[0] ? along[i] / values[i] : 0.0;
  solved = solved && gsl_blas_dgemv(CblasNoTrans, 1.0, &V.matrix, &y.vector, 0.0, &x.vector) == 0;
  gsl_set_error_handler(before);
  return solved && is_finite(b, n);
}

int sw_cholesky_solve(double *a, size_t n, double *b) {
  gsl_matrix_view A = gsl_matrix_view_array(a, n, n);
  gsl_vector_view x = gsl_vector_view_array(b, n);
  gsl_error_handler_t *before = gsl_set_error_handler_off(); /* otherwise GSL ends the program */
  const int solved = gsl_linalg_cholesky_decomp1(&A.matrix) == GSL_SUCCESS &&
                     gsl_linalg_cholesky_svx(&A.matrix, &x.vector) == GSL_SUCCESS;
  gsl_set_error_handler(before);
  return solved;
}
