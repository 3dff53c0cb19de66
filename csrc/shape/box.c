/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Box centred on the origin. Outside, the nearest place is the point with each
 * coordinate limited to the box; inside, it lies on the nearest face. */
#include "shape/shape_class.h"

typedef struct box {
  sw_shape base;
  sw_vec half; /* half of the size [m] */
} box;

typedef struct box_args {
  sw_vec size;
} box_args;

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source,
                        sw_error *err) {
  (void)source, (void)err;
  const sw_vec half = sw_scale(((const box_args *)args)->size, 0.5);
  ((box *)shape)->half = half;
  shape->bounds = (sw_bounds){sw_neg(half), half};
  return SW_OK;
}

/* Base-3 number of a face, edge or corner: digits 0, 1, 2 for -, between, +. */
enum { X_DIGIT = 1, Y_DIGIT = 3, Z_DIGIT = 9, MIDDLE = X_DIGIT + Y_DIGIT + Z_DIGIT };

static inline int on_face(sw_vec p, sw_vec half, int axis, double gap, sw_closest *out) {
  sw_vec n = {0, 0, 0}, q = p;
  int digit = 0;
  if (axis == 0) {
    n.x = copysign(1, p.x), q.x = copysign(half.x, p.x), digit = p.x < 0 ? -X_DIGIT : X_DIGIT;
  } else if (axis == 1) {
    n.y = copysign(1, p.y), q.y = copysign(half.y, p.y), digit = p.y < 0 ? -Y_DIGIT : Y_DIGIT;
  } else {
    n.z = copysign(1, p.z), q.z = copysign(half.z, p.z), digit = p.z < 0 ? -Z_DIGIT : Z_DIGIT;
  }
  *out = (sw_closest){gap, 0, n, q, MIDDLE + digit};
  return 1;
}

static inline double beyond(double x, double half) {
  return x > half ? x - half : x < -half ? x + half : 0;
}

static inline int sign_of(double x) { return (x > 0) - (x < 0); }

static int distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  const sw_vec half = ((const box *)shape)->half;
  const double x = fabs(p.x) - half.x, y = fabs(p.y) - half.y, z = fabs(p.z) - half.z;
  const int axis = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
  const double most = axis == 0 ? x : axis == 1 ? y : z;
  if (!(most < reach)) return 0;
  if (most <= 0 || (x > 0) + (y > 0) + (z > 0) == 1) return on_face(p, half, axis, most, out);
  const sw_vec w = sw_v(beyond(p.x, half.x), beyond(p.y, half.y), beyond(p.z, half.z));
  const double gap = sw_norm(w);
  if (!(gap < reach)) return 0;
  if (gap <= SW_SHAPE_TINY) return on_face(p, half, axis, most, out);
  const int digits = X_DIGIT * sign_of(w.x) + Y_DIGIT * sign_of(w.y) + Z_DIGIT * sign_of(w.z);
  *out = (sw_closest){gap, 0, sw_scale(w, 1 / gap), sw_sub(p, w), MIDDLE + digits};
  return 1;
}

static sw_vec support(const sw_shape *shape, sw_vec n) {
  const sw_vec half = ((const box *)shape)->half;
  return sw_v(copysign(half.x, n.x), copysign(half.y, n.y), copysign(half.z, n.z));
}

/* Shorten the part [*from, *to] of a line x + t d to where it is within half. */
static void clip(double x, double d, double half, double *from, double *to) {
  if (d == 0) {
    if (fabs(x) > half) *to = -1;
    return;
  }
  const double one = (-half - x) / d, two = (half - x) / d;
  *from = fmax(*from, fmin(one, two));
  *to = fmin(*to, fmax(one, two));
}

/* A segment that bridges the face under its one contact touches it at both
 * edges: add the ones that are not the contact already. */
static int bridge(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const double nearly_flat = 0.05; /* tilt up to which both edges count [rad] */
  const sw_vec half = ((const box *)shape)->half, d = sw_sub(b, a), n = out[0].normal;
  const double most = fmax(fmax(fabs(n.x), fabs(n.y)), fabs(n.z)), length = sw_norm(d);
  if (most < cos(nearly_flat) || fabs(sw_dot(n, d)) > nearly_flat * length) return 1;
  double part[2] = {0, 1};
  if (most != fabs(n.x)) clip(a.x, d.x, half.x, &part[0], &part[1]);
  if (most != fabs(n.y)) clip(a.y, d.y, half.y, &part[0], &part[1]);
  if (most != fabs(n.z)) clip(a.z, d.z, half.z, &part[0], &part[1]);
  if (!(part[0] < part[1])) return 1;
  const double same = 2 * nearly_flat * fabs(out[0].gap) + 1e-6 * length; /* [m] */
  const double off = same / length; /* [-] */
  const sw_closest lone = out[0];
  const int level = fabs(sw_dot(n, d)) <= 1e-9 * length; /* else the segment pierces the box */
  const int flat = level && lone.at > part[0] + off && lone.at < part[1] - off;
  int count = flat ? 0 : 1;
  sw_closest ends[2], found;
  distance(shape, a, INFINITY, &ends[0]), distance(shape, b, INFINITY, &ends[1]);
  for (int i = 0; i < 2; i++) {
    if (!(part[i] > 0 && part[i] < 1)) continue;
    if (!flat && fabs(part[i] - lone.at) <= off) continue;
    if (!distance(shape, sw_lerp(a, b, part[i]), reach, &found)) continue;
    found.at = part[i];
    if (sw_no_better(found.gap, ends[0].gap, ends[1].gap, found.at, length)) continue;
    out[count++] = found;
  }
  return count > 0 ? count : 1;
}

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  return sw_convex_segment(shape, a, b, reach, out) ? bridge(shape, a, b, reach, out) : 0;
}

static const sw_param rows[] = {
    {"size", SW_PARAM_VECTOR, "m", NAN, 0, SW_SHAPE_LARGEST,
     SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN, NULL, offsetof(box_args, size),
     "lengths of the edges along x, y and z"},
};

const sw_shape_class sw_shape_class_box = {.kind = "box",
                                           .params = SW_PARAMS("obstacle box", rows),
                                           .args_size = sizeof(box_args),
                                           .size = sizeof(box),
                                           .create = create,
                                           .distance = distance,
                                           .support = support,
                                           .segment = segment};
