/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What moves a hold or an obstacle. */
#include <math.h>
#include <string.h>

#include "scene/world.h"

void sw_drive_free(sw_drive *d) {
  sw_motion_release(d->motion);
  d->motion = NULL;
}

/* A motion on top of a base pose: the law's displacement is in world axes, its
 * turn about the base's origin. */
static void compose(const sw_pose *base, sw_motion_state *m) {
  m->pose.p = sw_add(base->p, m->pose.p);
  m->pose.q = sw_quat_unit(sw_quat_mul(m->pose.q, base->q));
}

sw_status sw_drive_eval(const sw_drive *d, double t, sw_motion_state *out, sw_error *err) {
  if (!d->motion) {
    memset(out, 0, sizeof *out);
    out->pose = d->pose;
    return SW_OK;
  }
  SW_TRY(sw_motion_eval(d->motion, t - d->start, out, err));
  if (d->relative) compose(&d->pose, out);
  return SW_OK;
}

static const double LARGEST_JUMP = 1e-6; /* of position, taken as rounding [m] */
static const double LARGEST_TURN = 1e-6; /* of orientation, taken as rounding [rad] */

sw_status sw_drive_follow(sw_drive *d, const char *object, double now, sw_motion *motion,
                          int relative, sw_error *err) {
  sw_motion_state here, first;
  SW_TRY(sw_drive_eval(d, now, &here, err));
  sw_drive next = {.pose = here.pose};
  if (motion) {
    next = (sw_drive){here.pose, motion, now, relative};
    SW_TRY(sw_drive_eval(&next, now, &first, err));
    const double jump = sw_dist(first.pose.p, here.pose.p);
    const double turn =
        sw_norm(sw_quat_log(sw_quat_mul(first.pose.q, sw_quat_conj(here.pose.q))));
    if (!(jump <= LARGEST_JUMP) || !(turn <= LARGEST_TURN))
      return sw_fail(err, SW_EINVAL,
                     "%s: the trajectory starts at (%g, %g, %g) m, %.4g m and %.3g rad away from "
                     "where it is; start it there or give relative = true",
                     object, first.pose.p.x, first.pose.p.y, first.pose.p.z, jump, turn);
  }
  sw_motion_retain(motion);
  sw_drive_free(d);
  *d = next;
  return SW_OK;
}
