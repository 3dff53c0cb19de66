/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces between a step's two stages, and which of them are right. */
#include "state/first_stage.h"

#include <math.h>

/* A force within this distance of a straight line, over the largest of its three values, changes
 * linearly. Wrong forces are off by more than ten times that [-]. */
static const double EVENLY = 0.1;
/* A force that holds against turning changes from step to step by less than SLOWLY of its value,
 * and at the last stage it is below MOST times that value (sdirk2: 5.1). Any other force comes from
 * a blow [-]. */
static const double SLOWLY = 0.5, MOST = 6.0;

/* 1 if the last stage's force is right, judged by the value before the step and by the mix `even`.
 */
static int holds(const sw_first_stage *at, sw_vec before, sw_vec first, sw_vec now, sw_vec even) {
  const double size = sw_norm(before);
  const sw_vec line = sw_madd(before, sw_sub(first, before), 1.0 / at->time);
  const double most = fmax(size, fmax(sw_norm(first), sw_norm(now)));
  return sw_dist(line, now) <= EVENLY * most || sw_dist(even, before) > SLOWLY * size ||
         sw_norm(now) > MOST * size;
}

sw_vec sw_even_force(const sw_first_stage *at, const sw_vec *before, sw_vec first, sw_vec now) {
  if (!at->x) return now;
  const sw_vec even = sw_madd(first, sw_sub(now, first), at->share);
  return before && holds(at, *before, first, now, even) ? now : even;
}

/* A force that changes in a step by less than SLOW of its value, and is below LARGE times that
 * value at the last stage (sdirk2: 5.1), comes from no blow; beyond FAST or LARGEST it comes from a
 * blow. Between these it counts as partly so [-]. */
static const double SLOW = 0.25, FAST = 0.5, LARGE = 6.0, LARGEST = 8.0;

/* Returns 1 for x up to `from`, 0 from `to` on, and a straight line between them. */
static double falls(double x, double from, double to) {
  return fmin(1.0, fmax(0.0, (to - x) / (to - from)));
}

double sw_obeyed_force(double before, double read, double now) {
  const double size = fabs(before);
  if (!(size > 0)) return now;
  const double share =
      fmin(falls(fabs(read - before) / size, SLOW, FAST), falls(fabs(now) / size, LARGE, LARGEST));
  return now + share * (read - now);
}
