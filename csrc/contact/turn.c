/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slips that turn round within a step. A free wire lies on an obstacle that moves to and fro. While
 * it slides, friction mu N acts one way before its velocity over the obstacle is zero, and the
 * other way after it. A step across that time has both at once: the velocity is off by up to 0.7 mu
 * g h. So the step ends at that time, and the next one starts without the old friction. Held wires
 * that swing turn all the time, and their holds correct them; they are left alone. */
#include <math.h>

#include "contact/jolt.h"
#include "contact/rebound.h"
#include "contact/touch.h"

/* Slower slips, over what friction changes in the step, count as at rest [-]. */
static const double SLOW = 0.05;
/* The wire slides as one if the sum of its slips has this share of the sum of their sizes [-]. */
static const double AS_ONE = 0.9;
/* Turns earlier and later than these shares of the step are at its start and end [-]. */
static const double AT_START = 1e-3, AT_END = 0.98;

/* A body's slip, weighted by normal forces. */
typedef struct slip {
  sw_vec before, after, wall; /* slip at the step's start and end; change of the obstacle's velocity
                                 [N m/s] */
  sw_vec way, mean;        /* way of the obstacle's point [N m], mean of its velocities [N m/s] */
  double size, force, rub; /* sum of sizes at the start [N m/s]; normal force; friction [N] */
  int slides, gripped;     /* 1: some touch slid at the end of the last solve; a pad presses */
} slip;

/* The obstacle's acceleration is even enough over the step if its mean velocity is that of both
 * ends within this share of their difference. Otherwise its velocity may have jumped at the start
 * [-]. */
static const double EVEN = 0.25;

static sw_vec across(sw_vec v, sw_vec n) { return sw_madd(v, n, -sw_dot(v, n)); }

/* Adds a touch. v1: velocities at the step's end. over: the step was accepted, and the system is at
 * its end; the slip at its start is then not known. */
static void add(const sw_contact *c, const sw_system *s, const sw_touch *t, const double *v1,
                int over, slip *sum) {
  const double N = t->press.normal_force;
  const sw_vec n = t->press.normal;
  if (N > 0) sum->gripped |= c->obstacles[t->obstacle].grips > 0;
  if (!(N > 0) || !c->broad.moves[t->obstacle]) return;
  const sw_contact_at *from = &c->start[t->obstacle], *to = &c->now[t->obstacle];
  const sw_vec here = sw_pose_point(from->pose, sw_pose_local(to->pose, t->point));
  const sw_vec part =
      sw_obstacle_velocity(from, here); /* of the obstacle's part that is here now */
  const sw_vec was = over ? part : sw_obstacle_velocity_before(c, s, t);
  const sw_vec is = sw_obstacle_velocity(to, t->point);
  const sw_vec before = across(sw_sub(sw_mean_of(s->v, 0, &t->spot), was), n);
  sum->before = sw_madd(sum->before, before, N);
  sum->after = sw_madd(sum->after, across(sw_sub(sw_mean_of(v1, 0, &t->spot), is), n), N);
  sum->wall = sw_madd(sum->wall, across(sw_sub(is, was), n), N);
  sum->size += N * sw_norm(before);
  sum->force += N;
  sum->way = sw_madd(sum->way, sw_sub(t->point, here), N);
  sum->mean = sw_madd(sum->mean, sw_add(part, is), 0.5 * N);
  sum->rub += t->friction * N;
  sum->slides |= t->press.sliding;
}

/* Sums the slip of the free wire at touch *i and goes on to the next wire. Returns its mass; 0:
 * it is not free [kg]. */
static double next_slip(const sw_contact *c, const sw_system *s, size_t *i, const double *v1,
                        int over, slip *sum) {
  const size_t body = c->touches[*i].body;
  const sw_body *b = &s->bodies[body];
  *sum = (slip){.size = 0};
  for (; *i < c->touch_count && c->touches[*i].body == body; ++*i)
    add(c, s, &c->touches[*i], v1, over, sum);
  const int free = !b->held && !b->coupled && !b->roll_block && !sum->gripped;
  return free ? b->plan->beam.mass * b->plan->length : 0.0;
}

/* Slip below which a wire is at rest on the obstacle [N m/s]. */
static double slow_of(const slip *sum, double mass, double h) {
  return SLOW * sum->rub / mass * h * sum->force;
}

/* 1 if the obstacle's velocity changed in a step of h by more than rest. Otherwise the scene is
 * that with a standing obstacle, in a frame that moves. */
static int hurries(const slip *sum, double mass, double h) {
  return sum->rub > 0 && sw_norm(sum->wall) > slow_of(sum, mass, h);
}

/* Returns when the slip is zero, after the step's start; HUGE_VAL: it does not turn [s]. */
static double turns_at(const slip *sum, double mass, double h) {
  const double before = sw_norm(sum->before), slow = slow_of(sum, mass, h);
  if (!(before > slow) || before < AS_ONE * sum->size || !hurries(sum, mass, h)) return HUGE_VAL;
  if (!(sw_dot(sum->before, sum->after) < slow * before)) return HUGE_VAL;
  const sw_vec off = sw_madd(sum->mean, sum->way, -1.0 / h);
  if (sw_norm(off) > EVEN * sw_norm(sum->wall)) return HUGE_VAL;
  const double gains = sw_dot(sum->wall, sum->before) / (before * sum->force * h);
  const double slows = sum->rub / mass + gains; /* [m/s2] */
  return slows > 0 ? before / (sum->force * slows) : HUGE_VAL;
}

int sw_contact_turns(sw_contact *c, const sw_system *s, const double *v1, double h) {
  slip sum;
  if (c->regime != SW_CONTACT_IMPLICIT || !c->broad.mover_count || !isfinite(c->least)) return 0;
  for (size_t i = 0; i < c->touch_count;) {
    const double mass = next_slip(c, s, &i, v1, 0, &sum);
    const double at = mass > 0 ? turns_at(&sum, mass, h) : HUGE_VAL;
    if (at > AT_START * h && at < AT_END * h) c->soonest = fmin(c->soonest, at);
  }
  return c->soonest < h;
}

int sw_contact_turned(const sw_contact *c, const sw_system *s, double h) {
  slip sum;
  if (c->regime != SW_CONTACT_IMPLICIT || !c->broad.mover_count) return 0;
  for (size_t i = 0; i < c->touch_count;) {
    const double mass = next_slip(c, s, &i, s->v, 1, &sum);
    if (mass > 0 && sum.slides && hurries(&sum, mass, c->h) &&
        sw_norm(sum.after) < slow_of(&sum, mass, h))
      return 1;
  }
  return 0;
}
