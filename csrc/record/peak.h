/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks of a recorded vector, such as a force, as means over a window of time. */
#ifndef SW_RECORD_PEAK_H
#define SW_RECORD_PEAK_H

#include <stddef.h>

/* A vector from t0 to t1; t0 = t1 at an equilibrium. */
typedef struct sw_lapse {
  double t0, t1; /* [s] */
  double v[3];   /* [the vector's unit] */
} sw_lapse;

/* Spans in the order of time. */
typedef struct sw_lapses {
  const sw_lapse *span;
  double (*sum)[3]; /* room: the integral up to the start of each [the vector's unit, s] */
  size_t count;
} sw_lapses;

/* What is not known is NAN. */
typedef struct sw_peak {
  double value, time;             /* largest mean, and the end of its window [unit], [s] */
  double raw, raw_time, raw_span; /* of a single span, its end and length [unit], [s] */
  double whole;                   /* length of a record that is shorter than the window [s] */
  double span;                    /* longest span within the peak's window [s] */
  int coarse;                     /* 1: a blow that lasts few steps */
} sw_peak;

/* Returns the peak over windows of this width [s], without span and coarse. Spans as long as the
 * window, and equilibria, are not averaged. */
sw_peak sw_peak_largest(const sw_lapses *s, double width);
/* Same with span and coarse. */
sw_peak sw_peak_of(const sw_lapses *s, double width);

/* Returns the longest span within the window that ends at a time [s]. */
double sw_peak_longest(const sw_lapses *s, double time, double width);
/* 1 if the peak (value, time and span are known) is a blow that lasts few steps: shorter steps may
 * show another peak. */
int sw_peak_is_coarse(const sw_lapses *s, const sw_peak *p, double width);

#endif
