/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Widths of an outline between parallel lines, and its ovalisation. Only the convex hull counts:
 * the least width has one of the hull's sides on a line, the largest is the distance of two of its
 * corners. */
#include <math.h>
#include <stdlib.h>

#include "strand/ring.h"

typedef struct point {
  double x, y; /* [m] */
} point;

static int before(const void *a, const void *b) {
  const point *p = a, *q = b;
  if (p->x != q->x) return p->x < q->x ? -1 : 1;
  return p->y < q->y ? -1 : p->y > q->y;
}

/* Returns twice the area of o, p, q; positive if they run anticlockwise. */
static double turn(point o, point p, point q) {
  return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
}

/* Makes one side of the hull of sorted points, from the first to the last. */
static size_t chain(const point *p, size_t n, int up, point *out) {
  size_t count = 0;
  for (size_t i = 0; i < n; i++) {
    const point next = p[up ? i : n - 1 - i];
    while (count > 1 && turn(out[count - 2], out[count - 1], next) <= 0) count--;
    out[count++] = next;
  }
  return count;
}

/* Makes the hull, anticlockwise; out has room for 2 n. Returns its number of points. */
static size_t hull_of(point *p, size_t n, point *out) {
  qsort(p, n, sizeof *p, before);
  size_t count = chain(p, n, 1, out);
  if (count > 1) count--; /* the last point begins the other side */
  count += chain(p, n, 0, out + count);
  return count > 1 ? count - 1 : count;
}

static point flat(sw_vec p, sw_vec u, sw_vec v) { return (point){sw_dot(p, u), sw_dot(p, v)}; }

static sw_vec way(double x, double y, sw_vec u, sw_vec v) {
  return sw_unit_or(sw_madd(sw_scale(u, x), v, y), u);
}

/* From this many corners on a hull is that of a smooth curve. */
enum { MANY = 64 };

/* Returns the widths of points given in axes u and v, and sorts these; hull: room for 2 n. Round a
 * smooth hull the corner farthest from a side goes on from side to side. Of a few corners all are
 * looked at, since on flat sides rounding makes some stand out. */
static sw_widths widths(point *p, size_t count, point *hull, sw_vec u, sw_vec v) {
  sw_widths out = {.least = HUGE_VAL, .least_way = u, .largest_way = u};
  const size_t n = hull_of(p, count, hull), ahead = n < MANY ? n : 2;
  double largest2 = 0;
  for (size_t i = 0, far = 1; i < n; i++) {
    const point a = hull[i], b = hull[(i + 1) % n];
    const double side = hypot(b.x - a.x, b.y - a.y);
    const size_t first = ahead == n ? 0 : far - 1;
    double wide = turn(a, b, hull[far % n]);
    for (size_t k = far + 1; k <= far + ahead; k++) {
      const double more = turn(a, b, hull[k % n]);
      if (more > wide) wide = more, far = k;
    }
    for (size_t k = first; k < (ahead == n ? n : far + 2); k++) {
      const double dx = hull[k % n].x - a.x, dy = hull[k % n].y - a.y, far2 = dx * dx + dy * dy;
      if (far2 <= largest2) continue;
      largest2 = far2;
      out.largest_way = way(dx, dy, u, v);
    }
    if (!(side > 0) || wide / side >= out.least) continue;
    out.least = wide / side;
    out.least_way = way(a.y - b.y, b.x - a.x, u, v);
  }
  out.largest = sqrt(largest2);
  out.least = fmin(out.least, out.largest);
  return out;
}

static void flatten(const double *outline, size_t n, sw_vec u, sw_vec v, point *out) {
  const sw_vec from = sw_load(outline);
  for (size_t i = 0; i < n; i++) out[i] = flat(sw_sub(sw_vec_at(outline, i), from), u, v);
}

sw_widths sw_outline_widths(const double *outline, size_t count, sw_vec tangent) {
  point p[SW_OUTLINE], hull[2 * SW_OUTLINE];
  const sw_vec u = sw_perpendicular(tangent), v = sw_cross(tangent, u);
  flatten(outline, count, u, v, p);
  return widths(p, count, hull, u, v);
}

/* --- ovalisation ---------------------------------------------------------------------- */

/* Least points of the smooth curve: 1 - cos(pi / 256) is 8e-5. With 128 an ovalisation of 0.05 was
 * 0.2 % too small [-]. */
enum { FINE = 256 };

int sw_outline_is_round(const sw_web *w) {
  const size_t n = w->around_count;
  const double *p = w->section + 2 * (size_t)w->around[0], r = hypot(p[0], p[1]);
  const double c = cos(2 * M_PI / (double)n), s = sin(2 * M_PI / (double)n);
  for (size_t k = 0; k < n; k++) {
    const double *a = w->section + 2 * (size_t)w->around[k];
    const double *b = w->section + 2 * (size_t)w->around[(k + 1) % n];
    if (hypot(c * a[0] - s * a[1] - b[0], s * a[0] + c * a[1] - b[1]) > 1e-6 * r) return 0;
  }
  return n > 2;
}

/* Interpolates n evenly spaced points by the trigonometric curve of lowest order; makes `times` as
 * many points and returns their number. */
static size_t smooth(const point *p, size_t n, size_t times, point *out) {
  const size_t all = n * times;
  double weight[FINE + 2 * SW_OUTLINE];
  for (size_t m = 0; m < all; m++) {
    const double t = M_PI * (double)m / (double)all; /* half the angle from a point */
    const double wave = n % 2 ? 1.0 / sin(t) : 1.0 / tan(t);
    weight[m] = m == 0 ? 1.0 : m % times == 0 ? 0.0 : sin((double)n * t) * wave / (double)n;
  }
  for (size_t m = 0; m < all; m++) {
    out[m] = (point){0, 0};
    for (size_t k = 0; k < n; k++) {
      const double share = weight[(m + all - k * times) % all];
      out[m].x += share * p[k].x, out[m].y += share * p[k].y;
    }
  }
  return all;
}

static size_t even(size_t n) { return n + n % 2; }

enum { DIRECTIONS = 48 }; /* in which widths are compared with those at rest [-] */

/* Returns the distance between parallel lines across a direction. */
static double width_of(const point *p, size_t n, double c, double s) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (size_t k = 0; k < n; k++) {
    const double at = c * p[k].x + s * p[k].y;
    low = fmin(low, at), high = fmax(high, at);
  }
  return high - low;
}

/* Returns the ovalisation of the widths over those of the same outline at rest, turned as the
 * section has turned. The steps at the edge of a round section of cubes are not oval. */
static double against_rest(const sw_web *w, const point *p) {
  point rest[SW_OUTLINE];
  const size_t n = w->around_count;
  double along = 0, across = 0, least = HUGE_VAL, most = 0, x = 0, y = 0;
  for (size_t k = 0; k < n; k++) x += p[k].x / (double)n, y += p[k].y / (double)n;
  for (size_t k = 0; k < n; k++) {
    const double *at = w->section + 2 * (size_t)w->around[k];
    rest[k] = (point){at[0], at[1]};
    along += at[0] * (p[k].x - x) + at[1] * (p[k].y - y);
    across += at[0] * (p[k].y - y) - at[1] * (p[k].x - x);
  }
  const double size = hypot(along, across), skins = 2.0 * (w->skin - w->proud);
  if (!(size > 0)) return 0;
  for (int d = 0; d < DIRECTIONS; d++) {
    const double angle = M_PI * d / DIRECTIONS, c = cos(angle), s = sin(angle);
    const double rc = (along * c - across * s) / size, rs = (across * c + along * s) / size;
    const double now = width_of(p, n, rc, rs), before = width_of(rest, n, c, s);
    const double share = (now + skins) / (before + skins);
    least = fmin(least, share), most = fmax(most, share);
  }
  return (most - least) / (most + least);
}

double sw_outline_ovalisation(const sw_web *w, const double *outline, sw_vec tangent) {
  point p[SW_OUTLINE], fine[FINE + 2 * SW_OUTLINE], hull[2 * (FINE + 2 * SW_OUTLINE)];
  const sw_vec u = sw_perpendicular(tangent), v = sw_cross(tangent, u);
  const size_t n = w->around_count,
               times = n && sw_outline_is_round(w) ? even((FINE + n - 1) / n) : 1;
  flatten(outline, n, u, v, p);
  if (times == 1) return against_rest(w, p);
  const size_t all = smooth(p, n, times, fine);
  const sw_widths wide = widths(fine, all, hull, u, v);
  /* a circle reaches beyond the chords between its points */
  const double least = wide.least / cos(M_PI / (double)all);
  return fmax(0.0, wide.largest - least) / (wide.largest + least + 4.0 * (w->skin - w->proud));
}

/* Returns the second harmonic of the section over the first: approximately the ovalisation. */
static double out_of_round(const sw_web *w, const double *outline, sw_vec tangent) {
  point p[SW_OUTLINE];
  const sw_vec u = sw_perpendicular(tangent), v = sw_cross(tangent, u);
  double same[2] = {0, 0}, mirrored[2] = {0, 0};
  flatten(outline, w->around_count, u, v, p);
  for (size_t k = 0; k < w->around_count; k++) {
    const double *rest = w->section + 2 * (size_t)w->around[k];
    same[0] += p[k].x * rest[0] + p[k].y * rest[1];
    same[1] += p[k].y * rest[0] - p[k].x * rest[1];
    mirrored[0] += p[k].x * rest[0] - p[k].y * rest[1];
    mirrored[1] += p[k].y * rest[0] + p[k].x * rest[1];
  }
  return hypot(mirrored[0], mirrored[1]) / hypot(same[0], same[1]);
}

/* Returns the amplitude of a harmonic of n points; roots: powers of the n-th root of 1. */
static double amplitude(const point *p, size_t n, size_t harmonic, const point *roots) {
  point sum = {0, 0};
  for (size_t k = 0; k < n; k++) {
    const point c = roots[harmonic * k % n];
    sum.x += p[k].x * c.x + p[k].y * c.y, sum.y += p[k].y * c.x - p[k].x * c.y;
  }
  return hypot(sum.x, sum.y) / (double)n;
}

/* More than 1 / cos(pi / FINE), for sides of the smooth curve are chords [-]. */
static const double CHORDS = 1.001;

/* Returns an upper bound of the ovalisation of a section that is round at rest, at little cost:
 * each harmonic of its smooth curve changes the circle's widths by twice its amplitude at most. */
static double bound_of(const sw_web *w, const double *outline, sw_vec tangent, const point *roots) {
  point p[SW_OUTLINE];
  const sw_vec u = sw_perpendicular(tangent);
  const size_t n = w->around_count;
  double others = 0;
  flatten(outline, n, u, sw_cross(tangent, u), p);
  const double circle = amplitude(p, n, 1, roots);
  for (size_t h = 2; h < n; h++) others += amplitude(p, n, h, roots);
  others *= CHORDS;
  return others < circle ? others / (circle + w->skin - w->proud) : HUGE_VAL;
}

/* Returns the ring that is likely to be the most oval. */
static size_t likely_ring(const sw_web *w, const double *x) {
  double outline[3 * SW_OUTLINE], most = -1;
  size_t ring = 0;
  for (size_t r = 0; r < w->rings; r++) {
    if (!sw_web_is_ring(w, r)) continue;
    sw_strand_outline(w, x, r, outline);
    const double now = out_of_round(w, outline, sw_web_facing(w, x, r));
    if (now > most) most = now, ring = r;
  }
  return ring;
}

/* Ovalisations that differ by less are equal: rounding makes them in round sections [-]. */
static const double SAME = 1e-9;

sw_extreme sw_strand_ovalisation(const sw_web *w, const double *x) {
  double outline[3 * SW_OUTLINE];
  point roots[SW_OUTLINE];
  const size_t n = w->around_count, likely = likely_ring(w, x);
  const int round = sw_outline_is_round(w);
  for (size_t k = 0; k < n; k++) {
    const double angle = 2 * M_PI * (double)k / (double)n;
    roots[k] = (point){cos(angle), sin(angle)};
  }
  sw_strand_outline(w, x, likely, outline);
  sw_extreme most = {.value = sw_outline_ovalisation(w, outline, sw_web_facing(w, x, likely)),
                     .s = w->s[w->first[likely]]};
  for (size_t r = 0; r < w->rings; r++) {
    if (r == likely || !sw_web_is_ring(w, r)) continue;
    const sw_vec tangent = sw_web_facing(w, x, r);
    sw_strand_outline(w, x, r, outline);
    if (round && bound_of(w, outline, tangent, roots) <= most.value + SAME) continue;
    const double now = sw_outline_ovalisation(w, outline, tangent);
    if (now > most.value + SAME) most = (sw_extreme){.value = now, .s = w->s[w->first[r]]};
  }
  return most;
}

/* Returns the distance of p from the side a-b [m]. */
static double from_side(point p, point a, point b) {
  const double x = b.x - a.x, y = b.y - a.y, l2 = x * x + y * y;
  const double along = l2 > 0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / l2 : 0.0;
  const double at = fmax(0.0, fmin(1.0, along));
  return hypot(p.x - a.x - at * x, p.y - a.y - at * y);
}

static int sides_cross(point a, point b, point c, point d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

double sw_strand_walls_apart(const sw_web *w, const double *x, double s) {
  double outline[3 * SW_OUTLINE], least = HUGE_VAL;
  point p[SW_OUTLINE];
  const size_t n = w->around_count;
  size_t r = 0;
  while (r + 1 < w->rings && !(sw_web_is_ring(w, r) && w->s[w->first[r]] >= s)) r++;
  if (w->per_ring != n || !sw_web_is_ring(w, r)) return least;
  sw_strand_outline(w, x, r, outline);
  const sw_vec tangent = sw_web_facing(w, x, r), u = sw_perpendicular(tangent);
  flatten(outline, n, u, sw_cross(tangent, u), p);
  for (size_t i = 0; i < n; i++)
    for (size_t away = n / 4 + 1; away + n / 4 + 1 < n; away++) { /* beyond the bend of a fold */
      const size_t j = (i + away) % n;
      const point a = p[i], b = p[(i + 1) % n], c = p[j], d = p[(j + 1) % n];
      least = fmin(least, sides_cross(a, b, c, d) ? 0.0 : from_side(a, c, d));
    }
  return least;
}

void sw_outline_widen(const double *outline, size_t n, sw_vec tangent, double skin, double *out) {
  for (size_t i = 0; i < n; i++) {
    const sw_vec a = sw_vec_at(outline, (i + n - 1) % n), p = sw_vec_at(outline, i);
    const sw_vec b = sw_vec_at(outline, (i + 1) % n), none = sw_v(0, 0, 0);
    const sw_vec n1 = sw_unit_or(sw_cross(sw_sub(p, a), tangent), none);
    const sw_vec n2 = sw_unit_or(sw_cross(sw_sub(b, p), tangent), none);
    sw_store(out + 3 * i, sw_madd(p, sw_unit_or(sw_add(n1, n2), n1), skin));
  }
}

void sw_strand_outline(const sw_web *w, const double *x, size_t ring, double *out) {
  const double *at = x + 3 * w->first[ring];
  if (sw_web_is_ring(w, ring)) {
    for (size_t k = 0; k < w->around_count; k++) sw_store(out + 3 * k, sw_vec_at(at, w->around[k]));
    return;
  }
  /* a line's particle: the undeformed section, at an arbitrary rotation */
  const sw_vec t = sw_web_facing(w, x, ring), u = sw_perpendicular(t), v = sw_cross(t, u);
  for (size_t k = 0; k < w->around_count; k++) {
    const double *rest = w->section + 2 * (size_t)w->around[k];
    sw_store(out + 3 * k, sw_madd(sw_madd(sw_load(at), u, rest[0]), v, rest[1]));
  }
}
