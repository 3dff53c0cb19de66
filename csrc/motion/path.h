/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Paths: legs with blended corners, and the runs in which they are travelled. */
#ifndef SW_MOTION_PATH_H
#define SW_MOTION_PATH_H

#include "motion/law.h"

/* A leg, prepared for evaluation. Rates are derivatives by progress [s]. */
typedef struct sw_segment {
  double s;     /* progress at its start, from the start of its run [s] */
  double time;  /* progress made on it [s] */
  double blend; /* half width of the corner at its start [s] */
  sw_vec p, d;  /* start [m], rate [m/s] */
  sw_quat q;    /* orientation at the start [-] */
  sw_vec w;     /* rate of turning in the axes of the start [rad/s] */
  sw_vec world; /* the same in world axes [rad/s] */
  int turns;    /* w is not 0 [-] */
} sw_segment;

typedef struct sw_path {
  const sw_profile *profile;
  sw_segment *segments;
  sw_run *runs;
  size_t segment_count, run_count; /* [-] */
} sw_path;

/* Length of the blended corner between two segments [m]. */
double sw_path_corner_length(const sw_segment *in, const sw_segment *out);

#endif
