/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Box centred on the origin. Outside, the nearest place is the point with each coordinate limited
 * to the box. Inside, it lies on the nearest face. */
#include "shape/shape_class.h"

typedef struct box {
  sw_shape base;
  sw_vec half; /* half of the size [m] */
} box;

typedef struct box_args {
  sw_vec size;
} box_args;

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source SW_UNUSED,
                        sw_error *err SW_UNUSED) {
  const sw_vec half = sw_scale(((const box_args *)args)->size, 0.5);
  ((box *)shape)->half = half;
  shape->bounds = (sw_bounds){sw_neg(half), half};
  return SW_OK;
}

/* Base-3 number of a face, edge or corner: digits 0, 1, 2 for the negative side, between, the
 * positive side. */
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

/* Returns -1 or 1 for the side of an axis that a place is on, or 0 if it is between the sides. */
static int side(double normal, double place, double half) {
  const double leans = 1e-6, on_side = 1e-9; /* of a normal; of half the size [-] */
  if (fabs(normal) > leans) return normal < 0 ? -1 : 1;
  return fabs(place) < half * (1 - on_side) ? 0 : place < 0 ? -1 : 1;
}

/* Names the feature of a segment's contact by its normal and point. The point query just beside an
 * edge may have named a face. */
static void name_feature(sw_vec half, sw_closest *c) {
  const sw_vec n = c->normal, p = c->point;
  c->feature = MIDDLE + X_DIGIT * side(n.x, p.x, half.x) + Y_DIGIT * side(n.y, p.y, half.y) +
               Z_DIGIT * side(n.z, p.z, half.z);
}

/* Finds the segment's place nearest to an edge along axis k, i.e. nearest in the plane of i and j.
 * 0: it is not over such an edge. */
static int over_edge(const double half[3], const double a[3], const double d[3], int k,
                     double *at) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double length2 = d[i] * d[i] + d[j] * d[j];
  if (!(length2 > 0)) return 0;
  for (int corner = 0; corner < 4; corner++) {
    const double si = corner & 1 ? 1 : -1, sj = corner & 2 ? 1 : -1;
    const double wi = a[i] - si * half[i], wj = a[j] - sj * half[j];
    const double u = -(wi * d[i] + wj * d[j]) / length2;
    if (!(u > 0 && u < 1)) continue;
    if (si * (wi + u * d[i]) > 0 && sj * (wj + u * d[j]) > 0 && fabs(a[k] + u * d[k]) < half[k]) {
      *at = u;
      return 1;
    }
  }
  return 0;
}

/* Like sw_convex_segment, but faster where the nearest feature is an edge: a local minimum of the
 * distance within an edge's region is the global one, because the distance is convex. */
static int nearest(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const sw_vec half = ((const box *)shape)->half, d = sw_sub(b, a);
  const double h[3] = {half.x, half.y, half.z}, from[3] = {a.x, a.y, a.z}, way[3] = {d.x, d.y, d.z};
  sw_closest ends[2];
  double at;
  distance(shape, a, HUGE_VAL, &ends[0]);
  if (!(sw_dot(ends[0].normal, d) < 0)) return 0;
  distance(shape, b, HUGE_VAL, &ends[1]);
  if (!(sw_dot(ends[1].normal, d) > 0)) return 0;
  int k = 0;
  while (k < 3 && !over_edge(h, from, way, k, &at)) k++;
  if (k == 3) return sw_convex_segment(shape, a, b, reach, out);
  if (!distance(shape, sw_madd(a, d, at), reach, out)) return 0;
  out->at = at;
  /* NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): in unlimited reach both ends are set */
  return !sw_no_better(out->gap, ends[0].gap, ends[1].gap, at, sw_norm(d));
}

static int places(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  if (!nearest(shape, a, b, reach, out)) return 0;
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

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const int count = places(shape, a, b, reach, out);
  for (int i = 0; i < count; i++) name_feature(((const box *)shape)->half, &out[i]);
  return count;
}

static const signed char quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};

/* Returns corner k: bits 0, 1 and 2 of k give the sides along x, y and z. */
static sw_vec corner(const box *self, int k) {
  const sw_vec h = self->half;
  return sw_v(k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z);
}

static sw_status triangles(const sw_shape *shape, int around SW_UNUSED, sw_triangles *out) {
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

static double least(double a, double b) { return a < b ? a : b; }
static double largest(double a, double b) { return a > b ? a : b; }

static int over_face(const sw_shape *shape, const sw_vec *p, size_t count) {
  const sw_vec half = ((const box *)shape)->half;
  sw_vec low = p[0], high = p[0];
  for (size_t i = 1; i < count; i++) {
    low = sw_v(least(low.x, p[i].x), least(low.y, p[i].y), least(low.z, p[i].z));
    high = sw_v(largest(high.x, p[i].x), largest(high.y, p[i].y), largest(high.z, p[i].z));
  }
  const int x = low.x >= -half.x && high.x <= half.x, y = low.y >= -half.y && high.y <= half.y;
  const int z = low.z >= -half.z && high.z <= half.z;
  if (x + y + z != 2) return 0;
  return x ? y ? low.z > half.z || high.z < -half.z : low.y > half.y || high.y < -half.y
           : low.x > half.x || high.x < -half.x;
}

static sw_sharp sharp(const sw_shape *shape SW_UNUSED, int feature, sw_vec *along) {
  const int x = feature % 3, y = feature / Y_DIGIT % 3, z = feature / Z_DIGIT;
  const int between = (x == 1) + (y == 1) + (z == 1);
  if (between == 1) *along = sw_v(x == 1, y == 1, z == 1);
  return between >= 2 ? SW_SHARP_NOT : between ? SW_SHARP_EDGE : SW_SHARP_CORNER;
}

/* 1 if an edge or corner on the side `sign` of axis k is within the bounds there. sign 0: the edge
 * runs along k. */
static int within(const double half[3], const double low[3], const double high[3], int k,
                  int sign) {
  if (!sign) return low[k] <= half[k] && high[k] >= -half[k];
  return low[k] <= sign * half[k] && high[k] >= sign * half[k];
}

static void ridges(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                   void *user) {
  const sw_vec h = ((const box *)shape)->half;
  const sw_bounds near = sw_bounds_of(a, b, reach);
  const double half[3] = {h.x, h.y, h.z}, low[3] = {near.min.x, near.min.y, near.min.z};
  const double high[3] = {near.max.x, near.max.y, near.max.z};
  for (int x = -1; x <= 1; x++)
    for (int y = -1; y <= 1 && within(half, low, high, 0, x); y++)
      for (int z = -1; z <= 1 && within(half, low, high, 1, y); z++) {
        const int between = !x + !y + !z;
        if (between > 1 || !within(half, low, high, 2, z)) continue;
        const sw_vec along = between ? sw_v(!x, !y, !z) : sw_v(0, 0, 0);
        const sw_vec from = sw_v((x ? x : -1) * h.x, (y ? y : -1) * h.y, (z ? z : -1) * h.z);
        const sw_ridge r = {.sharp = between ? SW_SHARP_EDGE : SW_SHARP_CORNER,
                            .feature = MIDDLE + X_DIGIT * x + Y_DIGIT * y + Z_DIGIT * z,
                            .from = from,
                            .along = along,
                            .length = 2.0 * sw_dot(along, h)};
        visit(user, &r);
      }
}

static int points_out(const sw_shape *shape SW_UNUSED, const sw_ridge *ridge, sw_vec n,
                      double share) {
  const int x = ridge->feature % 3 - 1, y = ridge->feature / Y_DIGIT % 3 - 1;
  const int z = ridge->feature / Z_DIGIT - 1;
  return x * n.x >= -share && y * n.y >= -share && z * n.z >= -share &&
         x * n.x + y * n.y + z * n.z > 0;
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
    .size = sizeof(box),
    .create = create,
    .distance = distance,
    .support = support,
    .segment = segment,
    .triangles = triangles,
    .bones = bones,
    .over_face = over_face,
    .sharp = sharp,
    .ridges = ridges,
    .points_out = points_out};
