/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constant speed along the legs, without ramps: the speed jumps at both ends, and its direction
 * jumps at corners that are not blended. */
#include "motion/law.h"

static double least_time(double span, double growth SW_UNUSED) { return span; }

static int fit(sw_run *run, double growth SW_UNUSED) {
  run->ramp = 0;
  return 1;
}

static void progress(const sw_run *run, double t, double s[3]) {
  s[1] = run->span / run->time;
  s[0] = s[1] * t;
  s[2] = 0;
}

static const sw_profile profile = {0, least_time, fit, progress};

const sw_motion_law sw_motion_law_linear = {"linear", &profile, sw_path_plan, sw_path_eval,
                                            sw_path_destroy};
