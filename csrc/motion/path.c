/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress along legs. Position and orientation are functions of progress s (seconds at the highest
 * speed), and a profile gives s as a function of time.
 *
 * The straight legs are blended around a corner, from s = -half to half. The distance left on the
 * old leg, r_in(s), and the distance gone on the new one, r_out(s), obey r_in + r_out = s. The rate
 * of r_out rises from 0 to 1 by h(u) = 3u^2 - 2u^3. Position p + d_in r_in + d_out r_out and
 * orientation q exp(w_in r_in) exp(w_out r_out) then have continuous first and second derivatives,
 * and neither speed exceeds that of the faster leg. */
#include "motion/path.h"

#include "base/alloc.h"
#include "base/halving.h"

/* Geometry at one place of the path, with derivatives by progress. */
typedef struct place {
  sw_pose pose;
  sw_vec d, dd; /* [m/s], [m/s2] */
  sw_vec w, ww; /* turning, world axes [rad/s], [rad/s2] */
} place;

static void on_leg(const sw_segment *g, double x, place *out) {
  out->pose.p = sw_madd(g->p, g->d, x);
  out->pose.q = g->turns ? sw_quat_mul(g->q, sw_quat_exp(sw_scale(g->w, x))) : g->q;
  out->d = g->d;
  out->w = g->world;
  out->dd = out->ww = sw_v(0, 0, 0);
}

/* Evaluates the corner between the neighbours in and out_leg at progress x from the corner. */
static void on_corner(const sw_segment *in, const sw_segment *out_leg, double x, place *out) {
  const double half = out_leg->blend, width = 2 * half, u = (x + half) / width;
  const double h = u * u * (3 - 2 * u), rise = 6 * u * (1 - u) / width;
  const double r_out = width * u * u * u * (1 - 0.5 * u), r_in = x - r_out;
  out->pose.p = sw_madd(sw_madd(out_leg->p, in->d, r_in), out_leg->d, r_out);
  out->d = sw_lerp(in->d, out_leg->d, h);
  out->dd = sw_scale(sw_sub(out_leg->d, in->d), rise);
  out->pose.q = out_leg->q;
  out->w = out->ww = sw_v(0, 0, 0);
  if (!in->turns && !out_leg->turns) return;
  const sw_quat q_in = sw_quat_exp(sw_scale(in->w, r_in));
  const sw_quat q_out = sw_quat_exp(sw_scale(out_leg->w, r_out));
  out->pose.q = sw_quat_mul(out_leg->q, sw_quat_mul(q_in, q_out));
  const sw_vec old = sw_unrotate(q_out, in->w); /* in the axes of the moving frame */
  const sw_vec bent = sw_scale(sw_cross(out_leg->w, old), -h * (1 - h));
  out->w = sw_rotate(out->pose.q, sw_lerp(old, out_leg->w, h));
  out->ww = sw_rotate(out->pose.q, sw_madd(bent, sw_sub(out_leg->w, old), rise));
}

static size_t find_run(const sw_path *path, double t) {
  size_t after;
  SW_FIRST_NOT(path->runs[after].t <= t, after, 1, path->run_count);
  return after - 1;
}

static size_t find_segment(const sw_path *path, const sw_run *run, double s) {
  size_t after;
  SW_FIRST_NOT(path->segments[after].s <= s, after, run->first + 1, run->first + run->count);
  return after - 1;
}

static void locate(const sw_path *path, const sw_run *run, double s, place *out) {
  const size_t k = find_segment(path, run, s);
  const sw_segment *g = &path->segments[k];
  const double x = s - g->s;
  if (x < g->blend) {
    on_corner(g - 1, g, x, out);
    return;
  }
  /* without a blend there is no corner, even if rounding puts s behind the leg's end */
  if (k + 1 < run->first + run->count && g[1].blend > 0 && g->time - x < g[1].blend) {
    on_corner(g, g + 1, s - g[1].s, out);
    return;
  }
  on_leg(g, x, out);
}

sw_status sw_path_eval(const sw_motion *motion, double t, sw_motion_state *out,
                       sw_error *err SW_UNUSED) {
  const sw_path *path = motion->body;
  const sw_run *run = &path->runs[find_run(path, t)];
  double s[3];
  place at;
  t = t - run->t;
  path->profile->progress(run, t < run->time ? t : run->time, s);
  locate(path, run, s[0], &at);
  out->pose = at.pose;
  out->v = sw_scale(at.d, s[1]);
  out->a = sw_madd(sw_scale(at.d, s[2]), at.dd, s[1] * s[1]);
  out->omega = sw_scale(at.w, s[1]);
  out->alpha = sw_madd(sw_scale(at.w, s[2]), at.ww, s[1] * s[1]);
  return SW_OK;
}

double sw_path_corner_length(const sw_segment *in, const sw_segment *out) {
  enum { PARTS = 32 };
  double sum = 0;
  place at;
  for (int i = 0; i <= PARTS; i++) { /* Simpson's rule */
    on_corner(in, out, out->blend * (2.0 * i / PARTS - 1), &at);
    sum += sw_norm(at.d) * (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2);
  }
  return sum * 2 * out->blend / PARTS / 3;
}

void sw_path_destroy(void *body) {
  sw_path *path = body;
  if (!path) return;
  SW_FREE_ALL(path->segments, path->runs, path);
}
