/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moments at which something that holds a wire starts, stops or turns a corner at once. The forces
 * of just before, with the velocity that then ends, are no start for the step after it: a method
 * that begins with them counts a dashpot's old force for part of the step, an error of first order.
 */
#include <math.h>

#include "scene/world.h"
#include "step/restart.h"

static const double BESIDE = 1e-9; /* so long before and after the moment is looked at [s] */
/* Velocities that jump by less are none: 10 nm in a step of 10 ms [m/s], [rad/s]. */
static const double NO_JUMP = 1e-6;

static int jumps(sw_vec before, sw_vec after, sw_vec rate1, sw_vec rate2) {
  const double most = NO_JUMP + 2.0 * BESIDE * (sw_norm(rate1) + sw_norm(rate2));
  return sw_dist(before, after) > most;
}

/* Functions of a script are asked for times of steps only. */
static int drive_jerks(sw_scene *s, const sw_drive *d) {
  sw_motion_state one, two;
  sw_error ignored;
  if (!d->motion || sw_motion_is_function(d->motion)) return 0;
  const double t = s->time - d->start;
  if (sw_motion_eval(d->motion, t - BESIDE, &one, &ignored) != SW_OK ||
      sw_motion_eval(d->motion, t + BESIDE, &two, &ignored) != SW_OK)
    return 0;
  return jumps(one.v, two.v, one.a, two.a) || jumps(one.omega, two.omega, one.alpha, two.alpha);
}

int sw_scene_jerks(sw_scene *s) {
  for (size_t k = 0; k < s->hold_count; k++)
    if (s->holds[k].alive && !s->holds[k].drive.tool && drive_jerks(s, &s->holds[k].drive))
      return 1;
  for (size_t k = 0; k < s->tool_count; k++)
    if (drive_jerks(s, &s->tools[k].drive)) return 1;
  return 0;
}
