/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef SW_CALIBRATE_SEARCH_INNER_H
#define SW_CALIBRATE_SEARCH_INNER_H

#include "calibrate/fiber.h"
#include "calibrate/search.h"

struct sw_search {
  sw_search_args args; /* its start points to `start` below */
  sw_fiber *fiber;
  double *start, *x, *broken; /* n, n and `constraints` numbers */
  double value;               /* of x [-] */
  int begun, waits;           /* waits: 1 while the value of x is missing */
  int known;                  /* 1: value and broken belong to x */
  int stop;                   /* 1: evaluate nothing any more */
  int ok;
  sw_error reason;
};

/* On the fiber: gets the value at x from the caller; 0: the search must stop. */
int sw_search_evaluate(sw_search *s, const double *x);

/* On the fiber: runs one of NLopt's methods; sets ok and reason. */
void sw_search_nlopt(sw_search *s);

/* 1 if NLopt has this method. */
int sw_search_is_nlopt(const char *method);

#endif
