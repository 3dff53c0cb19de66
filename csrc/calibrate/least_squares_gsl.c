/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GSL's multifit_nlinear. It asks for residuals and derivatives one after the other; they are
 * computed together and kept. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <string.h>

#include "base/alloc.h"
#include "calibrate/least_squares.h"

typedef struct bridge {
  sw_residuals f;
  void *user;
  size_t n, rows;
  double *x, *r, *jacobian; /* of the latest evaluation */
  int known;                /* there was one */
  sw_status status;         /* of the first failure: nothing is evaluated after it */
  sw_error *err;
} bridge;

static int evaluate(bridge *b, const gsl_vector *x) {
  int same = b->known;
  for (size_t i = 0; i < b->n; i++) same = same && b->x[i] == gsl_vector_get(x, i);
  if (same) return GSL_SUCCESS;
  for (size_t i = 0; i < b->n; i++) b->x[i] = gsl_vector_get(x, i);
  b->known = 0;
  if (b->status == SW_OK) b->status = b->f(b->user, b->x, b->r, b->jacobian, b->err);
  if (b->status != SW_OK) return GSL_EBADFUNC;
  b->known = 1;
  return GSL_SUCCESS;
}

static int residuals(const gsl_vector *x, void *user, gsl_vector *r) {
  bridge *b = user;
  if (evaluate(b, x) != GSL_SUCCESS) return GSL_EBADFUNC;
  for (size_t i = 0; i < b->rows; i++) gsl_vector_set(r, i, b->r[i]);
  return GSL_SUCCESS;
}

static int derivatives(const gsl_vector *x, void *user, gsl_matrix *jacobian) {
  bridge *b = user;
  if (evaluate(b, x) != GSL_SUCCESS) return GSL_EBADFUNC;
  for (size_t i = 0; i < b->rows; i++)
    for (size_t j = 0; j < b->n; j++) gsl_matrix_set(jacobian, i, j, b->jacobian[i * b->n + j]);
  return GSL_SUCCESS;
}

static void search(bridge *b, gsl_multifit_nlinear_workspace *w, double *x, size_t max_iterations) {
  gsl_multifit_nlinear_fdf f = {
      .f = residuals, .df = derivatives, .n = b->rows, .p = b->n, .params = b};
  const gsl_vector_const_view start = gsl_vector_const_view_array(x, b->n);
  int info;
  if (gsl_multifit_nlinear_init(&start.vector, &f, w) != GSL_SUCCESS) return;
  /* ENOPROG, EMAXITER: as near as it gets; the caller looks at the residuals. */
  gsl_multifit_nlinear_driver(max_iterations, 1e-12, 1e-14, 0, NULL, NULL, &info, w);
  for (size_t i = 0; b->status == SW_OK && i < b->n; i++)
    x[i] = gsl_vector_get(gsl_multifit_nlinear_position(w), i);
}

sw_status sw_least_squares(sw_residuals f, void *user, size_t n, size_t rows, double *x,
                           size_t max_iterations, sw_error *err) {
  gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
  gsl_error_handler_t *before = gsl_set_error_handler_off();
  double *kept = sw_alloc(n + rows + rows * n, sizeof *kept);
  gsl_multifit_nlinear_workspace *w =
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, rows, n);
  bridge b = {f, user,  n,  rows, kept, kept ? kept + n : NULL, kept ? kept + n + rows : NULL,
              0, SW_OK, err};
  if (!kept || !w)
    b.status = sw_fail(err, SW_ENOMEM, "least squares: out of memory");
  else
    search(&b, w, x, max_iterations);
  if (w) gsl_multifit_nlinear_free(w);
  sw_free(kept);
  gsl_set_error_handler(before);
  return b.status;
}
