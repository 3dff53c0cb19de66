/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include "solve/cholesky.h"

int sw_cholesky_solve(double *a, size_t n, double *b) {
  gsl_matrix_view A = gsl_matrix_view_array(a, n, n);
  gsl_vector_view x = gsl_vector_view_array(b, n);
  gsl_error_handler_t *before = gsl_set_error_handler_off(); /* else it ends the program */
  const int solved = gsl_linalg_cholesky_decomp1(&A.matrix) == GSL_SUCCESS &&
                     gsl_linalg_cholesky_svx(&A.matrix, &x.vector) == GSL_SUCCESS;
  gsl_set_error_handler(before);
  return solved;
}
