/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far the force of a clip on a line is from what an iteration expected of it: from its force
 * and stiffness where the iteration began. The lips' force is curved, and the stiffness of floor,
 * walls and friction springs jumps. Where an iteration has passed none of that, the next one would
 * change nothing. */
#include <math.h>

#include "force/clip_watch.h"

/* An edge before or after the iteration; nothing if the clip does not act on it. */
static int sum_at(const sw_clip *c, const sw_plan *plan, size_t e, const sw_vec end[2], int what,
                  sw_clip_sum *out) {
  sw_clip_walk w;
  *out = (sw_clip_sum){0};
  if (!sw_clip_begin_at(c, plan, e, end, &w) || sw_clip_far(c, &w)) return 0;
  sw_clip_sum_of(c, &w, what, out);
  return 1;
}

/* Items of one end's own stiffness in its upper half. */
static const int WHOLE[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};

/* Returns the derivative of the energy that `was` predicts for an end after moves d of both ends,
 * in the clip's axes [N]. */
static double expected(const sw_clip_sum *was, double d[2][3], int end, int k) {
  double sum = was->g[end][k];
  for (int j = 0; j < 3; j++) {
    sum += was->own[end][WHOLE[3 * k + j]] * d[end][j];
    sum += was->next[end ? 3 * j + k : 3 * k + j] * d[!end][j];
  }
  return sum;
}

/* Returns the mistake in the force on both ends of an edge [N]. */
static double of_edge(const sw_clip *c, const sw_plan *plan, size_t e, const double *x,
                      const double *delta) {
  sw_clip_sum was, is;
  sw_vec from[2], to[2];
  double d[2][3], all = 0;
  for (size_t i = 0; i < 2; i++) {
    const sw_vec by = sw_load(delta + 3 * (e + i));
    to[i] = sw_load(x + 3 * (e + i)), from[i] = sw_sub(to[i], by);
    d[i][0] = sw_dot(by, c->direction), d[i][1] = sw_dot(by, c->across);
    d[i][2] = sw_dot(by, c->axis);
  }
  const int acted = sum_at(c, plan, e, from, SW_CLIP_WANT_STIFFNESS, &was);
  if (!sum_at(c, plan, e, to, 0, &is) && !acted) return 0;
  for (int end = 0; end < 2; end++) {
    double off2 = 0;
    for (int k = 0; k < 3; k++) {
      const double off = is.g[end][k] - expected(&was, d, end, k);
      off2 += off * off;
    }
    all += sqrt(off2);
  }
  return all;
}

/* Returns the mistake in the friction on place i [N]. */
static double of_friction(const sw_clip *c, const double *h, const double *x, const double *delta,
                          double slip) {
  const double now =
      h[SW_CLIP_STRETCH] + sw_dot(c->axis, sw_sub(sw_load(x), c->at)) - h[SW_CLIP_PLACE];
  const double before = now - sw_dot(c->axis, sw_load(delta));
  const double e = fmax(-slip, fmin(slip, now)), was = fmax(-slip, fmin(slip, before));
  const double linear = fabs(before) < slip ? now : was;
  return h[SW_CLIP_MOST] / slip * fabs(e - linear);
}

double sw_clip_mistake(const void *args, const sw_field *f, const double *history, const double *x,
                       const double *delta) {
  if (sw_clip_is_broken(history)) return 0;
  const sw_clip c = sw_clip_met(args, f, history);
  const size_t points = sw_axis_points(f->plan);
  double sum = 0;
  for (size_t e = 0; e + 1 < points; e++) sum += of_edge(&c, f->plan, e, x, delta);
  for (size_t i = 0; history && history[SW_CLIP_RUBS] > 0 && i < points; i++) {
    const double *h = history + SW_CLIP_HEAD + SW_CLIP_EACH * i;
    if (h[SW_CLIP_MOST] > 0)
      sum += of_friction(&c, h, x + 3 * i, delta + 3 * i, SW_CLIP_SLIP * c.width);
  }
  return sum;
}
