/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef SW_CALIBRATE_SEARCH_INNER_H
#define SW_CALIBRATE_SEARCH_INNER_H

#include "calibrate/fiber.h"
#include "calibrate/search.h"

struct sw_search {
  sw_search_args args; /* start: into numbers below */
  sw_fiber *fiber;
  double *start, *x, *broken; /* n, n and constraints numbers */
  double value;               /* of x [-] */
  int begun, waits;           /* for the value of x */
  int known;                  /* 1: value and broken belong to x */
  int stop;                   /* nothing is evaluated any more */
  int ok;
  sw_error reason;
};

/* On the fiber: the value at x, once somebody has told it; 0 when the search is to stop. */
int sw_search_evaluate(sw_search *s, const double *x);

/* On the fiber: one of NLopt's; sets ok and reason. */
void sw_search_nlopt(sw_search *s);

/* Does NLopt have it? Second, for how few and how many parameters it is. */
int sw_search_is_nlopt(const char *method);

#endif
