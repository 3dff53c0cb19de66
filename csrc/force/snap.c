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

/* An edge's part of the dashpot; it acts along the clip's direction alone. */
typedef struct snap_sum {
  double force[2];     /* on the ends, against the direction [N] */
  double own[2], next; /* stiffness of each end, coupling of both [N/m] */
} snap_sum;

/* Fills the stiffness k along a unit vector. */
static void stiffness_along(sw_vec d, double k, double K[9]) {
  const double axis[3] = {d.x, d.y, d.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) K[3 * i + j] = axis[i] * (k * axis[j]);
}

/* Adds the sum to the wire. A mesh's coupling is lumped into each ring's own stiffness. */
static void put(const sw_clip *c, sw_field *f, size_t e, const snap_sum *sum) {
  const int stiffness = (f->want & SW_WANT_STIFFNESS) != 0, mesh = f->plan->web != NULL;
  double K[9];
  for (size_t end = 0; end < 2; end++) {
    if (stiffness) stiffness_along(c->direction, sum->own[end] + (mesh ? sum->next : 0.0), K);
    sw_axis_put(f, e + end, sw_scale(c->direction, -sum->force[end]), stiffness ? K : NULL);
  }
  if (!stiffness || mesh) return;
  stiffness_along(c->direction, sum->next, K);
  for (int k = 0; k < 9; k++) f->rows[SW_FIELD_ROW * e + 6 + (size_t)k] += K[k];
}

static void add_edge(const sw_clip *c, double damping, sw_field *f, size_t e) {
  const double va = sw_dot(c->direction, sw_axis_velocity(f, e));
  const double vb = sw_dot(c->direction, sw_axis_velocity(f, e + 1));
  sw_clip_walk w;
  snap_sum sum = {0};
  double x[3], t, chi[3];
  if (!(va < 0 || vb < 0)) return;
  if (!sw_clip_begin(c, f, e, &w) || sw_clip_far(c, &w)) return;
  if (fmin(w.a[0], w.b[0]) >= c->law.out) return; /* on the outer flank or above */
  while (sw_clip_next(&w, x, &t, chi)) {
    const double speed = va + t * (vb - va), share = share_at(&c->law, x[0]);
    if (!(speed < 0 && share > 0) || x[0] < -c->law.clearance - 2.0 * c->law.reach) continue;
    const double here = damping * w.weight * chi[0] * share * sw_clip_between(&c->law, x[1]);
    sum.force[0] += (1.0 - t) * here * speed, sum.force[1] += t * here * speed;
    sum.own[0] += (1.0 - t) * (1.0 - t) * here * f->velocity_rate;
    sum.own[1] += t * t * here * f->velocity_rate;
    sum.next += t * (1.0 - t) * here * f->velocity_rate;
  }
  put(c, f, e, &sum);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  sw_clip_args a = ((const snap_args *)args)->clip;
  const double time = a.stiffness;
  a.stiffness = a.strength = NAN;
  const sw_clip c = sw_clip_of(&a, &f->plan->beam);
  for (long e = sw_clip_find(&c, f, 0); e >= 0; e = sw_clip_find(&c, f, e + 1))
    add_edge(&c, 2.0 * a.retention * time / c.law.out, f, (size_t)e);
  return SW_OK;
}

static sw_status check(const void *args, const sw_beam *beam SW_UNUSED, sw_error *err) {
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
