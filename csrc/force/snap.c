/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energy loss of a wire that snaps into a clip. On the lips' inner flank and in the seat a dashpot
 * resists inward motion, f = -c u' for u' < 0, spread over the width like the clip. With c = 2
 * retention time / out, out being the length of that flank, the lips' own pull moves the wire along
 * the flank within about `time`. Without it a light wire would arrive at metres per second, bounce
 * and come out again, which wires in plastic clips do not do. Outward motion, the outer flank and a
 * wire at rest see no force: insertion and retention forces are the clip's alone. The time is
 * chosen, not measured. */
#include <math.h>
#include <stddef.h>

#include "force/clip_sum.h"
#include "force/force.h"

typedef struct snap_args {
  sw_clip_args clip; /* its stiffness holds the time [s] */
} snap_args;

static const sw_param rows[] = {
    SW_CLIP_ROWS,
    {"time", SW_PARAM_NUMBER, "s", 2e-3, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_clip_args, stiffness), "time that the lips take to pull the wire in"},
};

/* Returns the share of the dashpot that acts at height u: all of it below the middle of the flank
 * [-]. */
static double share_at(const sw_clip_law *l, double u) {
  const double x = 2.0 * (l->out - u) / l->out;
  return x <= 0 ? 0.0 : x >= 1 ? 1.0 : x * x * (3.0 - 2.0 * x);
}

static void add_edge(const sw_clip *c, double damping, sw_field *f, size_t e) {
  const double va = sw_dot(c->direction, sw_axis_velocity(f, e));
  const double vb = sw_dot(c->direction, sw_axis_velocity(f, e + 1));
  sw_clip_walk w;
  sw_clip_sum sum = {0};
  double x[3], t, chi[3];
  if (!(va < 0 || vb < 0)) return;
  if (!sw_clip_begin(c, f, e, &w) || sw_clip_far(c, &w)) return;
  while (sw_clip_next(&w, x, &t, chi)) {
    const double speed = va + t * (vb - va);
    if (!(speed < 0) || x[0] < -c->law.clearance - 2.0 * c->law.reach) continue;
    const double here =
        damping * w.weight * chi[0] * share_at(&c->law, x[0]) * sw_clip_between(&c->law, x[1]);
    sum.g[0][0] += (1.0 - t) * here * speed, sum.g[1][0] += t * here * speed;
    sum.own[0][0] += (1.0 - t) * (1.0 - t) * here * f->velocity_rate;
    sum.own[1][0] += t * t * here * f->velocity_rate;
    sum.next[0] += t * (1.0 - t) * here * f->velocity_rate;
  }
  sw_clip_on_edge(c, f, e, &sum);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  sw_clip_args a = ((const snap_args *)args)->clip;
  const double time = a.stiffness;
  (void)err;
  a.stiffness = a.strength = NAN;
  const sw_clip c = sw_clip_of(&a, &f->plan->beam);
  for (long e = sw_clip_find(&c, f, 0); e >= 0; e = sw_clip_find(&c, f, e + 1))
    add_edge(&c, 2.0 * a.retention * time / c.law.out, f, (size_t)e);
  return SW_OK;
}

static sw_status check(const void *args, const sw_beam *beam, sw_error *err) {
  (void)beam;
  return sw_clip_check_lips(&((const snap_args *)args)->clip, "snap", err);
}

const sw_force_class sw_force_snap = {
    .name = "snap",
    .summary = "energy that a clip's lips take from a wire that snaps in; part of scene:clip",
    .flags = SW_FORCE_DISSIPATIVE | SW_FORCE_ANY_BODY | SW_FORCE_OF_AXIS | SW_FORCE_FROZEN,
    .params = SW_PARAMS("force snap", rows),
    .check = check,
    .eval = eval,
};
