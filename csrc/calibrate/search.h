/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Minimisers that are asked for a place and told its value, in the cube from 0 to 1. */
#ifndef SW_CALIBRATE_SEARCH_H
#define SW_CALIBRATE_SEARCH_H

#include <stddef.h>

#include "base/status.h"

enum { SW_SEARCH_MOST = 64 }; /* parameters, and constraints [-] */

typedef struct sw_search_args {
  const char *method;    /* "simplex", "bobyqa", "cobyla", "direct" or "crs2" */
  size_t n, constraints; /* parameters; constraints, for cobyla only [-] */
  const double *start;   /* n places from 0 to 1; read at once [-] */
  double step;           /* the first, as a share of the range [-] */
  double tolerance;      /* wanted accuracy as a share of the range [-] */
  unsigned long seed;    /* of crs2 [-] */
} sw_search_args;

typedef struct sw_search sw_search;

/* SW_EINVAL for an unknown method or a size that it cannot do, SW_EBUSY for a second crs2 at a
 * time, since NLopt has one stream of random numbers; SW_ENOMEM. */
sw_status sw_search_new(const sw_search_args *args, sw_search **out, sw_error *err);

/* The place that is wanted next: 1 and x (n numbers); 0 when it has ended. The simplex is not
 * bounded, its places are to be folded into the cube. */
int sw_search_ask(sw_search *s, double *x);

/* Its value, finite, and by how much each constraint is broken (below 0: it is met). */
void sw_search_tell(sw_search *s, double value, const double *broken);

/* Of one that has ended: why, and was it as near as wanted. */
const char *sw_search_reason(const sw_search *s, int *ok);

/* NULL is allowed. */
void sw_search_free(sw_search *s);

#endif
