/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion laws: where a moving frame (grip, clamp, obstacle) is at time t, with
 * its exact first and second derivatives. Immutable and reference-counted, so
 * that one law may drive several things. */
#ifndef SW_MOTION_MOTION_H
#define SW_MOTION_MOTION_H

#include <stddef.h>

#include "base/param.h"
#include "base/status.h"
#include "base/vec.h"

typedef struct sw_motion sw_motion;

typedef struct sw_motion_state {
  sw_pose pose;  /* position [m] and orientation [-] */
  sw_vec v;      /* velocity of the frame's origin [m/s] */
  sw_vec a;      /* its acceleration [m/s2] */
  sw_vec omega;  /* angular velocity, world axes [rad/s] */
  sw_vec alpha;  /* angular acceleration, world axes [rad/s2] */
} sw_motion_state;

/* Evaluate at time t [s]; before the start and after the end the law rests at
 * its first and last pose. Fails only when a user callback does. */
sw_status sw_motion_eval(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err);

double sw_motion_duration(const sw_motion *motion); /* [s]; INFINITY for a callback law */

sw_motion *sw_motion_retain(sw_motion *motion); /* NULL gives NULL */
void sw_motion_release(sw_motion *motion);      /* NULL is allowed */

#endif
