/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "force/clip_law.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* The way over the lips when it is not given: that of a round wire through a mouth two thirds as
 * wide, 2 sqrt(1 - (2/3)^2) of the radius [-]. */
static const double USUAL_WAY = 1.5;
/* Floor and walls give way by a fiftieth of the radius under the larger of both forces [-]. */
static const double USUAL_STIFFNESS = 50.0;
/* They end where a wire that comes from outside touches a wall half a radius thick: halfway
 * through that they hold no more [radii]. */
static const double REACH = 1.25;

/* A function of one variable and its derivatives. */
typedef struct curve {
  double f, d, dd;
} curve;

/* height sin^2(pi x / (2 length)): from 0 at x = 0 to its top at x = length. */
static curve hump(double x, double length, double height) {
  const double a = 0.5 * PI / length, s = sin(a * x), c = cos(a * x);
  return (curve){height * s * s, 2.0 * height * a * s * c, 2.0 * height * a * a * (c * c - s * s)};
}

/* The same of a variable that goes the other way. */
static curve mirrored(curve c) { return (curve){c.f, -c.d, c.dd}; }

/* From 1 at x = 0 to 0 at x = length. */
static curve fade(double x, double length) {
  const curve c = hump(length - x, length, 1.0);
  return mirrored(c);
}

static const curve NOTHING = {0, 0, 0}, ONE = {1, 0, 0};

/* A spring of stiffness k that holds no more at depth reach and is nothing at twice that. */
static curve barrier(double depth, double reach, double k) {
  const double a = 0.5 * PI / reach;
  if (!(depth > 0) || depth >= 2.0 * reach) return NOTHING;
  return hump(depth, reach, 0.5 * k / (a * a));
}

static curve spring(double depth, double k) {
  return depth > 0 ? (curve){0.5 * k * depth * depth, k * depth, k} : NOTHING;
}

/* What floor and walls do at this depth. */
static curve side(const sw_clip_law *l, double depth) {
  return l->caught ? spring(depth, l->k) : barrier(depth, l->reach, l->k);
}

static curve lips(const sw_clip_law *l, double u) {
  if (!(u > 0) || u >= l->out + l->in) return NOTHING;
  if (u < l->out) return hump(u, l->out, l->top);
  return mirrored(hump(l->out + l->in - u, l->in, l->top));
}

static curve floor_of(const sw_clip_law *l, double u) {
  return mirrored(side(l, -l->clearance - u));
}

/* Of something even in v, from what it is at depth |v| - clearance. */
static curve even(curve c, double v) { return v < 0 ? mirrored(c) : c; }

static curve walls(const sw_clip_law *l, double v) {
  return even(side(l, fabs(v) - l->clearance), v);
}

/* Between the walls: where lips and floor are. */
static curve between(const sw_clip_law *l, double v) {
  const double depth = fabs(v) - l->clearance;
  if (depth <= 0) return ONE;
  return depth < 2.0 * l->reach ? even(fade(depth, 2.0 * l->reach), v) : NOTHING;
}

/* Between floor and mouth: where walls are. */
static curve beside(const sw_clip_law *l, double u) {
  const double above = u - l->out, below = -l->clearance - u;
  if (above > 0) return above < l->in ? fade(above, l->in) : NOTHING;
  if (below <= 0 || l->caught) return ONE;
  return below < 2.0 * l->reach ? mirrored(fade(below, 2.0 * l->reach)) : NOTHING;
}

sw_clip_law sw_clip_law_of(double wire, double seat, double insertion, double retention, double way,
                           double stiffness) {
  const double length = isnan(way) ? USUAL_WAY * wire : way;
  sw_clip_law l;
  l.out = length * insertion / (insertion + retention);
  l.in = length - l.out;
  l.top = 2.0 / PI * retention * l.out;
  l.clearance = isnan(seat) ? 0.0 : fmax(0.0, seat - wire);
  l.k = isnan(stiffness) ? USUAL_STIFFNESS * fmax(insertion, retention) / wire : stiffness;
  l.reach = REACH * wire;
  return l;
}

sw_clip_point sw_clip_at(const sw_clip_law *l, double u, double v) {
  const curve a = lips(l, u), b = floor_of(l, u), h = l->caught ? ONE : between(l, v);
  const curve w = walls(l, v), g = beside(l, u);
  const curve p = {a.f + b.f, a.d + b.d, a.dd + b.dd};
  return (sw_clip_point){.energy = p.f * h.f + g.f * w.f,
                         .u = p.d * h.f + g.d * w.f,
                         .v = p.f * h.d + g.f * w.d,
                         .uu = p.dd * h.f + g.dd * w.f,
                         .uv = p.d * h.d + g.d * w.d,
                         .vv = p.f * h.dd + g.f * w.dd};
}

double sw_clip_between(const sw_clip_law *l, double v) { return between(l, v).f; }

double sw_clip_stiffest(const sw_clip_law *l) {
  const double flank = 0.5 * PI * PI * l->top / (fmin(l->in, l->out) * fmin(l->in, l->out));
  return fmax(l->k, flank);
}
