/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense matrices by GSL. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "calibrate/dense.h"

/* --- semidefinite matrices ------------------------------------------------------ */

/* Cholesky factors of the matrix with a small shift d; iteration removes the error of the shift: x
 * <- x + (A + d)^-1 (b - A x) multiplies it by d / (lambda + d) for every eigenvalue lambda > 0 and
 * leaves the components of lambda = 0 alone. No rank must be decided. */
static const double SHIFT = 1e-11;  /* for the matrix scaled to a diagonal of 1 [-] */
enum { REPEATS = 8 };               /* most iterations [-] */
static const double ENOUGH = 1e-12; /* relative residual that ends the iteration [-] */

static double norm(const double *x, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += x[i] * x[i];
  return sqrt(sum);
}

/* r = b - A x for the scaled matrix with entries a_ij s_i s_j. */
static void residual(const double *a, const double *s, size_t n, const double *b, const double *x,
                     double *r) {
  for (size_t i = 0; i < n; i++) {
    double sum = 0;
    for (size_t j = 0; j < n; j++) sum += a[i * n + j] * s[j] * x[j];
    r[i] = b[i] - s[i] * sum;
  }
}

/* Solves for one right-hand side; x replaces b. work: 3 n. Returns the relative residual. */
static double solve_one(const double *a, const double *s, const gsl_matrix *factor, size_t n,
                        double *b, double *work) {
  double *right = work, *x = work + n, *r = work + 2 * n;
  gsl_vector_view step = gsl_vector_view_array(r, n);
  memset(x, 0, n * sizeof *x);
  for (size_t i = 0; i < n; i++) right[i] = r[i] = s[i] * b[i];
  const double whole = norm(right, n);
  double left = whole;
  for (int k = 0; whole > 0 && k < REPEATS && left > ENOUGH * whole; k++) {
    gsl_linalg_cholesky_svx(factor, &step.vector);
    for (size_t i = 0; i < n; i++) x[i] += r[i];
    residual(a, s, n, right, x, r);
    left = norm(r, n);
  }
  for (size_t i = 0; i < n; i++) b[i] = s[i] * x[i];
  return whole > 0 ? left / whole : 0;
}

sw_status sw_dense_semidefinite(const double *a, size_t n, double *b, size_t m, double *left) {
  double *work SW_LOCAL = sw_alloc(n * n + 4 * n, sizeof *work);
  if (!work) return SW_ENOMEM;
  double *s = work + n * n;
  int finite = 1;
  for (size_t i = 0; i < n; i++) s[i] = a[i * n + i] > 0 ? 1 / sqrt(a[i * n + i]) : 1;
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++) {
      finite &= isfinite(a[i * n + j]) != 0;
      work[i * n + j] = a[i * n + j] * s[i] * s[j] + (i == j ? SHIFT : 0);
    }
  gsl_matrix_view factor = gsl_matrix_view_array(work, n, n);
  gsl_error_handler_t *before = gsl_set_error_handler_off();
  const int failed = !finite || gsl_linalg_cholesky_decomp1(&factor.matrix) != GSL_SUCCESS;
  for (size_t k = 0; !failed && k < m; k++) {
    const double share = solve_one(a, s, &factor.matrix, n, b + k * n, s + n);
    if (left) left[k] = share;
  }
  gsl_set_error_handler(before);
  return failed ? SW_ESINGULAR : SW_OK;
}

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
