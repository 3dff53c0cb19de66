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

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  if (!sw_convex_segment(shape, a, b, reach, out)) return 0;
  const sw_vec half = ((const box *)shape)->half, d = sw_sub(b, a), n = out[0].normal;
  const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
  const double most = fmax(fmax(x, y), z);
  double part[2] = {0, 1};
  if (most < cos(SW_NEARLY_FLAT)) return 1;
  if (most != x) sw_clip(a.x, d.x, -half.x, half.x, &part[0], &part[1]);
  if (most != y) sw_clip(a.y, d.y, -half.y, half.y, &part[0], &part[1]);
  if (most != z) sw_clip(a.z, d.z, -half.z, half.z, &part[0], &part[1]);
  return sw_convex_bridge(shape, a, b, reach, part, out);
}

static const signed char quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};

/* Corner k: bit 0 of k tells the side along x, bit 1 that along y, bit 2 that along z. */
static sw_vec corner(const box *self, int k) {
  const sw_vec h = self->half;
  return sw_v(k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z);
}

static sw_status triangles(const sw_shape *shape, int around, sw_triangles *out) {
  (void)around;
  SW_TRY(sw_triangles_new(8, 12, out));
  for (int k = 0; k < 8; k++) sw_store(out->vertices + 3 * k, corner((const box *)shape, k));
  int *to = out->indices;
  for (int k = 0; k < 6; k++) {
    const size_t a = (size_t)quads[k][0], c = (size_t)quads[k][2];
    to = sw_triangle_put(to, a, (size_t)quads[k][1], c);
    to = sw_triangle_put(to, a, c, (size_t)quads[k][3]);
  }
  return SW_OK;
}

static void bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  const box *self = (const box *)shape;
  for (int k = 0; k < 8; k++) {
    visit(user, corner(self, k), corner(self, k), 0);
    for (int axis = 1; axis < 8; axis *= 2)
      if (!(k & axis)) visit(user, corner(self, k), corner(self, k | axis), 0);
  }
}

static const sw_param rows[] = {
    {"size", SW_PARAM_VECTOR, "m", NAN, 0, SW_SHAPE_LARGEST, SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN,
     NULL, offsetof(box_args, size), "lengths of the edges along x, y and z"},
};

static const sw_shape_wrong wrong[] = {
    {"size = { 1, -1, 2 }", "obstacle box: size = -1 m is not allowed; it must be in (0, 1e+06] m"},
    {"size = { 1, 2 }", "obstacle box: size, item 3"},
    {"", "obstacle box: size is required [m]"},
    {NULL, NULL}};

const sw_shape_class sw_shape_class_box = {
    .kind = "box",
    .summary = "block around the origin, edges along the axes",
    .sample = "size = { 1, 0.8, 0.6 }",
    .wrong = wrong,
    .traits = SW_SHAPE_FACED | SW_SHAPE_SQUARE,

    .params = SW_PARAMS("obstacle box", rows),
    .args_size = sizeof(box_args),
    .size = sizeof(box),
    .create = create,
    .distance = distance,
    .support = support,
    .segment = segment,
    .triangles = triangles,
    .bones = bones};
