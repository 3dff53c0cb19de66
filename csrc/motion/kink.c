/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the times at which the velocity of a user's function jumps, from its poses alone. Over a
 * time w a jump by V bends the path by V w/4 or more in one of three overlapping windows of length
 * w, an acceleration a by a w^2/4. So bend/w stays the same while w is halved, or falls with w. */
#include <math.h>

#include "motion/law.h"

/* Smaller jumps are left alone: 10 um in a step of 10 ms. So are jumps by less than a share of the
 * higher speed beside them: poses of a smooth motion may be interpolated linearly [m/s], [rad/s],
 * [-]. */
static const double SMALLEST = 1e-3, SHARE = 0.25;
/* A jump is found to this; times that differ by less are one [s]. */
static const double FOUND = 1e-9;

static double way(const sw_pose *a, const sw_pose *b) {
  return sw_dist(a->p, b->p) + sw_norm(sw_quat_log(sw_quat_mul(b->q, sw_quat_conj(a->q))));
}

/* Where the third pose is, seen from where the way through the first two leads [m], [rad]. */
typedef struct off {
  sw_vec p, turn;
} off;

static off off_way(const sw_pose *a) {
  const sw_quat on = sw_quat_mul(a[1].q, sw_quat_conj(a[0].q));
  const sw_quat q = sw_quat_mul(a[2].q, sw_quat_conj(sw_quat_mul(on, a[1].q)));
  return (off){sw_add(sw_sub(a[2].p, a[1].p), sw_sub(a[0].p, a[1].p)), sw_quat_log(q)};
}

static double bend(const sw_pose *a) {
  const off b = off_way(a);
  return sw_norm(b.p) + sw_norm(b.turn);
}

/* Smallest jump that counts between three poses, w from the first to the last [m/s] + [rad/s]. */
static double least(const sw_pose *a, double w) {
  return fmax(SMALLEST, SHARE * 2 * fmax(way(a, a + 1), way(a + 1, a + 2)) / w);
}

/* 1 if the velocity may jump within three poses: by bend/w to 4 bend/w. */
static int may_jump(const sw_pose *a, double w) { return 4 * bend(a) > w * least(a, w); }

/* Three poses, evenly spaced over a window of time. */
typedef struct window {
  double t, w; /* begin, length [s] */
  sw_pose at[3];
} window;

static sw_status look(const sw_motion *m, double t, double w, window *out, sw_error *err) {
  *out = (window){.t = t, .w = w};
  for (int k = 0; k < 3; k++) SW_TRY(sw_callback_pose(m, t + 0.5 * w * k, out->at + k, err));
  return SW_OK;
}

/* A place that jumps, or poses with noise, bend the way as much over any time: bend/w grows by this
 * factor within a few halvings, but not for a jump of velocity, unless it was halved PURE times
 * before. Then the jump is real and found as well as noise allows [-]. */
static const double NOISY = 4, PURE = 1.0 / 64;

/* *at: time of a jump in the middle half of a window, shortly before it; unchanged if there is none
 * [s]. */
static sw_status zoom(const sw_motion *m, window in, double *at, sw_error *err) {
  const double w0 = in.w, first = bend(in.at) / in.w;
  while (may_jump(in.at, in.w)) {
    const int noisy = bend(in.at) > NOISY * first * in.w;
    if (noisy && in.w > PURE * w0) return SW_OK;
    if (noisy || in.w < FOUND) {
      *at = in.t;
      return SW_OK;
    }
    sw_pose five[5] = {in.at[0], in.at[0], in.at[1], in.at[1], in.at[2]};
    SW_TRY(sw_callback_pose(m, in.t + 0.25 * in.w, five + 1, err));
    SW_TRY(sw_callback_pose(m, in.t + 0.75 * in.w, five + 3, err));
    int most = 0;
    for (int k = 1; k < 3; k++)
      if (bend(five + k) > bend(five + most)) most = k;
    in.t += 0.25 * in.w * most, in.w *= 0.5;
    for (int k = 0; k < 3; k++) in.at[k] = five[most + k];
  }
  return SW_OK;
}

/* Windows over which a jump is looked for, in order: longer and longer ones from t on, the middle,
 * shorter and shorter ones up to t + h. A jump is in the middle half of one of them, unless it is
 * nearer than a 128th of h to t or t + h. */
enum { AT_END = 5, WINDOWS = 2 * AT_END + 1 };

static void place(int k, double h, double *t, double *w) {
  const int from_end = k < AT_END ? AT_END - k : k - AT_END;
  *w = from_end ? ldexp(h, -from_end) : 0.5 * h;
  *t = k < AT_END ? 0.0 : from_end ? h - *w : 0.25 * h;
}

sw_status sw_motion_jump(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  window in;
  double from, w;
  *at = HUGE_VAL;
  for (int k = 0; k < WINDOWS && *at == HUGE_VAL; k++) {
    place(k, h, &from, &w);
    SW_TRY(look(m, t + from, w, &in, err));
    SW_TRY(zoom(m, in, at, err));
  }
  *at -= t;
  return SW_OK;
}

/* Time before and after a step within which a jump counts as at its start or end [s]. */
static double beside(double h) { return ldexp(h, -AT_END - 1); }

/* Three bends differ by jerk w^3/64 at most if none of the windows has a jump, and by V times the
 * distance from the nearest end if there is one. */
sw_status sw_motion_smooth(const sw_motion *m, double t, double h, int *smooth, sw_error *err) {
  const double from = t - beside(h), w = h + 2 * beside(h);
  sw_pose five[5];
  off three[3];
  double fastest = SMALLEST, most = 0;
  for (int k = 0; k < 5; k++) SW_TRY(sw_callback_pose(m, from + 0.25 * w * k, five + k, err));
  for (int k = 0; k < 3; k++) three[k] = off_way(five + k);
  for (int k = 0; k < 3; k++) fastest = fmax(fastest, least(five + k, 0.5 * w));
  for (int k = 0; k < 2; k++)
    most =
        fmax(most, sw_dist(three[k].p, three[k + 1].p) + sw_dist(three[k].turn, three[k + 1].turn));
  *smooth = most < 0.5 * beside(h) * fastest;
  return SW_OK;
}

sw_status sw_motion_jumps(const sw_motion *m, double t, double h, int *jumps, sw_error *err) {
  window in;
  double at = HUGE_VAL;
  SW_TRY(look(m, t - beside(h), 2 * beside(h), &in, err));
  SW_TRY(zoom(m, in, &at, err));
  *jumps = at < HUGE_VAL;
  return SW_OK;
}

/* A jump near the ends of three poses bends them less: by this share it counts [-]. */
static const double OUTER = 0.01;

sw_status sw_callback_beside(const sw_motion *m, double t, double step, const sw_pose *three,
                             double *centre, sw_error *err) {
  window in;
  double at = HUGE_VAL;
  if (4 * bend(three) < OUTER * 2 * step * least(three, 2 * step)) return SW_OK;
  SW_TRY(look(m, m->start + *centre - 2 * step, 4 * step, &in, err));
  SW_TRY(zoom(m, in, &at, err));
  at -= m->start;
  if (!(fabs(at - *centre) < step)) return SW_OK;
  const double side = t <= at + FOUND ? at - step : at + FOUND + step;
  if (side >= step && side <= m->duration - step) *centre = side;
  return SW_OK;
}
