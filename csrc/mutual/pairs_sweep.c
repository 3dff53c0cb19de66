/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The swept test of two segments. Segments are straight; a smooth curve is split into pieces that
 * are nearly straight. */
#include "mutual/pairs_sweep.h"

#include <math.h>

#include "mutual/pairs_curve.h"
#include "touch/same.h"

/* Axes nearer than this share of the sum of radii are about to pass through each other. Contact
 * alone never lets them come so near [-]. */
static const double TOO_NEAR = 0.25;
enum { MOST_ADVANCES = 200 };

static sw_vec end_of(const sw_system *s, const sw_pair *k, int side, double at, const double *x) {
  const sw_bow bow = sw_pair_bow(s, k, side, at);
  return sw_mean_of(x, 0, &bow.spot);
}

/* A half edge is divided into at most MOST_PARTS pieces, so that no piece is further from its curve
 * than this share of the sum of radii [-]. */
static const double STRAIGHT = 0.1;
enum { MOST_PARTS = 8 };

/* Number of pieces of an edge, for positions from x0 to x1. */
static int parts_of(const sw_system *s, const sw_pair *k, int side, const double *x0,
                    const double *x1) {
  if (!k->smooth) return 1;
  const sw_body *b = &s->bodies[k->body[side]];
  const uint32_t node = side ? k->two : k->one;
  const double most = fmax(sw_pair_off_middle(b, node, x0), sw_pair_off_middle(b, node, x1));
  const double needed = ceil(sqrt(most / (32.0 * STRAIGHT * k->reach)));
  return 2 * (int)fmin(fmax(needed, 1), MOST_PARTS);
}

static inline sw_rods chords_of(const sw_pair *k, const double *x) {
  return (sw_rods){{sw_vec_at(x, k->one), sw_vec_at(x, k->one + 1u)},
                   {sw_vec_at(x, k->two), sw_vec_at(x, k->two + 1u)}};
}

/* Returns the rods of piece part[0] of segment one and piece part[1] of segment two. */
static sw_rods rods_of(const sw_system *s, const sw_pair *k, const int part[2], const int of[2],
                       const double *x) {
  if (!k->smooth) return chords_of(k, x);
  sw_rods r;
  for (int i = 0; i < 2; i++) {
    r.a[i] = end_of(s, k, 0, (double)(part[0] + i) / of[0], x);
    r.b[i] = end_of(s, k, 1, (double)(part[1] + i) / of[1], x);
  }
  return r;
}

static inline double approach(const sw_rods *from, const sw_rods *to) {
  double most = 0;
  for (int i = 0; i < 2; i++) {
    const sw_vec a = sw_sub(to->a[i], from->a[i]);
    for (int j = 0; j < 2; j++) {
      const double d2 = sw_norm2(sw_sub(a, sw_sub(to->b[j], from->b[j])));
      most = most > d2 ? most : d2;
    }
  }
  return sqrt(most);
}

double sw_pair_approach(const sw_system *s, const sw_pair *k, const double *x0, const double *x1) {
  double most = 0;
  if (!k->smooth) {
    const sw_rods from = chords_of(k, x0), to = chords_of(k, x1);
    return approach(&from, &to);
  }
  const int of[2] = {2, 2};
  for (int i = 0; i < of[0]; i++)
    for (int j = 0; j < of[1]; j++) {
      const sw_rods from = rods_of(s, k, (int[2]){i, j}, of, x0),
                    to = rods_of(s, k, (int[2]){i, j}, of, x1);
      most = fmax(most, approach(&from, &to));
    }
  return most;
}

static sw_rods part_way(const sw_rods *from, const sw_rods *to, double t) {
  sw_rods r;
  for (int i = 0; i < 2; i++)
    r.a[i] = sw_lerp(from->a[i], to->a[i], t), r.b[i] = sw_lerp(from->b[i], to->b[i], t);
  return r;
}

/* As sw_rods_sweep, for a distance of the axes. least: rods with a smaller relative motion do not
 * come so near, unless they start too near [m]. */
static int comes_near(const sw_rods *from, const sw_rods *to, double near, double least,
                      double at[2], sw_vec *normal, double *when) {
  const double speed = approach(from, to);
  double t = 0;
  if (speed < least) return 0;
  for (int i = 0; i < MOST_ADVANCES; i++) {
    const sw_rods r = part_way(from, to, t);
    const double d = sw_segments_nearest(r.a[0], r.a[1], r.b[0], r.b[1], at);
    if (i == 0 && d <= near) return 0; /* they are too near at the start */
    if (d <= 1.01 * near) {
      const sw_vec apart = sw_sub(sw_lerp(r.a[0], r.a[1], at[0]), sw_lerp(r.b[0], r.b[1], at[1]));
      *normal = sw_unit_or(apart, sw_v(0, 0, 1)), *when = t;
      return 1;
    }
    t += (d - near) / speed;
    if (t >= 1) return 0;
  }
  return 0;
}

int sw_rods_sweep(const sw_rods *from, const sw_rods *to, double reach, double at[2],
                  sw_vec *normal, double *when) {
  return comes_near(from, to, TOO_NEAR * reach, TOO_NEAR * reach, at, normal, when);
}

int sw_pair_sweep(const sw_system *s, const sw_pair *k, const double *x0, const double *x1,
                  double at[2], sw_vec *normal) {
  double first = HUGE_VAL;
  if (sw_pair_approach(s, k, x0, x1) < TOO_NEAR * k->reach) return 0;
  const int of[2] = {parts_of(s, k, 0, x0, x1), parts_of(s, k, 1, x0, x1)};
  for (int i = 0; i < of[0] * of[1]; i++) {
    const int part[2] = {i % of[0], i / of[0]};
    const sw_rods from = rods_of(s, k, part, of, x0), to = rods_of(s, k, part, of, x1);
    double here[2], when;
    sw_vec n;
    if (!sw_rods_sweep(&from, &to, k->reach, here, &n, &when) || !(when < first)) continue;
    first = when, *normal = n;
    for (int side = 0; side < 2; side++)
      at[side] = of[side] > 1 ? (here[side] + part[side]) / of[side] : here[side];
  }
  return first < HUGE_VAL;
}

double sw_pair_distance(const sw_system *s, const sw_pair *k, const double *x) {
  double at[2];
  const double chords = sw_segments_nearest(sw_vec_at(x, k->one), sw_vec_at(x, k->one + 1u),
                                            sw_vec_at(x, k->two), sw_vec_at(x, k->two + 1u), at);
  if (!k->smooth) return chords;
  int slides[2];
  if (!sw_pair_crossing(s, k, x, at, slides)) return HUGE_VAL;
  const sw_bow bow[2] = {sw_pair_bow(s, k, 0, at[0]), sw_pair_bow(s, k, 1, at[1])};
  return sw_dot(sw_pair_normal(x, bow, slides), sw_bows_apart(x, bow));
}

int sw_pair_brushes(const sw_pair *k, const double *x0, const double *x1) {
  const sw_rods from = chords_of(k, x0), to = chords_of(k, x1);
  double at[2], when;
  sw_vec normal;
  if (!comes_near(&from, &to, (1.0 - SW_MISSED) * k->reach, SW_MISSED_WAY * k->reach, at, &normal,
                  &when))
    return 0;
  return sw_segments_nearest(to.a[0], to.a[1], to.b[0], to.b[1], at) > k->reach;
}
