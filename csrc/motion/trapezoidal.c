/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constant acceleration, constant speed, constant deceleration. If no acceleration is given, each
 * takes a third of the time, so the highest speed is 1.5 times the mean. A run too short to reach
 * the highest speed accelerates for one half and decelerates for the other. */
#include "motion/law.h"

static double least_time(double span, double growth) {
  if (growth == HUGE_VAL) return 1.5 * span;
  return span * growth >= 1 ? span + 1 / growth : 2 * sqrt(span / growth);
}

static int fit(sw_run *run, double growth) {
  if (growth == HUGE_VAL) {
    run->ramp = run->time / 3;
    return 1;
  }
  /* span = growth ramp (time - ramp) */
  const double rest = run->time * run->time - 4 * run->span / growth;
  if (rest < -1e-9 * run->time * run->time) return 0;
  const double root = rest > 0 ? sqrt(rest) : 0;
  run->ramp = 2 * run->span / growth / (run->time + root);
  return 1;
}

static void progress(const sw_run *run, double t, double s[3]) {
  if (!(run->ramp > 0)) { /* an empty run, or no time to ramp in */
    s[1] = run->span / run->time, s[0] = s[1] * t, s[2] = 0;
    return;
  }
  const double rate = run->span / (run->time - run->ramp), growth = rate / run->ramp;
  const double left = run->time - t;
  if (t < run->ramp) {
    s[0] = 0.5 * growth * t * t, s[1] = growth * t, s[2] = growth;
  } else if (left >= run->ramp) {
    s[0] = rate * (t - 0.5 * run->ramp), s[1] = rate, s[2] = 0;
  } else {
    s[0] = run->span - 0.5 * growth * left * left, s[1] = growth * left, s[2] = -growth;
  }
}

static const sw_profile profile = {1, least_time, fit, progress};

const sw_motion_law sw_motion_law_trapezoidal = {"trapezoidal", &profile, sw_path_plan,
                                                 sw_path_eval, sw_path_destroy};
