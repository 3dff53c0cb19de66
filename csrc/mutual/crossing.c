/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two rods cross where the volume that they span changes its sign and they meet. Rods along each
 * other span none: they cross where the way between their nearest places turns round. */
#include "mutual/crossing.h"

#include <math.h>

/* The path is looked at in so many pieces. Two crossings within one cancel each other, as they
 * would anyway. Halvings of a piece in which the volume changes its sign [-]. */
enum { PIECES = 8, HALVINGS = 40 };
/* Volumes below this share of the edges' lengths times the sum of radii, and distances below this
 * share of it, count as zero [-]. */
static const double FLAT = 1e-9, MEETS = 1e-6;

static sw_rods at_time(const sw_rods *from, const sw_rods *to, double t) {
  sw_rods r;
  for (int i = 0; i < 2; i++)
    r.a[i] = sw_lerp(from->a[i], to->a[i], t), r.b[i] = sw_lerp(from->b[i], to->b[i], t);
  return r;
}

static double volume_of(const sw_rods *r) {
  return sw_dot(sw_sub(r->a[0], r->b[0]),
                sw_cross(sw_sub(r->a[1], r->a[0]), sw_sub(r->b[1], r->b[0])));
}

int sw_rods_side(const sw_rods *r, double reach) {
  const double v = volume_of(r);
  const double least = FLAT * reach * sw_dist(r->a[0], r->a[1]) * sw_dist(r->b[0], r->b[1]);
  return fabs(v) > least ? (v > 0 ? 1 : -1) : 0;
}

static sw_vec nearest(const sw_rods *r, double at[2]) {
  (void)sw_segments_nearest(r->a[0], r->a[1], r->b[0], r->b[1], at);
  return sw_sub(sw_lerp(r->a[0], r->a[1], at[0]), sw_lerp(r->b[0], r->b[1], at[1]));
}

/* 1 if the rods meet where the volume, of this sign at t0, changes it. */
static int meet_between(const sw_rods *from, const sw_rods *to, double t0, double t1, int side,
                        double reach, double at[2]) {
  for (int i = 0; i < HALVINGS; i++) {
    const double t = 0.5 * (t0 + t1);
    const sw_rods r = at_time(from, to, t);
    if (volume_of(&r) * side > 0)
      t0 = t;
    else
      t1 = t;
  }
  const sw_rods r = at_time(from, to, t0);
  return sw_norm(nearest(&r, at)) < MEETS * reach;
}

/* 1 if a way from w0 to w1 goes by zero nearer than SW_CROSSING_NEAR, and turns round. */
static int turns_round(sw_vec w0, sw_vec w1, double reach) {
  if (!(sw_dot(w0, w1) < -0.5 * sw_norm(w0) * sw_norm(w1))) return 0;
  const sw_vec way = sw_sub(w1, w0);
  return sw_norm(sw_cross(w0, way)) < SW_CROSSING_NEAR * reach * sw_norm(way);
}

int sw_rods_cross(const sw_rods *from, const sw_rods *to, double reach, sw_rods_past *past,
                  double at[2]) {
  int crossed = 0;
  double place[2];
  sw_rods_past last = *past;
  const int first = sw_rods_side(from, reach);
  if (first) last = (sw_rods_past){.side = first};
  for (int k = first ? 1 : 0; k <= PIECES; k++) {
    const double t0 = (double)(k > 0 ? k - 1 : 0) / PIECES, t1 = (double)k / PIECES;
    const sw_rods r = at_time(from, to, t1);
    const int now = sw_rods_side(&r, reach);
    const sw_vec way = now ? sw_v(0, 0, 0) : nearest(&r, place);
    const int meets = now ? last.side && now != last.side &&
                                meet_between(from, to, t0, t1, last.side, reach, place)
                          : turns_round(last.way, way, reach);
    if (meets) crossed = !crossed, at[0] = place[0], at[1] = place[1];
    if (now) last = (sw_rods_past){.side = now};
    if (!now && sw_norm(way) > MEETS * reach) last.way = way;
  }
  *past = last;
  return crossed;
}
