/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ring: all places within `tube` of a circle of radius R around z, R > tube. With rho the distance
 * from z, the gap is |(rho - R, z)| - tube; exact everywhere.
 *
 * Along a segment a + t d, half the slope of (gap + tube)^2 is h = d.(a + t d) - R rho', and rho =
 * |(m, D (t - t0))| with D the length of d across z. h' = d.d - R D^2 m^2/rho^3 is negative only in
 * an interval centred on t0. So h falls inside it and rises before and after: there is at most one
 * minimum of the gap on either side. */
#include "shape/shape_class.h"

typedef struct torus {
  sw_shape base;
  double radius, tube; /* [m] */
} torus;

typedef struct torus_args {
  double radius, tube;
} torus_args;

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source SW_UNUSED,
                        sw_error *err) {
  const torus_args *given = args;
  torus *self = (torus *)shape;
  if (!(given->tube < given->radius))
    return sw_fail(err, SW_EINVAL,
                   "obstacle torus: tube = %g m is not allowed; it must be below radius = %g m",
                   given->tube, given->radius);
  self->radius = given->radius, self->tube = given->tube;
  const double r = self->radius + self->tube, z = self->tube;
  shape->bounds = (sw_bounds){{-r, -r, -z}, {r, r, z}};
  return SW_OK;
}

/* Returns the place of the circle nearest to p. */
static sw_vec on_circle(const torus *self, sw_vec p) {
  const double rho = sqrt(p.x * p.x + p.y * p.y);
  return sw_scale(sw_direction(sw_v(p.x, p.y, 0), rho, sw_v(1, 0, 0)), self->radius);
}

static int distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  const torus *self = (const torus *)shape;
  const sw_vec c = on_circle(self, p), w = sw_sub(p, c);
  const double r = sw_norm(w), gap = r - self->tube;
  if (!(gap < reach)) return 0;
  const sw_vec n = sw_direction(w, r, sw_v(0, 0, 1));
  *out = (sw_closest){gap, 0, n, sw_madd(c, n, self->tube), 0};
  return 1;
}

/* --- segments ----------------------------------------------------------------- */

typedef struct line {
  sw_vec a, d;   /* first end, vector to the second end [m] */
  double radius; /* of the circle [m] */
  double across; /* D [m] */
  double middle; /* t0 [-] */
  double past;   /* m: signed least distance of the line from z [m] */
} line;

static line line_of(const torus *self, sw_vec a, sw_vec b) {
  const sw_vec d = sw_sub(b, a);
  const double D = sqrt(d.x * d.x + d.y * d.y);
  if (!(D > SW_SHAPE_TINY)) return (line){a, d, self->radius, 0, 0, 0};
  return (line){a,
                d,
                self->radius,
                D,
                -(a.x * (d.x / D) + a.y * (d.y / D)) / D,
                a.x * (d.y / D) - a.y * (d.x / D)};
}

/* Returns h at t [m2]. On the axis itself h jumps: side -1 = before, 1 = after. */
static double slope(const line *on, double t, int side) {
  const double u = on->across * (t - on->middle), rho = sqrt(on->past * on->past + u * u);
  const double outwards = rho > 0 ? u / rho : side; /* rho' / D */
  return sw_dot(sw_madd(on->a, on->d, t), on->d) - on->radius * on->across * outwards;
}

/* Finds where h rises through 0 in [from, to], alternating halving and secant. 0: nowhere. */
static int rise(const line *on, double from, double to, int side, double *at) {
  const double width = 1e-15; /* narrowest interval [-] */
  double low = slope(on, from, side), high = slope(on, to, side);
  if (!(from < to && low < 0 && high > 0)) return 0;
  for (int turn = 0; turn < 200 && to - from > width; turn++) {
    double t = from + (to - from) * (turn % 2 ? 0.5 : low / (low - high));
    if (!(t > from && t < to)) t = 0.5 * (from + to);
    const double h = slope(on, t, side);
    if (h < 0)
      from = t, low = h;
    else
      to = t, high = h;
  }
  *at = 0.5 * (from + to);
  return 1;
}

/* Returns half the width of h's falling part, which is centred on t0 [-]. */
static double falling(const line *on) {
  const double D2 = on->across * on->across, m2 = on->past * on->past;
  if (!(on->across > 0)) return 0;
  const double rho = cbrt(on->radius * (D2 / sw_norm2(on->d)) * m2);
  return sqrt(fmax(0, rho * rho - m2)) / on->across;
}

/* Returns the direction away from the circle for a segment that crosses it: perpendicular to
 * both. */
static sw_vec across(sw_vec c, sw_vec d) {
  const sw_vec along = sw_v(-c.y, c.x, 0);
  return sw_unit_or(sw_cross(d, along), sw_v(0, 0, 1));
}

static int touch(const torus *self, const line *on, double at, double reach, sw_closest *out) {
  const double touching = 1e-12; /* share of the size taken as 0 [-] */
  const sw_vec p = sw_madd(on->a, on->d, at), c = on_circle(self, p), w = sw_sub(p, c);
  const double r = sw_norm(w), gap = r - self->tube, length = sw_norm(on->d);
  if (!(at > 0 && at < 1 && gap < reach)) return 0;
  sw_closest one, two;
  distance(&self->base, on->a, HUGE_VAL, &one);
  distance(&self->base, sw_add(on->a, on->d), HUGE_VAL, &two);
  if (sw_no_better(gap, one.gap, two.gap, at, length)) return 0;
  const sw_vec n = r > touching * (length + self->radius) ? sw_scale(w, 1 / r) : across(c, on->d);
  *out = (sw_closest){gap, at, n, sw_madd(c, n, self->tube), 0};
  return 1;
}

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const torus *self = (const torus *)shape;
  const line on = line_of(self, a, b);
  const double half = falling(&on);
  double at;
  int count = 0;
  if (rise(&on, 0, sw_limit(on.middle - half, 0, 1), -1, &at))
    count += touch(self, &on, at, reach, &out[count]);
  if (rise(&on, sw_limit(on.middle + half, 0, 1), 1, 1, &at))
    count += touch(self, &on, at, reach, &out[count]);
  if (count == 2 && out[1].gap < out[0].gap) {
    const sw_closest first = out[0];
    out[0] = out[1], out[1] = first;
  }
  return count;
}

/* --- drawing, overlaps ---------------------------------------------------------- */

static sw_status triangles(const sw_shape *shape, int around, sw_triangles *out) {
  const torus *self = (const torus *)shape;
  const size_t n = (size_t)around, m = n / 2; /* numbers around z and around the tube */
  const double full = 4 * SW_HALF_PI;
  SW_TRY(sw_triangles_new(n * m, 2 * n * m, out));
  int *to = out->indices;
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < m; k++) {
      const double u = full * (double)i / (double)n, v = full * (double)k / (double)m;
      const double rho = self->radius + self->tube * cos(v);
      sw_store(out->vertices + 3 * (i * m + k),
               sw_v(rho * cos(u), rho * sin(u), self->tube * sin(v)));
      const size_t a = i * m + k, b = (i + 1) % n * m + k, up = (k + 1) % m;
      const size_t c = (i + 1) % n * m + up, d = i * m + up;
      to = sw_triangle_put(sw_triangle_put(to, a, b, c), a, c, d);
    }
  return SW_OK;
}

/* Visits chords of the circle, with the largest skin that stays inside the ring. */
static void bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  enum { CHORDS = 64 };
  const torus *self = (const torus *)shape;
  const double step = 4 * SW_HALF_PI / CHORDS, R = self->radius;
  const double skin = fmax(0, self->tube - R * (1 - cos(step / 2)));
  for (int i = 0; i < CHORDS; i++) {
    const sw_vec a = sw_v(R * cos(i * step), R * sin(i * step), 0);
    visit(user, a, a, self->tube);
    visit(user, a, sw_v(R * cos((i + 1) * step), R * sin((i + 1) * step), 0), skin);
  }
}

static double middle(const sw_shape *shape, sw_vec p, sw_vec *q, sw_vec *along) {
  const torus *self = (const torus *)shape;
  *q = on_circle(self, p);
  *along = sw_v(-q->y / self->radius, q->x / self->radius, 0);
  return self->tube;
}

static const sw_shape_wrong wrong[] = {
    {"radius = 0.1, tube = 0.1", "tube = 0.1 m is not allowed; it must be below radius = 0.1 m"},
    {"radius = 0.1", "obstacle torus: tube is required [m]"},
    {"radius = 0.1, tube = 0", "obstacle torus: tube = 0 m is not allowed"},
    {NULL, NULL}};

static const sw_param rows[] = {
    SW_LENGTH_ROW(torus_args, radius, "radius of the circle in the middle of the tube, around z"),
    SW_LENGTH_ROW(torus_args, tube, "radius of the tube, less than the circle's radius"),
};

const sw_shape_class sw_shape_class_torus = {.kind = "torus",
                                             .summary = "ring around z, an eyelet for wires",
                                             .sample = "radius = 0.35, tube = 0.15",
                                             .wrong = wrong,
                                             .params = SW_PARAMS("obstacle torus", rows),
                                             .size = sizeof(torus),
                                             .create = create,
                                             .distance = distance,
                                             .segment = segment,
                                             .triangles = triangles,
                                             .bones = bones,
                                             .middle = middle};
