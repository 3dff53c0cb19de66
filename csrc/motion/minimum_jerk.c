/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress 10 u^3 - 15 u^4 + 6 u^5, where u is the elapsed share of the time. Of all moves from
 * rest to rest in a given time this one has the least integral of squared jerk. Its highest speed
 * is 15/8 of the mean, its highest acceleration 10/sqrt(3) length / time^2. */
#include "motion/law.h"

static const double peak_growth = 5.77350269189625764509; /* 10/sqrt(3) [-] */

static double least_time(double span, double growth) {
  const double by_speed = 1.875 * span;
  const double by_growth = growth == HUGE_VAL ? 0 : sqrt(peak_growth * span / growth);
  return by_speed > by_growth ? by_speed : by_growth;
}

static int fit(sw_run *run, double growth) {
  run->ramp = 0.5 * run->time;
  return peak_growth * run->span <= growth * run->time * run->time * (1 + 1e-9);
}

static void progress(const sw_run *run, double t, double s[3]) {
  const double u = t / run->time, rest = 1 - u, rate = run->span / run->time;
  s[0] = run->span * u * u * u * (10 + u * (6 * u - 15));
  s[1] = rate * 30 * u * u * rest * rest;
  s[2] = rate / run->time * 60 * u * rest * (1 - 2 * u);
}

static const sw_profile profile = {1, least_time, fit, progress};

const sw_motion_law sw_motion_law_minimum_jerk = {"minimum-jerk", &profile, sw_path_plan,
                                                  sw_path_eval, sw_path_destroy};
