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

/* Three places of which the middle one has the smallest value, if found. */
typedef struct bracket {
  double at[3], value[3];
  int found;
} bracket;

static void set_bracket(bracket *k, const double at[3], const double value[3]) {
  for (int i = 0; i < 3; i++) k->at[i] = at[i], k->value[i] = value[i];
  k->found = 1;
}

/* Evaluates a place between those of k and makes it the middle if its value is below both. */
static sw_status try_middle(bridge *b, bracket *k, double at) {
  const size_t before = b->out->nonfinite;
  k->at[1] = at;
  k->value[1] = on_line(at, b);
  if (b->out->nonfinite > before) k->value[1] = DBL_MAX;
  k->found = k->value[1] < k->value[0] && k->value[1] < k->value[2];
  return b->status;
}

enum { CLOSER = 4 }; /* each place is this times nearer to the end than the one before [-] */

/* Looks nearer and nearer, up to the tolerance, to the end at[0] of the interval, where the value
 * is the smallest so far. k: the end and its neighbour, at 0 and 2; *flat: farthest place with the
 * value of the end. */
static sw_status close_in(bridge *b, const sw_minimise_args *args, bracket *k, double *flat) {
  const double wanted = args->tolerance * (args->to - args->from);
  *flat = k->at[0];
  while (!k->found && fabs(k->at[2] - k->at[0]) > wanted &&
         b->out->iterations < (size_t)args->max_iterations) {
    const double x = k->at[0] + (k->at[2] - k->at[0]) / CLOSER;
    if (x == k->at[0] || x == k->at[2]) break;
    b->out->iterations++;
    SW_TRY(try_middle(b, k, x));
    if (k->found) break;
    if (k->value[1] == k->value[0] && *flat == k->at[0]) *flat = x;
    k->at[2] = x;
    k->value[2] = k->value[1];
  }
  return SW_OK;
}

/* Looks between the places first to last, which all have the smallest value. */
static sw_status look_between(bridge *b, const double at[LOOKS], double least, int first, int last,
                              bracket *k) {
  for (int i = first; i < last && !k->found; i++) {
    k->at[0] = at[i], k->at[2] = at[i + 1];
    k->value[0] = k->value[2] = least;
    SW_TRY(try_middle(b, k, 0.5 * (at[i] + at[i + 1])));
  }
  return SW_OK;
}

/* Says why there is no minimum: the values from..to, which reach an end, are the smallest. */
static sw_status no_minimum(bridge *b, const sw_minimise_args *args, double value, double from,
                            double to) {
  const int low = from == args->from, high = to == args->to;
  sw_error *reason = &b->out->reason;
  *b->x = low ? args->from : args->to;
  b->out->value = value;
  if (b->out->iterations >= (size_t)args->max_iterations)
    sw_fail(reason, SW_ENOCONV, "iterations used up near the end %g of the interval", *b->x);
  else if (low && high)
    sw_fail(reason, SW_ENOCONV,
            "f has the same value, %g, at all places between %g and %g that were tried", value,
            from, to);
  else if (from < to)
    sw_fail(reason, SW_ENOCONV,
            "the smallest value, %g, is the same from %g to %g, the %s end of the interval", value,
            low ? to : from, *b->x, low ? "lower" : "upper");
  else
    sw_fail(reason, SW_ENOCONV, "the smallest value is at the end %g of the interval", *b->x);
  return SW_OK;
}

/* Brackets the minimum. If there is none, the places *from..*to have the smallest value. */
static sw_status enclose(bridge *b, const sw_minimise_args *args, bracket *k, double *from,
                         double *to, double *least) {
  double at[LOOKS], value[LOOKS], flat;
  int best, low, high;
  SW_TRY(look(b, args, at, value, &best));
  for (low = best; low > 0 && !(value[low] > value[best]);) low--;
  for (high = best; high < LOOKS - 1 && !(value[high] > value[best]);) high++;
  const int rises[2] = {value[low] > value[best], value[high] > value[best]};
  *least = value[best];
  if (rises[0] && rises[1]) {
    set_bracket(k, (double[3]){at[low], at[best], at[high]},
                (double[3]){value[low], value[best], value[high]});
    return SW_OK;
  }
  const int first = rises[0] ? low + 1 : 0, last = rises[1] ? high - 1 : LOOKS - 1;
  *from = at[first], *to = at[last];
  if (first < last) return look_between(b, at, *least, first, last, k);
  const int beside = first == 0 ? 1 : last - 1;
  k->at[0] = at[first], k->at[2] = at[beside];
  k->value[0] = value[first], k->value[2] = value[beside];
  SW_TRY(close_in(b, args, k, &flat));
  if (first == 0)
    *to = flat;
  else
    *from = flat;
  if (k->found && k->at[0] > k->at[2])
    set_bracket(k, (double[3]){k->at[2], k->at[1], k->at[0]},
                (double[3]){k->value[2], k->value[1], k->value[0]});
  return SW_OK;
}

sw_status sw_minimise_interval(sw_objective f, void *user, const sw_minimise_args *args,
                               int (*interrupted)(void), double *x, sw_minimum *out,
                               sw_error *err) {
  bridge b = {f, user, 1, x, NULL, NULL, NAN, interrupted, out, SW_OK, err};
  bracket k = {.found = 0};
  double from, to, least;
  *out = (sw_minimum){.value = NAN};
  if (!(args->from < args->to) || !isfinite(args->to - args->from))
    return sw_fail(
        err, SW_EINVAL,
        "tune.minimise: from = %g and to = %g are not an interval; from must be below to",
        args->from, args->to);
  gsl_set_error_handler_off(); /* statuses are checked instead */
  SW_TRY(enclose(&b, args, &k, &from, &to, &least));
  if (!k.found) return no_minimum(&b, args, least, from, to);
  double found = k.at[1];
  const sw_status status = brent(&b, args, k.at, k.value, &found);
  *x = found;
  return status;
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
