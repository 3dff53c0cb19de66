/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Minimum of an expensive function (a settle, a run), of one parameter in an interval or of several
 * from a start. No derivatives. Values that are not finite count as worse than all others. */
#ifndef SW_CALIBRATE_MINIMISE_H
#define SW_CALIBRATE_MINIMISE_H

#include <stddef.h>

#include "base/param.h"
#include "base/status.h"

enum { SW_MINIMISE_MOST = 32 }; /* most parameters of one search [-] */

/* Computes *value at the n parameters x. SW_ECALLBACK stops the search. */
typedef sw_status (*sw_objective)(void *user, const double *x, size_t n, double *value,
                                  sw_error *err);

typedef struct sw_minimise_args {
  double from, to;     /* interval of one parameter; NAN if none [its unit] */
  double tolerance;    /* accuracy as a share of the interval, or of the steps [-] */
  long max_iterations; /* [-] */
} sw_minimise_args;
extern const sw_params sw_minimise_params; /* also f, start and step, which the caller reads */

typedef struct sw_minimum {
  int ok;
  double value;                              /* at x [-] */
  size_t iterations, evaluations, nonfinite; /* [-] */
  sw_error reason;                           /* why it ended, also if ok */
} sw_minimum;

/* Brent's method between args->from and args->to, after a few evaluations that bracket the minimum.
 * *x: its place. If the smallest value is at an end of the interval, ok = 0. interrupted (may be
 * NULL) is polled. */
sw_status sw_minimise_interval(sw_objective f, void *user, const sw_minimise_args *args,
                               int (*interrupted)(void), double *x, sw_minimum *out, sw_error *err);

/* The simplex method of Nelder and Mead from x (n values, replaced by the best place), with first
 * steps `step`, none of them 0. */
sw_status sw_minimise_simplex(sw_objective f, void *user, size_t n, double *x, const double *step,
                              const sw_minimise_args *args, int (*interrupted)(void),
                              sw_minimum *out, sw_error *err);

#endif
