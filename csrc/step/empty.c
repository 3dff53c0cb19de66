/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step of a scene after all its wires have left. Nothing is solved. Obstacles and grippers follow
 * their motions, which are functions of time; jaws open and close. All of it is recorded. */
#include <math.h>

#include "base/quota.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "step/energy.h"
#include "step/jaw.h"
#include "step/ladder.h"
#include "step/run.h"

sw_status sw_step_empty(sw_ladder *p, double t1, sw_error *err) {
  sw_scene *s = p->s;
  const double h = t1 - sw_scene_time(s);
  SW_TRY(sw_quota_take(err));
  SW_TRY(sw_ledger_open(s, err));
  (void)sw_jaw_begin(s, h); /* no force can be too large here */
  sw_scene_set_time(s, t1);
  sw_scene_course(s)->span = h;
  p->report->steps++;
  p->report->smallest_dt = fmin(p->report->smallest_dt, h);
  SW_TRY(sw_step_observe(s, err));
  int jumped = 0;
  return sw_ledger_pose(s, t1 - h, 0, &jumped, 0, 0, err);
}
