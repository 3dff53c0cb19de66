/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The clip's potential and its derivatives as products of curves of u and v. */
#include "force/clip_law.h"

#include <math.h>

/* Default way over the lips, over the wire's radius: a round wire through a mouth two thirds as
 * wide, 2 sqrt(1 - (2/3)^2) [-]. */
static const double USUAL_WAY = 1.5;
/* Default stiffness of floor and walls: they yield by 1/50 of the radius under the larger lip force
 * [-]. */
static const double USUAL_STIFFNESS = 50.0;
/* Default depth, in wire radii, from which floor and walls no longer push back. They end at twice
 * this depth, where a wire from outside touches a wall half a radius thick [-]. */
static const double REACH = 1.25;

/* A function of one variable and its derivatives. */
typedef struct curve {
  double f, d, dd;
} curve;

/* Returns height sin^2(pi x / (2 length)): from 0 at x = 0 to its top at x = length. */
static sw_clip_hump hump_of(double length, double height) {
  const double a = 0.5 * M_PI / length;
  return (sw_clip_hump){length, a, height, 2.0 * height * a, 2.0 * height * a * a};
}

static curve hump(const sw_clip_hump *h, double x) {
  const double s = sin(h->rate * x), c = cos(h->rate * x);
  return (curve){h->height * s * s, h->slope * s * c, h->curve * (c * c - s * s)};
}

/* Returns the function of -x. */
static curve mirrored(curve c) { return (curve){c.f, -c.d, c.dd}; }

/* Returns a curve that falls from 1 at x = 0 to 0 at x = length. h: of height 1. */
static curve fade(const sw_clip_hump *h, double x) { return mirrored(hump(h, h->length - x)); }

static const curve NOTHING = {0, 0, 0}, ONE = {1, 0, 0};

/* 1 if floor or wall acts at this depth. */
static int acts(const sw_clip_law *l, double depth) { return depth > 0 && depth < 2.0 * l->reach; }

/* Potential of floor or wall at this depth: a spring of stiffness k. Its force peaks at depth reach
 * / 2, vanishes at reach, then pushes towards the far side; it ends at twice reach. */
static curve side(const sw_clip_law *l, double depth) {
  return acts(l, depth) ? hump(&l->side, depth) : NOTHING;
}

static curve lips(const sw_clip_law *l, double u) {
  if (!(u > 0) || u >= l->out + l->in) return NOTHING;
  if (u < l->out) return hump(&l->inner, u);
  return mirrored(hump(&l->outer, l->out + l->in - u));
}

static curve floor_of(const sw_clip_law *l, double u) {
  return mirrored(side(l, -l->clearance - u));
}

/* Extends a function of the depth |v| - clearance evenly to negative v. */
static curve even(curve c, double v) { return v < 0 ? mirrored(c) : c; }

/* Returns how much further apart the walls are above the lips' top: a funnel that ends at 45
 * degrees. */
static curve widening(const sw_clip_law *l, double u) {
  const double above = u - l->out;
  if (!(above > 0)) return NOTHING;
  return (curve){0.5 * above * above / l->in, above / l->in, 1.0 / l->in};
}

/* Weight of lips and floor: 1 between the walls. */
static curve between(const sw_clip_law *l, double v) {
  const double depth = fabs(v) - l->clearance;
  if (depth <= 0) return ONE;
  return depth < 2.0 * l->reach ? even(fade(&l->ends, depth), v) : NOTHING;
}

/* Weight of the walls: 1 between floor and mouth. */
static curve beside(const sw_clip_law *l, double u) {
  const double above = u - l->out, below = -l->clearance - u;
  if (above > 0) return above < l->in ? fade(&l->mouth, above) : NOTHING;
  if (below <= 0 || l->caught) return ONE;
  return below < 2.0 * l->reach ? mirrored(fade(&l->ends, below)) : NOTHING;
}

sw_clip_law sw_clip_law_of(double wire, double seat, double insertion, double retention, double way,
                           double stiffness, double strength) {
  const double length = isnan(way) ? USUAL_WAY * wire : way;
  sw_clip_law l;
  l.out = length * insertion / (insertion + retention);
  l.in = length * retention / (insertion + retention);
  l.top = 2.0 / M_PI * retention * l.out;
  l.clearance = isnan(seat) ? 0.0 : fmax(0.0, seat - wire);
  l.k = isnan(stiffness) ? USUAL_STIFFNESS * fmax(insertion, retention) / wire : stiffness;
  l.reach = REACH * wire;
  if (!isnan(strength) && isnan(stiffness)) l.k = M_PI * strength / l.reach;
  if (!isnan(strength)) l.reach = M_PI * strength / l.k;
  l.strength = l.k * l.reach / M_PI;
  l.caught = 0;
  const double a = 0.5 * M_PI / l.reach;
  l.inner = hump_of(l.out, l.top), l.outer = hump_of(l.in, l.top);
  l.side = hump_of(l.reach, 0.5 * l.k / (a * a));
  l.ends = hump_of(2.0 * l.reach, 1.0), l.mouth = hump_of(l.in, 1.0);
  return l;
}

/* Adds the walls: their potential at their depth times their weight at u. */
static void add_walls(const sw_clip_law *l, double u, double v, sw_clip_point *p) {
  const curve z = widening(l, u);
  const double depth = fabs(v) - l->clearance - z.f, sign = v < 0 ? -1.0 : 1.0;
  if (!acts(l, depth)) return;
  const curve g = beside(l, u), w = side(l, depth);
  p->energy += w.f * g.f;
  p->u += w.f * g.d - w.d * z.d * g.f;
  p->v += sign * w.d * g.f;
  p->uu += w.f * g.dd - 2.0 * w.d * z.d * g.d + (w.dd * z.d * z.d - w.d * z.dd) * g.f;
  p->uv += sign * (w.d * g.d - w.dd * z.d * g.f);
  p->vv += w.dd * g.f;
}

sw_clip_point sw_clip_at(const sw_clip_law *l, double u, double v) {
  const curve a = lips(l, u), b = floor_of(l, u), h = l->caught ? ONE : between(l, v);
  const curve q = {a.f + b.f, a.d + b.d, a.dd + b.dd};
  sw_clip_point p = {.energy = q.f * h.f,
                     .u = q.d * h.f,
                     .v = q.f * h.d,
                     .uu = q.dd * h.f,
                     .uv = q.d * h.d,
                     .vv = q.f * h.dd};
  add_walls(l, u, v, &p);
  return p;
}

double sw_clip_between(const sw_clip_law *l, double v) { return between(l, v).f; }

double sw_clip_stiffest(const sw_clip_law *l) {
  const double flank = 0.5 * M_PI * M_PI * l->top / (fmin(l->in, l->out) * fmin(l->in, l->out));
  return fmax(l->k, flank);
}
