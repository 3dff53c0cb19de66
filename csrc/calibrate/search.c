/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A minimiser on a fiber, which is suspended whenever the minimiser needs a value. */
#include "calibrate/search.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "calibrate/minimise.h"
#include "calibrate/search_inner.h"

static const sw_search *drawing; /* the search that uses NLopt's random numbers */

int sw_search_evaluate(sw_search *s, const double *x) {
  if (s->stop) return 0;
  if (s->known && memcmp(s->x, x, s->args.n * sizeof *x) == 0)
    return 1; /* constraints use the known place */
  memcpy(s->x, x, s->args.n * sizeof *x);
  s->waits = 1;
  s->known = 0;
  sw_fiber_yield(s->fiber);
  s->known = 1;
  return !s->stop;
}

static sw_status simplex_value(void *user, const double *x, size_t n SW_UNUSED, double *value,
                               sw_error *err SW_UNUSED) {
  sw_search *s = user;
  s->known = 0; /* the simplex may ask for the same place again */
  if (!sw_search_evaluate(s, x)) return SW_EINTR;
  *value = s->value;
  return SW_OK;
}

static void simplex(sw_search *s) {
  const sw_minimise_args args = {NAN, NAN, s->args.tolerance / s->args.step, 1000000};
  double x[SW_MINIMISE_MOST], step[SW_MINIMISE_MOST];
  sw_minimum found;
  sw_error err = {""};
  for (size_t i = 0; i < s->args.n; i++) {
    x[i] = s->start[i];
    step[i] = x[i] > 0.5 ? -s->args.step : s->args.step;
  }
  const sw_status status =
      sw_minimise_simplex(simplex_value, s, s->args.n, x, step, &args, NULL, &found, &err);
  s->ok = status == SW_OK && found.ok;
  s->reason = status == SW_OK ? found.reason : err;
}

static void run(void *user) {
  sw_search *s = user;
  if (strcmp(s->args.method, "simplex") == 0)
    simplex(s);
  else
    sw_search_nlopt(s);
}

static sw_status check(const sw_search_args *a, sw_error *err) {
  const int is_simplex = strcmp(a->method, "simplex") == 0;
  const size_t most = is_simplex ? SW_MINIMISE_MOST : SW_SEARCH_MOST;
  if (!is_simplex && !sw_search_is_nlopt(a->method))
    return sw_fail(err, SW_EINVAL, "there is no search method '%s'", a->method);
  if (a->n < 1 || a->n > most || a->constraints > SW_SEARCH_MOST)
    return sw_fail(err, SW_EINVAL, "method = '%s' is for 1 to %zu parameters, not %zu", a->method,
                   most, a->n);
  if (strcmp(a->method, "crs2") == 0 && drawing)
    return sw_fail(err, SW_EBUSY, "another search by crs2 is under way");
  return SW_OK;
}

/* Returns a constant copy of a method's name. */
static const char *name_of(const char *method) {
  static const char *const names[] = {"simplex", "bobyqa", "cobyla", "direct", "crs2"};
  for (size_t k = 0; k < sizeof names / sizeof *names; k++)
    if (strcmp(names[k], method) == 0) return names[k];
  return "";
}

sw_status sw_search_new(const sw_search_args *args, sw_search **out, sw_error *err) {
  SW_TRY(check(args, err));
  const size_t n = args->n;
  sw_search *s = sw_alloc(1, sizeof *s);
  double *numbers = sw_alloc(2 * n + args->constraints, sizeof *numbers);
  sw_fiber *fiber = s && numbers ? sw_fiber_new(run, s) : NULL;
  if (!fiber) {
    sw_free(s);
    sw_free(numbers);
    return sw_fail(err, SW_ENOMEM, "out of memory");
  }
  s->args = *args;
  s->args.method = name_of(args->method);
  s->start = numbers, s->x = numbers + n, s->broken = numbers + 2 * n;
  memcpy(s->start, args->start, n * sizeof *numbers);
  s->args.start = s->start;
  s->fiber = fiber;
  if (strcmp(s->args.method, "crs2") == 0) drawing = s;
  *out = s;
  return SW_OK;
}

int sw_search_ask(sw_search *s, double *x) {
  s->begun = 1;
  if (!s->waits && !sw_fiber_resume(s->fiber)) return 0;
  memcpy(x, s->x, s->args.n * sizeof *x);
  return 1;
}

void sw_search_tell(sw_search *s, double value, const double *broken) {
  if (!s->waits) return;
  s->value = value;
  for (size_t k = 0; k < s->args.constraints; k++) s->broken[k] = broken[k];
  s->waits = 0;
}

const char *sw_search_reason(const sw_search *s, int *ok) {
  *ok = s->ok;
  return s->reason.text;
}

void sw_search_free(sw_search *s) {
  if (!s) return;
  s->stop = 1;
  if (s->begun) sw_fiber_resume(s->fiber); /* runs it to its end, where it frees its memory */
  if (drawing == s) drawing = NULL;
  sw_fiber_free(s->fiber);
  sw_free(s->start);
  sw_free(s);
}
