/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Half space below the plane through the origin: gap = n.p. */
#include "shape/shape_class.h"

typedef struct plane {
  sw_shape base;
  sw_vec normal; /* [-] */
} plane;

typedef struct plane_args {
  sw_vec normal;
} plane_args;

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source SW_UNUSED,
                        sw_error *err) {
  plane *self = (plane *)shape;
  const sw_vec up = sw_v(0, 0, 1);
  const sw_vec given = ((const plane_args *)args)->normal;
  const sw_vec n = isnan(given.x) ? up : given;
  const double size = fmax(fmax(fabs(n.x), fabs(n.y)), fabs(n.z));
  if (!(size > 0))
    return sw_fail(err, SW_EINVAL, "obstacle plane: normal = {0, 0, 0} has no direction");
  self->normal = sw_unit_or(sw_v(n.x / size, n.y / size, n.z / size), up);
  const sw_vec far = sw_v(INFINITY, INFINITY, INFINITY);
  shape->bounds = (sw_bounds){sw_neg(far), far};
  if (self->normal.x == 0 && self->normal.y == 0)
    *(self->normal.z > 0 ? &shape->bounds.max.z : &shape->bounds.min.z) = 0;
  return SW_OK;
}

static int distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  const sw_vec n = ((const plane *)shape)->normal;
  const double gap = sw_dot(n, p);
  if (!(gap < reach)) return 0;
  *out = (sw_closest){gap, 0, n, sw_madd(p, n, -gap), 0};
  return 1;
}

/* The distance is linear along a segment, so it has no minimum between the ends. */
static int segment(const sw_shape *shape SW_UNUSED, sw_vec a SW_UNUSED, sw_vec b SW_UNUSED,
                   double reach SW_UNUSED, sw_closest *out SW_UNUSED) {
  return 0;
}

static const sw_param rows[] = {
    {"normal", SW_PARAM_VECTOR, "-", NAN, -SW_SHAPE_LARGEST, SW_SHAPE_LARGEST, 0, NULL,
     offsetof(plane_args, normal), "direction out of the solid, {0, 0, 1} when not given"},
};

static const sw_shape_wrong wrong[] = {
    {"normal = { 0, 0, 0 }", "normal = {0, 0, 0} has no direction"},
    {"normal = { 0, 0, 0 / 0 }", "obstacle plane: normal, item 3"},
    {NULL, NULL}};

const sw_shape_class sw_shape_class_plane = {
    .kind = "plane",
    .summary = "half space, below z = 0 where no normal is given",
    .sample = "normal = { 0.2, -0.1, 1 }",
    .wrong = wrong,
    .traits = SW_SHAPE_FLAT,

    .params = SW_PARAMS("obstacle plane", rows),
    .size = sizeof(plane),
    .create = create,
    .distance = distance,
    .segment = segment};
