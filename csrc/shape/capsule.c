/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All places within radius of a segment on the z axis. */
#include "shape/pairs.h"

typedef struct capsule {
  sw_shape base;
  double radius; /* [m] */
  double half;   /* half of the length between the centres [m] */
} capsule;

typedef struct capsule_args {
  double radius, length;
} capsule_args;

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source SW_UNUSED,
                        sw_error *err SW_UNUSED) {
  const capsule_args *given = args;
  capsule *self = (capsule *)shape;
  self->radius = given->radius;
  self->half = given->length / 2;
  const double r = self->radius, z = self->half + r;
  shape->bounds = (sw_bounds){{-r, -r, -z}, {r, r, z}};
  return SW_OK;
}

/* Part for a place on the axis: 0 = side, 1 = top ball, 2 = bottom ball. */
static inline int part_of(double z, double half) { return z >= half ? 1 : z <= -half ? 2 : 0; }

static int distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  const capsule *self = (const capsule *)shape;
  const double z = sw_limit(p.z, -self->half, self->half);
  const sw_vec w = sw_v(p.x, p.y, p.z - z);
  const double r = sw_norm(w), gap = r - self->radius;
  if (!(gap < reach)) return 0;
  const sw_vec n = sw_direction(w, r, sw_v(1, 0, 0));
  *out = (sw_closest){gap, 0, n, sw_madd(sw_v(0, 0, z), n, self->radius), part_of(z, self->half)};
  return 1;
}

static sw_vec support(const sw_shape *shape, sw_vec n) {
  const capsule *self = (const capsule *)shape;
  return sw_madd(sw_v(0, 0, n.z >= 0 ? self->half : -self->half), n, self->radius);
}

/* Returns the direction away from the axis for a segment that crosses it: perpendicular to both,
 * towards the side of the segment's ends. */
static sw_vec across(sw_vec a, sw_vec b, sw_vec d) {
  const sw_vec z = sw_v(0, 0, 1);
  const sw_vec n = sw_unit_or(sw_cross(d, z), sw_perpendicular(sw_unit_or(d, z)));
  return sw_dot(n, sw_add(a, b)) >= 0 ? n : sw_neg(n);
}

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const capsule *self = (const capsule *)shape;
  const sw_vec low = sw_v(0, 0, -self->half), axis = sw_v(0, 0, 2 * self->half);
  const sw_vec d = sw_sub(b, a);
  const double length = sw_norm(d), touching = 1e-12; /* share of the size taken as 0 [-] */
  double at, t;
  sw_pair_segments(a, d, low, axis, &at, &t);
  if (!(at > 0 && at < 1)) return 0;
  const sw_vec q = sw_madd(low, axis, t), w = sw_sub(sw_madd(a, d, at), q);
  const double r = sw_norm(w), gap = r - self->radius;
  if (!(gap < reach)) return 0;
  sw_closest end;
  distance(shape, a, INFINITY, &end);
  const double gap_a = end.gap;
  distance(shape, b, INFINITY, &end);
  if (sw_no_better(gap, gap_a, end.gap, at, length)) return 0;
  const sw_vec n = r > touching * (length + self->half) ? sw_scale(w, 1 / r) : across(a, b, d);
  *out = (sw_closest){gap, at, n, sw_madd(q, n, self->radius), part_of(q.z, self->half)};
  if (fabs(d.z) < cos(SW_NEARLY_FLAT) * length) return 1;
  double part[2] = {0, 1};
  sw_clip(a.z, d.z, -self->half, self->half, &part[0], &part[1]);
  return sw_convex_bridge(shape, a, b, reach, part, out);
}

static sw_status triangles(const sw_shape *shape, int around, sw_triangles *out) {
  const capsule *self = (const capsule *)shape;
  const double r = self->radius, h = self->half;
  sw_ring rings[SW_MOST_AROUND / 2];
  const int steps = around / 4;
  const double step = SW_HALF_PI / steps;
  sw_ring *to = sw_ring_arc(rings, r, -h, step - SW_HALF_PI, 0, steps - 1);
  sw_ring_arc(to, r, h, 0, SW_HALF_PI - step, steps - 1);
  return sw_revolve(rings, 2 * (size_t)steps, -h - r, h + r, around, out);
}

static void bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  const capsule *self = (const capsule *)shape;
  const sw_vec low = sw_v(0, 0, -self->half), high = sw_neg(low);
  visit(user, low, low, self->radius);
  visit(user, high, high, self->radius);
  visit(user, low, high, self->radius);
}

static double middle(const sw_shape *shape, sw_vec p, sw_vec *q, sw_vec *along) {
  const capsule *self = (const capsule *)shape;
  *q = sw_v(0, 0, sw_limit(p.z, -self->half, self->half));
  *along = sw_v(0, 0, part_of(p.z, self->half) ? 0 : 1);
  return self->radius;
}

static const sw_param rows[] = {
    SW_LENGTH_ROW(capsule_args, radius, "distance of the surface from the axis"),
    SW_LENGTH_ROW(capsule_args, length, "distance between the two ball centres, along z"),
};

static const sw_shape_wrong wrong[] = {{"radius = 1", "obstacle capsule: length is required [m]"},
                                       {NULL, NULL}};

const sw_shape_class sw_shape_class_capsule = {
    .kind = "capsule",
    .summary = "rounded rod: all points within radius of a segment along z",
    .sample = "radius = 0.2, length = 0.7",
    .wrong = wrong,

    .params = SW_PARAMS("obstacle capsule", rows),
    .size = sizeof(capsule),
    .create = create,
    .distance = distance,
    .support = support,
    .segment = segment,
    .triangles = triangles,
    .bones = bones,
    .middle = middle};
