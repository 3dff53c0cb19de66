/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "state/first_stage.h"

#include <math.h>

/* So near a line, of the largest of all, a force grows or falls evenly: those that are found wrong
 * are off by more than ten times that [-]. */
static const double EVENLY = 0.1;
/* A force that holds against turning changes from step to step by less than this share, and the
 * last stage has less than so many times of it (sdirk2 5.1); else it is of a blow [-]. */
static const double SLOWLY = 0.5, MOST = 6.0;

/* Is the last stage's force as it should be, by that before the step and what would be even? */
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
