/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Minimisers by GSL: Brent in one dimension, Nelder and Mead in several. */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multimin.h>
#include <math.h>

#include "base/alloc.h"
#include "calibrate/minimise.h"

static const sw_param rows[] = {
    {"f", SW_PARAM_OTHER, "-", 0, 0, 0, SW_PARAM_REQUIRED, NULL, 0,
     "function to minimise: of a number, or of a list of numbers if start is a list"},
    {"from", SW_PARAM_NUMBER, "-", NAN, -DBL_MAX, DBL_MAX, 0, NULL,
     offsetof(sw_minimise_args, from), "lower end of the interval of one parameter"},
    {"to", SW_PARAM_NUMBER, "-", NAN, -DBL_MAX, DBL_MAX, 0, NULL, offsetof(sw_minimise_args, to),
     "upper end of the interval"},
    {"start", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "first guess, a number or a list, instead of an interval"},
    {"step", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "size of the first steps, a number or a list (default: a tenth of start)"},
    {"tolerance", SW_PARAM_NUMBER, "-", 1e-6, 0, 1, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_minimise_args, tolerance),
     "wanted accuracy, as a share of the interval or of the steps"},
    {"max_iterations", SW_PARAM_INTEGER, "-", 200, 1, 1e6, 0, NULL,
     offsetof(sw_minimise_args, max_iterations),
     "largest number of iterations; each takes one to a few values of f"},
};
const sw_params sw_minimise_params = SW_PARAMS("tune.minimise", rows);

/* Connects GSL and the objective. */
typedef struct bridge {
  sw_objective f;
  void *user;
  size_t n;
  double *x;                  /* parameters of the objective */
  const double *start, *step; /* simplex: x = start + step * u; NULL for the interval */
  double worst;               /* largest finite value so far */
  int (*interrupted)(void);
  sw_minimum *out;
  sw_status status; /* of the first failure; no evaluation after it */
  sw_error *err;
} bridge;

static double evaluate(bridge *b) {
  double value = NAN;
  if (b->status == SW_OK && b->interrupted && b->interrupted()) b->status = SW_EINTR;
  if (b->status != SW_OK) return NAN;
  b->out->evaluations++;
  b->status = b->f(b->user, b->x, b->n, &value, b->err);
  if (b->status != SW_OK) return NAN;
  if (isfinite(value)) {
    if (!(b->worst > value)) b->worst = value;
    return value;
  }
  b->out->nonfinite++;
  /* GSL needs finite numbers: a value worse than all others leads the search away. */
  return isfinite(b->worst) ? b->worst + 10 * fabs(b->worst) + 1 : DBL_MAX;
}

static double on_line(double x, void *user) {
  bridge *b = user;
  b->x[0] = x;
  return evaluate(b);
}

static double in_space(const gsl_vector *u, void *user) {
  bridge *b = user;
  for (size_t i = 0; i < b->n; i++) b->x[i] = b->start[i] + b->step[i] * gsl_vector_get(u, i);
  return evaluate(b);
}

static sw_status no_memory(sw_error *err) {
  return sw_fail(err, SW_ENOMEM, "tune.minimise: out of memory");
}

/* --- one parameter ------------------------------------------------------------ */

enum { LOOKS = 9 }; /* places of the first scan, ends included [-] */

/* Evaluates LOOKS evenly spaced places; *best is the one with the smallest value. */
static sw_status look(bridge *b, const sw_minimise_args *args, double at[LOOKS],
                      double value[LOOKS], int *best) {
  int finite = 0;
  *best = 0;
  for (int i = 0; i < LOOKS; i++) {
    const size_t before = b->out->nonfinite;
    at[i] = i == LOOKS - 1 ? args->to : args->from + (args->to - args->from) * i / (LOOKS - 1);
    value[i] = on_line(at[i], b);
    if (b->status != SW_OK) return b->status;
    if (b->out->nonfinite > before)
      value[i] = DBL_MAX;
    else
      finite = 1;
    if (value[i] < value[*best]) *best = i;
  }
  if (!finite)
    return sw_fail(b->err, SW_EINVAL,
                   "tune.minimise: f returns no finite number anywhere between %g and %g",
                   args->from, args->to);
  return SW_OK;
}

/* Tells how the search ended. near: 1 if it came as near as wanted; code: of GSL. */
static sw_status conclude(bridge *b, int code, int near) {
  b->out->ok = near && code == GSL_SUCCESS;
  if (code != GSL_SUCCESS)
    sw_fail(&b->out->reason, SW_ENOCONV, "GSL: %s", gsl_strerror(code));
  else
    sw_fail(&b->out->reason, SW_ENOCONV,
            near ? "the wanted accuracy was reached" : "iterations used up");
  return b->status;
}

static sw_status brent(bridge *b, const sw_minimise_args *args, const double at[3],
                       const double value[3], double *x) {
  gsl_function f = {on_line, b};
  gsl_min_fminimizer *m = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
  if (!m) return no_memory(b->err);
  const double wanted = args->tolerance * (args->to - args->from);
  int code =
      gsl_min_fminimizer_set_with_values(m, &f, at[1], value[1], at[0], value[0], at[2], value[2]);
  int near = 0;
  while (code == GSL_SUCCESS && !near && b->out->iterations < (size_t)args->max_iterations) {
    b->out->iterations++;
    code = gsl_min_fminimizer_iterate(m);
    const double least = 4 * sqrt(DBL_EPSILON) * fabs(gsl_min_fminimizer_x_minimum(m));
    near = gsl_min_fminimizer_x_upper(m) - gsl_min_fminimizer_x_lower(m) <= wanted + least;
  }
  *x = gsl_min_fminimizer_x_minimum(m);
  b->out->value = gsl_min_fminimizer_f_minimum(m);
  gsl_min_fminimizer_free(m);
  return conclude(b, code, near);
}

sw_status sw_minimise_interval(sw_objective f, void *user, const sw_minimise_args *args,
                               int (*interrupted)(void), double *x, sw_minimum *out,
                               sw_error *err) {
  bridge b = {f, user, 1, x, NULL, NULL, NAN, interrupted, out, SW_OK, err};
  double at[LOOKS], value[LOOKS];
  int best;
  *out = (sw_minimum){.value = NAN};
  if (!(args->from < args->to) || !isfinite(args->to - args->from))
    return sw_fail(
        err, SW_EINVAL,
        "tune.minimise: from = %g and to = %g are not an interval; from must be below to",
        args->from, args->to);
  gsl_set_error_handler_off(); /* statuses are checked instead */
  SW_TRY(look(&b, args, at, value, &best));
  int low = best, high = best;
  while (low > 0 && !(value[low] > value[best])) low--;
  while (high < LOOKS - 1 && !(value[high] > value[best])) high++;
  if (value[low] > value[best] && value[high] > value[best]) {
    const double place[3] = {at[low], at[best], at[high]};
    const double three[3] = {value[low], value[best], value[high]};
    double found = at[best];
    const sw_status status = brent(&b, args, place, three, &found);
    *x = found;
    return status;
  }
  *x = at[best];
  out->value = value[best];
  sw_fail(&out->reason, SW_ENOCONV, "the smallest value is at the end %g of the interval",
          at[best]);
  return SW_OK;
}

/* --- several parameters -------------------------------------------------------- */

static sw_status nelder_mead(bridge *b, const sw_minimise_args *args, gsl_vector *u,
                             gsl_vector *size, double *x) {
  gsl_multimin_function f = {in_space, b->n, b};
  gsl_multimin_fminimizer *m =
      gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, b->n);
  if (!m) return no_memory(b->err);
  gsl_vector_set_zero(u);
  gsl_vector_set_all(size, 1.0);
  int code = gsl_multimin_fminimizer_set(m, &f, u, size), near = 0;
  while (code == GSL_SUCCESS && !near && b->out->iterations < (size_t)args->max_iterations) {
    b->out->iterations++;
    code = gsl_multimin_fminimizer_iterate(m);
    near = gsl_multimin_fminimizer_size(m) <= args->tolerance;
  }
  for (size_t i = 0; b->status == SW_OK && i < b->n; i++)
    x[i] = b->start[i] + b->step[i] * gsl_vector_get(gsl_multimin_fminimizer_x(m), i);
  b->out->value = gsl_multimin_fminimizer_minimum(m);
  gsl_multimin_fminimizer_free(m);
  /* ENOPROG: the simplex cannot shrink further; this counts as reached. */
  return code == GSL_ENOPROG ? conclude(b, GSL_SUCCESS, 1) : conclude(b, code, near);
}

sw_status sw_minimise_simplex(sw_objective f, void *user, size_t n, double *x, const double *step,
                              const sw_minimise_args *args, int (*interrupted)(void),
                              sw_minimum *out, sw_error *err) {
  *out = (sw_minimum){.value = NAN};
  if (n < 1 || n > SW_MINIMISE_MOST)
    return sw_fail(err, SW_EINVAL, "tune.minimise: start has %zu numbers; allowed are 1 to %d", n,
                   SW_MINIMISE_MOST);
  for (size_t i = 0; i < n; i++)
    if (!isfinite(x[i]) || !isfinite(step[i]) || step[i] == 0)
      return sw_fail(err, SW_EINVAL,
                     "tune.minimise: parameter %zu starts at %g with a step of %g; both must be "
                     "finite, the step not 0",
                     i + 1, x[i], step[i]);
  gsl_set_error_handler_off();
  double *work SW_LOCAL = sw_alloc(2 * n, sizeof *work);
  gsl_vector *u = gsl_vector_alloc(n), *size = gsl_vector_alloc(n);
  sw_status status = SW_OK;
  if (!work || !u || !size) {
    status = no_memory(err);
  } else {
    for (size_t i = 0; i < n; i++) work[i] = x[i];
    bridge b = {f, user, n, work + n, work, step, NAN, interrupted, out, SW_OK, err};
    status = nelder_mead(&b, args, u, size, x);
    if (status == SW_OK && !isfinite(b.worst))
      status = sw_fail(err, SW_EINVAL, "tune.minimise: f returns no finite number near start");
  }
  gsl_vector_free(u);
  gsl_vector_free(size);
  return status;
}
