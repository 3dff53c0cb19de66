/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solid cylinder with flat ends, centred and along z: a rectangle in the half plane of (distance
 * from the axis, z). */
#include "shape/shape_class.h"

typedef struct cylinder {
  sw_shape base;
  double radius; /* [m] */
  double half;   /* half of the length [m] */
} cylinder;

typedef struct cylinder_args {
  double radius, length;
} cylinder_args;

enum { SIDE, TOP, BOTTOM, TOP_RIM, BOTTOM_RIM };

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source SW_UNUSED,
                        sw_error *err SW_UNUSED) {
  const cylinder_args *given = args;
  cylinder *self = (cylinder *)shape;
  self->radius = given->radius;
  self->half = given->length / 2;
  const double r = self->radius, z = self->half;
  shape->bounds = (sw_bounds){{-r, -r, -z}, {r, r, z}};
  return SW_OK;
}

static int distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  const cylinder *self = (const cylinder *)shape;
  const double r = sqrt(p.x * p.x + p.y * p.y);
  const double side = r - self->radius, cap = fabs(p.z) - self->half;
  const double gap = side > 0 && cap > 0 ? sqrt(side * side + cap * cap) : fmax(side, cap);
  if (!(gap < reach)) return 0;
  const sw_vec away = sw_direction(sw_v(p.x, p.y, 0), r, sw_v(1, 0, 0));
  const double up = copysign(1, p.z);
  sw_vec n = away;
  int part = SIDE;
  if (side > 0 && cap > 0 && gap > SW_SHAPE_TINY) {
    n = sw_v(away.x * side / gap, away.y * side / gap, up * cap / gap);
    part = up > 0 ? TOP_RIM : BOTTOM_RIM;
  } else if (cap >= side) {
    n = sw_v(0, 0, up);
    part = up > 0 ? TOP : BOTTOM;
  }
  *out = (sw_closest){gap, 0, n, sw_madd(p, n, -gap), part};
  return 1;
}

static sw_vec support(const sw_shape *shape, sw_vec n) {
  const cylinder *self = (const cylinder *)shape;
  const sw_vec away = sw_unit_or(sw_v(n.x, n.y, 0), sw_v(0, 0, 0));
  return sw_v(self->radius * away.x, self->radius * away.y, copysign(self->half, n.z));
}

/* Shortens the part to where the line is within the round side. */
static void clip_round(double radius, sw_vec a, sw_vec d, double part[2]) {
  const double dd = d.x * d.x + d.y * d.y, ad = a.x * d.x + a.y * d.y;
  const double inside = ad * ad - dd * (a.x * a.x + a.y * a.y - radius * radius);
  if (!(dd > 0 && inside > 0)) {
    part[1] = -1;
    return;
  }
  part[0] = fmax(part[0], (-ad - sqrt(inside)) / dd);
  part[1] = fmin(part[1], (-ad + sqrt(inside)) / dd);
}

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const cylinder *self = (const cylinder *)shape;
  if (!sw_convex_segment(shape, a, b, reach, out)) return 0;
  const sw_vec d = sw_sub(b, a);
  double part[2] = {0, 1};
  if (fabs(out[0].normal.z) >= cos(SW_NEARLY_FLAT))
    clip_round(self->radius, a, d, part);
  else if (fabs(d.z) >= cos(SW_NEARLY_FLAT) * sw_norm(d))
    sw_clip(a.z, d.z, -self->half, self->half, &part[0], &part[1]);
  else
    return 1;
  return sw_convex_bridge(shape, a, b, reach, part, out);
}

static sw_status triangles(const sw_shape *shape, int around, sw_triangles *out) {
  const cylinder *self = (const cylinder *)shape;
  const sw_ring rings[] = {{self->radius, -self->half}, {self->radius, self->half}};
  return sw_revolve(rings, 2, -self->half, self->half, around, out);
}

/* Visits the middle line of the inscribed capsule; the cylinder's rims lie outside the capsule. */
static void bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  const cylinder *self = (const cylinder *)shape;
  const sw_vec low = sw_v(0, 0, -fmax(0, self->half - self->radius)), high = sw_neg(low);
  visit(user, low, low, self->radius);
  visit(user, high, high, self->radius);
  visit(user, low, high, self->radius);
}

static double middle(const sw_shape *shape, sw_vec p, sw_vec *q, sw_vec *along) {
  const cylinder *self = (const cylinder *)shape;
  *q = sw_v(0, 0, p.z), *along = sw_v(0, 0, 1);
  return fabs(p.z) <= self->half ? self->radius : 0.0;
}

static const sw_param rows[] = {
    SW_LENGTH_ROW(cylinder_args, radius, "radius of the round side"),
    SW_LENGTH_ROW(cylinder_args, length, "distance between the flat ends, along z"),
};

static const sw_shape_wrong wrong[] = {
    {"radius = 1, length = 2e6", "length = 2e+06 m is not allowed"}, {NULL, NULL}};

const sw_shape_class sw_shape_class_cylinder = {
    .kind = "cylinder",
    .summary = "round rod or disc with flat ends, along z",
    .sample = "radius = 0.4, length = 0.7",
    .wrong = wrong,

    .params = SW_PARAMS("obstacle cylinder", rows),
    .size = sizeof(cylinder),
    .create = create,
    .distance = distance,
    .support = support,
    .segment = segment,
    .triangles = triangles,
    .bones = bones,
    .middle = middle};
