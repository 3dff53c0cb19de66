/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Minimisers in the cube from 0 to 1 that are asked for places and told their values. */
#ifndef SW_CALIBRATE_SEARCH_H
#define SW_CALIBRATE_SEARCH_H

#include <stddef.h>

#include "base/status.h"

enum { SW_SEARCH_MOST = 64 }; /* most parameters, and most constraints [-] */

typedef struct sw_search_args {
  const char *method;    /* "simplex", "bobyqa", "cobyla", "direct" or "crs2" */
  size_t n, constraints; /* parameters; constraints, for cobyla only [-] */
  const double *start;   /* n numbers from 0 to 1; copied [-] */
  double step;           /* first step, over the range [-] */
  double tolerance;      /* accuracy, over the range [-] */
  unsigned long seed;    /* of crs2 [-] */
} sw_search_args;

typedef struct sw_search sw_search;

/* SW_EINVAL for an unknown method or an unsuitable size; SW_EBUSY for a second crs2 at a time,
 * because NLopt has a single random number stream; SW_ENOMEM. */
sw_status sw_search_new(const sw_search_args *args, sw_search **out, sw_error *err);

/* Gets the next place to evaluate: 1 and x (n numbers); 0: the search has ended. The simplex is not
 * bounded: the caller must fold its places into the cube. */
int sw_search_ask(sw_search *s, double *x);

/* Tells the place's value, finite, and each constraint's violation (below 0: met). */
void sw_search_tell(sw_search *s, double value, const double *broken);

/* For an ended search: returns why it ended; *ok: 1 if it reached the tolerance. */
const char *sw_search_reason(const sw_search *s, int *ok);

/* NULL is allowed. */
void sw_search_free(sw_search *s);

#endif
