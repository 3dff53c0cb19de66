/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares by GSL's multifit_nlinear. It asks for residuals and derivatives in turn; both are
 * computed together and kept. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include "base/alloc.h"
#include "calibrate/least_squares.h"

typedef struct bridge {
  sw_residuals f;
  void *user;
  size_t n, rows;
  double *x, *r, *jacobian; /* of the last evaluation */
  int known;                /* 1: there was an evaluation */
  int apart;                /* 1: residuals and derivatives are evaluated separately */
  sw_status status;         /* of the first failure; no evaluation after it */
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

/* Evaluates residuals or derivatives alone. */
static int evaluate_part(bridge *b, const gsl_vector *x, double *r, double *jacobian) {
  for (size_t i = 0; i < b->n; i++) b->x[i] = gsl_vector_get(x, i);
  if (b->status == SW_OK) b->status = b->f(b->user, b->x, r, jacobian, b->err);
  return b->status == SW_OK ? GSL_SUCCESS : GSL_EBADFUNC;
}

static int residuals(const gsl_vector *x, void *user, gsl_vector *r) {
  bridge *b = user;
  const int status = b->apart ? evaluate_part(b, x, b->r, NULL) : evaluate(b, x);
  if (status != GSL_SUCCESS) return status;
  for (size_t i = 0; i < b->rows; i++) gsl_vector_set(r, i, b->r[i]);
  return GSL_SUCCESS;
}

static int derivatives(const gsl_vector *x, void *user, gsl_matrix *jacobian) {
  bridge *b = user;
  const int status = b->apart ? evaluate_part(b, x, NULL, b->jacobian) : evaluate(b, x);
  if (status != GSL_SUCCESS) return status;
  for (size_t i = 0; i < b->rows; i++)
    for (size_t j = 0; j < b->n; j++) gsl_matrix_set(jacobian, i, j, b->jacobian[i * b->n + j]);
  return GSL_SUCCESS;
}

typedef struct limits {
  double tolerance; /* [-] */
  size_t max_iterations;
  sw_fit_end end;
  size_t iterations;
} limits;

/* Iterates until a step is small, none helps, or the iterations are used up. */
static void iterate(bridge *b, gsl_multifit_nlinear_workspace *w, limits *l) {
  int info;
  l->end = SW_FIT_USED;
  while (l->iterations < l->max_iterations) {
    const int status = gsl_multifit_nlinear_iterate(w);
    if (b->status != SW_OK) return;
    l->iterations++;
    if (status != GSL_SUCCESS) {
      l->end = SW_FIT_STUCK;
      return;
    }
    if (gsl_multifit_nlinear_test(l->tolerance, 1e-16, 0, &info, w) == GSL_SUCCESS) {
      l->end = SW_FIT_NEAR;
      return;
    }
  }
}

static void search(bridge *b, gsl_multifit_nlinear_workspace *w, double *x, limits *l) {
  gsl_multifit_nlinear_fdf f = {
      .f = residuals, .df = derivatives, .n = b->rows, .p = b->n, .params = b};
  const gsl_vector_const_view start = gsl_vector_const_view_array(x, b->n);
  int info;
  if (gsl_multifit_nlinear_init(&start.vector, &f, w) != GSL_SUCCESS) return;
  if (b->apart)
    iterate(b, w, l);
  else /* ENOPROG, EMAXITER are fine: the caller checks the residuals */
    gsl_multifit_nlinear_driver(l->max_iterations, 1e-12, 1e-14, 0, NULL, NULL, &info, w);
  for (size_t i = 0; b->status == SW_OK && i < b->n; i++)
    x[i] = gsl_vector_get(gsl_multifit_nlinear_position(w), i);
}

static sw_status solve(bridge *b, double *x, limits *l) {
  const size_t n = b->n, rows = b->rows;
  gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
  gsl_error_handler_t *before = gsl_set_error_handler_off();
  double *kept = sw_alloc(n + rows + rows * n, sizeof *kept);
  gsl_multifit_nlinear_workspace *w =
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, rows, n);
  if (!kept || !w) {
    b->status = sw_fail(b->err, SW_ENOMEM, "least squares: out of memory");
  } else {
    b->x = kept;
    b->r = kept + n;
    b->jacobian = kept + n + rows;
    search(b, w, x, l);
  }
  if (w) gsl_multifit_nlinear_free(w);
  sw_free(kept);
  gsl_set_error_handler(before);
  return b->status;
}

sw_status sw_least_squares(sw_residuals f, void *user, size_t n, size_t rows, double *x,
                           size_t max_iterations, sw_error *err) {
  bridge b = {.f = f, .user = user, .n = n, .rows = rows, .status = SW_OK, .err = err};
  limits l = {.max_iterations = max_iterations};
  return solve(&b, x, &l);
}

sw_status sw_fit(sw_residuals f, void *user, size_t n, size_t rows, double *x, double tolerance,
                 size_t max_iterations, sw_fit_end *end, size_t *iterations, sw_error *err) {
  bridge b = {.f = f, .user = user, .n = n, .rows = rows, .apart = 1, .status = SW_OK, .err = err};
  limits l = {.tolerance = tolerance, .max_iterations = max_iterations};
  const sw_status status = solve(&b, x, &l);
  *end = l.end;
  *iterations = l.iterations;
  return status;
}
