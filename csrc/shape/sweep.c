/* SPDX-License-Identifier: GPL-3.0-or-later */
/* First touch of a moving segment by conservative advancement: the present gap gives a time before
 * which no touch can happen; go there and look again. Two such times are known and the later one is
 * taken: no point moves faster than the faster end, and a convex thing stays behind the plane
 * through its nearest place, which one of the segment's ends must reach first. */
#include "shape/shape_class.h"

/* Returns the time at which an end, at p at time `now` with velocity v, comes within level of the
 * plane. */
static double end_arrival(double now, sw_vec p, sw_vec v, sw_vec normal, double plane,
                          double level) {
  const double speed = -sw_dot(normal, v);
  if (!(speed > 0)) return INFINITY;
  return now + (sw_dot(normal, p) - plane - level) / speed;
}

int sw_sweep_advance(sw_nearest_function nearest, const void *thing, const sw_sweep *path,
                     const sw_closest *start, double level, double limit, sw_closest *out,
                     double *when) {
  const int most = 300; /* looks after which a graze counts as a touch [-] */
  const sw_vec va = sw_sub(path->a1, path->a0), vb = sw_sub(path->b1, path->b0);
  const double speed = fmax(sw_norm(va), sw_norm(vb));
  sw_vec a = path->a0, b = path->b0;
  double now = 0;
  *out = *start;
  for (int look = 0; look < most && out->gap - level > path->tolerance; look++) {
    const sw_vec p = sw_lerp(a, b, out->at);
    const double plane = sw_dot(out->normal, p) - out->gap;
    const double fastest = now + (out->gap - level) / speed;
    const double first = fmin(end_arrival(now, a, va, out->normal, plane, level),
                              end_arrival(now, b, vb, out->normal, plane, level));
    now = fmax(fastest, first);
    if (!(now < limit)) return 0;
    a = sw_madd(path->a0, va, now), b = sw_madd(path->b0, vb, now);
    nearest(thing, a, b, out);
  }
  *when = now;
  return 1;
}

static void shape_nearest(const void *thing, sw_vec a, sw_vec b, sw_closest *out) {
  sw_convex_nearest(thing, a, b, out);
}

int sw_convex_sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when) {
  const double end = 1 + 1e-12; /* counts a touch at time 1 despite rounding */
  sw_closest start;
  sw_convex_nearest(shape, path->a0, path->b0, &start);
  const double level = sw_sweep_level(path, start.gap);
  if (!sw_sweep_advance(shape_nearest, shape, path, &start, level, end, out, when)) return 0;
  *when = fmin(*when, 1);
  return 1;
}

/* --- shapes that need not be convex ------------------------------------------------- */

static void any_nearest(const sw_shape *shape, sw_vec a, sw_vec b, sw_closest *out) {
  sw_closest end, inner[SW_CLOSEST_MAX];
  shape->class->distance(shape, a, HUGE_VAL, out);
  out->at = 0;
  shape->class->distance(shape, b, HUGE_VAL, &end);
  if (end.gap < out->gap) *out = end, out->at = 1;
  if (sw_norm2(sw_sub(b, a)) == 0) return;
  if (shape->class->segment(shape, a, b, out->gap, inner) > 0) *out = inner[0];
}

int sw_any_sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when) {
  const int most = 3000; /* looks after which a graze counts as a touch [-] */
  const sw_vec va = sw_sub(path->a1, path->a0), vb = sw_sub(path->b1, path->b0);
  const double speed = fmax(sw_norm(va), sw_norm(vb));
  any_nearest(shape, path->a0, path->b0, out);
  const double level = sw_sweep_level(path, out->gap);
  double now = 0;
  for (int look = 0; look < most && out->gap - level > path->tolerance; look++) {
    if (now == 1) return 0;
    now = fmin(1, now + (out->gap - level) / speed);
    any_nearest(shape, sw_madd(path->a0, va, now), sw_madd(path->b0, vb, now), out);
  }
  *when = now;
  return 1;
}
