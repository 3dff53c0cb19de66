/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ball around the origin: gap = |p| - radius. */
#include "shape/shape_class.h"

typedef struct sphere {
  sw_shape base;
  double radius; /* [m] */
} sphere;

typedef struct sphere_args {
  double radius;
} sphere_args;

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source SW_UNUSED,
                        sw_error *err SW_UNUSED) {
  const double r = ((const sphere_args *)args)->radius;
  ((sphere *)shape)->radius = r;
  shape->bounds = (sw_bounds){{-r, -r, -r}, {r, r, r}};
  return SW_OK;
}

static inline int place(double radius, sw_vec p, sw_vec fallback, double at, double reach,
                        sw_closest *out) {
  const double r = sw_norm(p), gap = r - radius;
  if (!(gap < reach)) return 0;
  const sw_vec n = sw_direction(p, r, fallback);
  *out = (sw_closest){gap, at, n, sw_scale(n, radius), 0};
  return 1;
}

static int distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  return place(((const sphere *)shape)->radius, p, sw_v(0, 0, 1), 0, reach, out);
}

static sw_vec support(const sw_shape *shape, sw_vec n) {
  return sw_scale(n, ((const sphere *)shape)->radius);
}

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const double radius = ((const sphere *)shape)->radius;
  const sw_vec d = sw_sub(b, a);
  const double length2 = sw_norm2(d);
  const double at = -sw_dot(a, d) / length2;
  if (!(at > 0 && at < 1)) return 0;
  const sw_vec across = sw_perpendicular(sw_unit_or(d, sw_v(0, 0, 1)));
  if (!place(radius, sw_lerp(a, b, at), across, at, reach, out)) return 0;
  return !sw_no_better(out->gap, sw_norm(a) - radius, sw_norm(b) - radius, at, sqrt(length2));
}

static sw_status triangles(const sw_shape *shape, int around, sw_triangles *out) {
  const double r = ((const sphere *)shape)->radius;
  sw_ring rings[SW_MOST_AROUND / 2];
  const int steps = around / 2;
  const double step = 2 * SW_HALF_PI / steps;
  sw_ring_arc(rings, r, 0, step - SW_HALF_PI, SW_HALF_PI - step, steps - 2);
  return sw_revolve(rings, (size_t)steps - 1, -r, r, around, out);
}

static void bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  const sw_vec middle = sw_v(0, 0, 0);
  visit(user, middle, middle, ((const sphere *)shape)->radius);
}

static double middle(const sw_shape *shape, sw_vec p SW_UNUSED, sw_vec *q, sw_vec *along) {
  *q = *along = sw_v(0, 0, 0);
  return ((const sphere *)shape)->radius;
}

static const sw_param rows[] = {
    SW_LENGTH_ROW(sphere_args, radius, "radius of the ball"),
};

static const sw_shape_wrong wrong[] = {
    {"radius = 0", "obstacle sphere: radius = 0 m is not allowed"},
    {"radius = 1 / 0", "obstacle sphere: radius = inf m"},
    {"radius = '1'", "radius must be a number [m], got string"},
    {"radiu = 1", "no parameter 'radiu'; did you mean 'radius'?"},
    {NULL, NULL}};

const sw_shape_class sw_shape_class_sphere = {.kind = "sphere",
                                              .summary = "ball around the origin",
                                              .sample = "radius = 0.5",
                                              .wrong = wrong,

                                              .params = SW_PARAMS("obstacle sphere", rows),
                                              .size = sizeof(sphere),
                                              .create = create,
                                              .distance = distance,
                                              .support = support,
                                              .segment = segment,
                                              .triangles = triangles,
                                              .bones = bones,
                                              .middle = middle};
