/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the times at which the acceleration of a user's function jumps. Its accelerations are those
 * of three poses, a difference step apart. So on both sides of a jump, a little away from it, they
 * are even; at a jump of velocity or place they are large for a moment only. */
#include <math.h>

#include "motion/law.h"

/* Smaller jumps are left alone, and jumps by less than a share of the larger acceleration beside
 * them: a function may interpolate between samples [m/s2], [rad/s2], [-]. */
static const double LEAST = 0.1, SHARE = 0.25;
/* Beside a jump accelerations differ by less than this share of it [-]. */
static const double EVEN = 0.25;
/* A change that is more than this share of itself off the slopes beside it is a jump. Where an
 * acceleration crosses zero evenly, the slopes explain all of it [-]. */
static const double SUDDEN = 1.0 / 3.0;
/* A jump keeps more than this share of a change in one half of the time; an even change leaves half
 * of it in each [-]. */
static const double AT_ONCE = 0.8;
/* Accelerations are compared this far from a time that may be a jump, and again this much further
 * away. A jump is looked for in shorter and shorter times until they are this short (above 2
 * BESIDE); all in difference steps [-]. */
static const double BESIDE = 2, FURTHER = 1, SHORT = 5;
/* Jumps earlier than this count as at the start; in difference steps [-]. */
static const double AT_START = 0.5;
/* Where a part ends at a jump, the time found for it is up to a third of a difference step too
 * early. The rest would be a part of its own, so short that forces come from errors of the
 * velocities. Jumps this near to the end count as at the end; in difference steps, and at most this
 * share of the part [-]. */
static const double AT_END = 0.5, END_SHARE = 0.1;

static double change(const sw_motion_state *a, const sw_motion_state *b) {
  return sw_dist(a->a, b->a) + sw_dist(a->alpha, b->alpha);
}

static double rate(const sw_motion_state *a) { return sw_norm(a->a) + sw_norm(a->alpha); }

static int is_jump(const sw_motion_state *a, const sw_motion_state *b) {
  return change(a, b) > fmax(LEAST, SHARE * fmax(rate(a), rate(b)));
}

/* What the slopes before and after do not explain of the change from b to c. u, v: their times over
 * those of the slopes, a to b and c to d [m/s2], [rad/s2]. */
static sw_vec sudden(sw_vec a, sw_vec b, sw_vec c, sw_vec d, double u, double v) {
  return sw_madd(sw_madd(sw_sub(c, b), sw_sub(b, a), -u), sw_sub(d, c), -v);
}

/* *even: 1 if accelerations are even on both sides of a jump. t: times of `before` and `after`,
 * which are beside it, between two times further away, at which both are set [s]. */
static sw_status is_even(const sw_motion *m, const double t[4], sw_motion_state *before,
                         sw_motion_state *after, int *even, sw_error *err) {
  const double all = change(before, after), gap = t[2] - t[1];
  const sw_motion_state b = *before, c = *after;
  SW_TRY(sw_motion_eval(m, t[0], before, err));
  SW_TRY(sw_motion_eval(m, t[3], after, err));
  const int both = t[3] > t[2]; /* a step may end beside a jump */
  const double u = (both ? 0.5 : 1.0) * gap / (t[1] - t[0]),
               v = both ? 0.5 * gap / (t[3] - t[2]) : 0;
  const double off = sw_norm(sudden(before->a, b.a, c.a, after->a, u, v)) +
                     sw_norm(sudden(before->alpha, b.alpha, c.alpha, after->alpha, u, v));
  const double uneven = fmax(change(&b, before), change(&c, after));
  *even = uneven <= EVEN * all && off > SUDDEN * all;
  return SW_OK;
}

/* Time from a jump by `all` until a later time, by how far the way has left the parabola from
 * before, after a time h [s]. */
static double since(const sw_motion_state *before, const sw_motion_state *after, double h) {
  const sw_vec way = sw_madd(sw_madd(sw_sub(after->pose.p, before->pose.p), before->v, -h),
                             before->a, -0.5 * h * h);
  const sw_vec turn =
      sw_madd(sw_madd(sw_quat_log(sw_quat_mul(after->pose.q, sw_quat_conj(before->pose.q))),
                      before->omega, -h),
              before->alpha, -0.5 * h * h);
  const double off = sw_norm(way) + sw_norm(turn), all = change(before, after);
  return fmin(sqrt(2 * off / all), h);
}

/* Keeps one side of a time `half` after t, if nearly all of the change is there. Not if the time is
 * beside a jump: accelerations there are means of both sides. */
static sw_status halve(const sw_motion *m, double t, double half, sw_motion_state *before,
                       sw_motion_state *after, double *from, double *to, int *halved,
                       sw_error *err) {
  const double all = change(before, after);
  sw_motion_state middle;
  SW_TRY(sw_motion_eval(m, t + half, &middle, err));
  const double first = change(before, &middle), second = change(&middle, after);
  *halved = fmax(first, second) > AT_ONCE * all;
  if (!*halved) return SW_OK;
  if (first > second)
    *after = middle, *to = half;
  else
    *before = middle, *from = half;
  return SW_OK;
}

/* *at: time of a jump between from and to, all after t [s]. */
static sw_status jump_in(const sw_motion *m, double t, double from, double to, double *at,
                         sw_error *err) {
  const double step = sw_motion_step(m), end = to;
  sw_motion_state before, after;
  int good;
  if (!(to - from > 2 * step)) return SW_OK;
  SW_TRY(sw_motion_eval(m, t + from, &before, err));
  SW_TRY(sw_motion_eval(m, t + to, &after, err));
  while (is_jump(&before, &after) && to - from > SHORT * step) {
    const double half = 0.5 * (from + to);
    SW_TRY(halve(m, t, half, &before, &after, &from, &to, &good, err));
    if (!good) SW_TRY(halve(m, t, half + BESIDE * step, &before, &after, &from, &to, &good, err));
    if (!good) return SW_OK;
  }
  if (!is_jump(&before, &after)) return SW_OK;
  const double inner[2] = {t + from, t + to};
  from -= FURTHER * step, to = fmin(to + FURTHER * step, end);
  const double times[4] = {t + from, inner[0], inner[1], t + to};
  SW_TRY(is_even(m, times, &before, &after, &good, err));
  if (good) *at = to - since(&before, &after, to - from);
  return SW_OK;
}

sw_status sw_motion_corner(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  const double step = sw_motion_step(m), left = sw_motion_end(m) - t;
  double own = HUGE_VAL;
  /* A motion rests from its end on: a part that ends there would see that as a corner inside it. */
  if (left > step && fabs(h - left) < AT_START * step) h = left - AT_START * step;
  SW_TRY(jump_in(m, t, -step, h, &own, err));
  if (own < AT_START * step) { /* the method has just started anew for this one */
    own = HUGE_VAL;
    SW_TRY(jump_in(m, t, BESIDE * step, h, &own, err));
  }
  if (own > h - fmin(AT_END * step, END_SHARE * h)) return SW_OK;
  *at = fmin(*at, own);
  return SW_OK;
}

sw_status sw_motion_corners(const sw_motion *m, double t, int *yes, sw_error *err) {
  const double beside = BESIDE * sw_motion_step(m), all = beside + FURTHER * sw_motion_step(m);
  sw_motion_state before, after;
  *yes = 0;
  SW_TRY(sw_motion_eval(m, t - beside, &before, err));
  SW_TRY(sw_motion_eval(m, t + beside, &after, err));
  if (!is_jump(&before, &after)) return SW_OK;
  const double times[4] = {t - all, t - beside, t + beside, t + all};
  return is_even(m, times, &before, &after, yes, err);
}
