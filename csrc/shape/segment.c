/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nearest place inside a segment to a convex shape. The signed distance to a convex set is
 * convex, so its slope along the segment, normal . (b - a), only rises, and the minimum is where
 * the slope changes sign. Inside the solid the nearest face may change there (a kink). The normal
 * is then the mixture of both sides' normals that is perpendicular to the segment: the direction of
 * the edge that cuts in. */
#include "shape/shape_class.h"

typedef struct probe {
  sw_closest c;
  double slope; /* change of the gap per unit of `at` [m] */
} probe;

typedef struct line {
  const sw_shape *shape;
  sw_vec a, d; /* first end, vector to the second end [m] */
  double length;
  double level; /* smaller slopes count as zero [m] */
} line;

static void look(const line *on, double at, probe *out) {
  on->shape->class->distance(on->shape, sw_madd(on->a, on->d, at), INFINITY, &out->c);
  out->c.at = at;
  out->slope = sw_dot(out->c.normal, on->d);
}

/* Returns the height where the planes of both probes meet, and its place. The shape lies behind
 * both planes, so no gap between the probes is smaller. */
static double meet(const probe *left, const probe *right, double *at) {
  const double run = right->c.at - left->c.at;
  const double rise = right->c.gap - left->c.gap;
  *at = left->c.at + sw_limit((rise - right->slope * run) / (left->slope - right->slope), 0, run);
  return left->c.gap + left->slope * (*at - left->c.at);
}

/* Chooses the next place to probe, in turn: where the planes meet (exact for flat faces), the
 * secant of the slope (fast on round shapes), the middle (always halves the interval). */
static double next_place(const probe *left, const probe *right, double where_met, int turn) {
  const double run = right->c.at - left->c.at;
  const double edge = 0.01; /* least distance from the ends, over the interval [-] */
  double at = where_met;
  if (turn % 3 == 1) at = left->c.at - left->slope * run / (right->slope - left->slope);
  if (turn % 3 == 2) at = left->c.at + run / 2;
  return sw_limit(at, left->c.at + edge * run, right->c.at - edge * run);
}

/* Narrows an interval whose ends have slopes below and above zero. 0: no place in it is nearer than
 * reach. */
static int narrow(const line *on, probe *left, probe *right, double reach) {
  const int most = 60;        /* every third one halves: below 1e-6 at worst */
  const double sharp = 1e-15; /* error of the gap over the length, about rounding [-] */
  const double width = 1e-13; /* narrowest interval [-] */
  for (int turn = 0; turn < most; turn++) {
    double at;
    const double least = meet(left, right, &at);
    const double best = fmin(left->c.gap, right->c.gap);
    if (least >= reach) return 0;
    if (best - least <= sharp * on->length || right->c.at - left->c.at <= width) break;
    probe middle;
    look(on, next_place(left, right, at, turn), &middle);
    if (fabs(middle.slope) <= on->level) {
      *left = *right = middle;
      break;
    }
    *(middle.slope < 0 ? left : right) = middle;
  }
  return 1;
}

/* Makes the contact from two probes that enclose the minimum. */
static void settle(const line *on, const probe *left, const probe *right, sw_closest *out) {
  const double opposed = 1e-6; /* squared mixed normal below this: opposite faces [-] */
  const double smooth = 1e-6;  /* squared difference of normals below this: no kink [-] */
  const double rise = right->slope - left->slope;
  *out = left->c.gap <= right->c.gap ? left->c : right->c;
  if (!(rise > 0)) return;
  const double share = right->slope / rise; /* weight of the left normal [-] */
  const sw_vec mixed = sw_lerp(right->c.normal, left->c.normal, share);
  if (!(sw_norm2(mixed) > opposed)) return;
  const sw_vec n = sw_unit_or(mixed, out->normal);
  double at;
  meet(left, right, &at); /* exact at a kink, even for distant probes */
  if (sw_norm2(sw_sub(left->c.normal, right->c.normal)) < smooth)
    at = right->c.at + share * (left->c.at - right->c.at);
  const sw_vec p = sw_madd(on->a, on->d, at);
  const double gap = sw_dot(n, sw_sub(p, on->shape->class->support(on->shape, n)));
  *out = (sw_closest){gap, at, n, sw_madd(p, n, -gap), out->feature};
}

static line line_of(const sw_shape *shape, sw_vec a, sw_vec b) {
  const double none = 1e-12; /* slope over length taken as zero [-] */
  const sw_vec d = sw_sub(b, a);
  const double length = sw_norm(d);
  return (line){shape, a, d, length, none * length};
}

int sw_convex_segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const line on = line_of(shape, a, b);
  probe left, right;
  look(&on, 0, &left);
  if (left.slope >= -on.level) return 0;
  look(&on, 1, &right);
  if (right.slope <= on.level) return 0;
  const double gap_a = left.c.gap, gap_b = right.c.gap;
  if (!narrow(&on, &left, &right, reach)) return 0;
  settle(&on, &left, &right, out);
  if (!(out->gap < reach) || !(out->at > 0 && out->at < 1)) return 0;
  return !sw_no_better(out->gap, gap_a, gap_b, out->at, on.length);
}

int sw_convex_bridge(const sw_shape *shape, sw_vec a, sw_vec b, double reach, const double part[2],
                     sw_closest *out) {
  const double same_part = 1e-6, level = 1e-9; /* over the length [-] */
  const sw_vec d = sw_sub(b, a);
  const double length = sw_norm(d);
  const sw_closest lone = out[0];
  if (!(part[0] < part[1]) || fabs(sw_dot(lone.normal, d)) > SW_NEARLY_FLAT * length) return 1;
  const double off = 2 * SW_NEARLY_FLAT * fabs(lone.gap) / length + same_part;
  int count = 1, as_near = 0;
  sw_closest ends[2], found;
  shape->class->distance(shape, a, HUGE_VAL, &ends[0]);
  shape->class->distance(shape, b, HUGE_VAL, &ends[1]);
  for (int i = 0; i < 2; i++) {
    if (!(part[i] > 0 && part[i] < 1) || fabs(part[i] - lone.at) <= off) continue;
    if (!shape->class->distance(shape, sw_madd(a, d, part[i]), reach, &found)) continue;
    found.at = part[i];
    if (sw_no_better(found.gap, ends[0].gap, ends[1].gap, found.at, length)) continue;
    as_near += found.gap <= lone.gap + level * length;
    out[count++] = found;
  }
  if (as_near < 2) return count;
  out[0] = out[2]; /* level: the single contact was an arbitrary place between the two */
  return 2;
}

void sw_convex_nearest(const sw_shape *shape, sw_vec a, sw_vec b, sw_closest *out) {
  const line on = line_of(shape, a, b);
  probe left, right;
  look(&on, 0, &left);
  look(&on, 1, &right);
  if (left.slope < -on.level && right.slope > on.level) {
    narrow(&on, &left, &right, INFINITY);
    settle(&on, &left, &right, out);
  } else {
    *out = left.c.gap <= right.c.gap ? left.c : right.c;
  }
}
