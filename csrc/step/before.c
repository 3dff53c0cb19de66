/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brings wires to rest before obstacles move. Wires may start far from equilibrium (drawn straight,
 * or released). The search cannot bring them to rest while obstacles drag them: continuation then
 * takes steps so long that inertia gives no direction, and Newton's iteration may end anywhere.
 * With obstacles at rest both find the equilibrium. */
#include <math.h>

#include "body/live.h"
#include "scene/parts.h"
#include "step/statics.h"
#include "system/system.h"

/* Wires are already at rest if the search shifts them by less than this share of the longest wire
 * [-]. */
static const double AT_REST = 1e-4;

/* Finds the equilibrium with holds and obstacles at rest. *far: 1 if it is far from the start. */
static sw_status find(sw_statics *p, int *far, sw_error *err) {
  sw_status status = sw_rest_newton(p, SW_REST_ITERATIONS, err);
  if (sw_rest_stops(status)) return status;
  if (status != SW_OK || p->report->negative > 0) {
    sw_rest_take_back(p->s, p->kept);
    status = sw_rest_continue(p, err);
  }
  *far = status == SW_OK && sw_rest_shift_from(p, p->kept) > AT_REST * sw_rest_longest(p->s);
  return status;
}

sw_status sw_rest_before(sw_statics *p, int *fell, sw_error *err) {
  sw_scene *s = p->s;
  double part;
  const sw_pose *const from = sw_scene_part(s, &part);
  const double now = sw_scene_time(s), touched = p->touched;
  const double leads = p->leads;
  const int most_far = p->most_far, transient = p->report->transient;
  const size_t negative = p->report->negative;
  sw_tape start = {0};
  sw_error why = {"out of memory"};
  *fell = 0;
  sw_status status = sw_live_take(s, &start);
  if (status == SW_OK) {
    sw_scene_set_time(s, touched), sw_scene_go_part(s, p->from_poses, 0);
    p->most_far = 0, p->leads = 0;
    status = find(p, fell, &why);
    sw_scene_set_time(s, now), sw_scene_go_part(s, from, part);
    p->leads = leads;
    p->most_far = most_far, p->touched = touched, p->report->transient = transient;
  }
  if (sw_rest_stops(status)) {
    sw_fail(err, status, "%s", why.text);
  } else if (!*fell) {
    status = sw_live_back(s, &start, err);
    p->report->negative = negative;
  }
  sw_tape_free(&start);
  return status;
}
