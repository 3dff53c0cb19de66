/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An edge's turn within a step is counted from its frame at the step's start, carried along a great
 * circle to its present tangent. The frames themselves are carried from iterate to iterate, so they
 * also turn by the area between both paths. */
#include "system/roll.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/simd.h"
#include "solve/band4.h"
#include "state/hinge.h"
#include "system/spin.h"

sw_status sw_roll_new(sw_body *b) {
  const size_t stride = b->plan->nodes + SW_LANES;
  if (!b->plan->beam.rolls) return SW_OK;
  double *w = sw_alloc(10 * stride, sizeof *w);
  if (!w) return SW_ENOMEM;
  b->roll_block = w;
  b->roll_turn = w;
  for (size_t k = 0; k < 3; k++) b->roll_from[k] = w + (1 + k) * stride;
  for (size_t k = 0; k < 6; k++) b->field.spin_node[k] = w + (4 + k) * stride;
  return SW_OK;
}

/* Returns the body's part of the edges' turns in an array of freedoms (x, v, a, y, ...). */
static const double *of(const sw_system *s, const sw_body *b, const double *freedoms) {
  return freedoms + 3 * s->nodes + b->first_roll;
}

void sw_roll_begin(const sw_system *s SW_UNUSED, sw_body *b) {
  if (!b->roll_block) return;
  const size_t m = b->plan->edges;
  memset(b->roll_turn, 0, m * sizeof(double));
  for (size_t k = 0; k < 3; k++) memcpy(b->roll_from[k], b->spin_tangent[k], m * sizeof(double));
}

void sw_roll_rest(const sw_system *s, const sw_body *b, const double *y, double *out) {
  const double *x = of(s, b, s->x), *to = of(s, b, y);
  for (size_t e = 0; e < b->plan->edges; e++) out[e] = to[e] - x[e] - b->roll_turn[e];
}

void sw_roll_predict(const sw_system *s, sw_body *b, double rate2) {
  if (!b->roll_block) return;
  b->spin_inertia = b->plan->beam.spin_inertia * rate2;
  sw_roll_rest(s, b, s->yhat, b->field.scratch[0]);
  sw_spin_turn_by(b, b->field.scratch[0], 1, 1.0);
}

/* Edges may turn by more than half a turn at once. A hinge's twist can only be measured up to whole
 * turns, so it is advanced here as well. */
void sw_roll_add(sw_body *b, const double *angle, size_t stride, double share) {
  const sw_plan *p = b->plan;
  if (!b->roll_block) return;
  for (size_t e = 0; e < p->edges; e++) {
    const double turn = share * angle[e * stride];
    b->roll_turn[e] += turn;
    b->spin_twist[e] += turn;
    b->spin_twist[e + 1] -= turn;
  }
  for (size_t c = 0; c < p->clamp_count; c++) {
    const double turn = share * angle[p->clamps[c].edge * stride];
    b->spin_twist[p->nodes + c] += p->clamps[c].side > 0 ? turn : -turn;
  }
}

/* Adds the areas of the triangles (from, before, now) to the turns where they are small. Returns
 * the number of large ones. */
SW_HOT
static long add_areas(size_t m, const double *restrict fx, const double *restrict fy,
                      const double *restrict fz, const double *restrict bx,
                      const double *restrict by, const double *restrict bz,
                      const double *restrict nx, const double *restrict ny,
                      const double *restrict nz, double *restrict turn) {
  long others = 0;
  for (size_t e = 0; e < m; e++) {
    const double volume = fx[e] * (by[e] * nz[e] - bz[e] * ny[e]) +
                          fy[e] * (bz[e] * nx[e] - bx[e] * nz[e]) +
                          fz[e] * (bx[e] * ny[e] - by[e] * nx[e]);
    const double sum = 1.0 + (fx[e] * bx[e] + fy[e] * by[e] + fz[e] * bz[e]) +
                       (bx[e] * nx[e] + by[e] * ny[e] + bz[e] * nz[e]) +
                       (nx[e] * fx[e] + ny[e] * fy[e] + nz[e] * fz[e]);
    const double half = volume / sum, y = half * half;
    const int small = (y < 0.01) & (sum > 0);
    others += !small;
    turn[e] += small ? SW_TWICE_ATAN(half, y) : 0.0;
  }
  return others;
}

/* Returns the area if it is large, else 0. */
static double large_area(double *const from[3], double *const before[3], double *const now[3],
                         size_t e) {
  const sw_vec a = sw_vec_across(from, e), b = sw_vec_across(before, e), c = sw_vec_across(now, e);
  const double volume = sw_dot(a, sw_cross(b, c));
  const double sum = 1.0 + sw_dot(a, b) + sw_dot(b, c) + sw_dot(c, a);
  const double half = volume / sum;
  return half * half < 0.01 && sum > 0 ? 0.0 : 2.0 * atan2(volume, sum);
}

void sw_roll_carry(sw_body *b, double *const t[3]) {
  double *const *f = b->roll_from, *const *o = b->spin_tangent;
  const size_t m = b->plan->edges;
  if (!b->roll_block) return;
  if (add_areas(m, f[0], f[1], f[2], o[0], o[1], o[2], t[0], t[1], t[2], b->roll_turn))
    for (size_t e = 0; e < m; e++) b->roll_turn[e] += large_area(f, o, t, e);
}

void sw_roll_load(const sw_system *s, const sw_body *b, double *right) {
  const double *x = of(s, b, s->x), *yhat = of(s, b, s->yhat);
  if (!b->roll_block) return;
  for (size_t e = 0; e < b->plan->edges; e++) {
    const double inertia = b->spin_inertia * b->plan->rest[e];
    b->spin_rows[SW_ROW4_SIZE * e + 15] += inertia;
    right[4 * e + 3] -= inertia * (x[e] + b->roll_turn[e] - yhat[e]);
  }
  for (size_t i = 0; i < s->held_count; i++) {
    const long e = sw_spin_held_edge(s, b, i);
    if (e >= 0) right[4 * e + 3] = 0;
  }
}

void sw_roll_store(const sw_system *s, const sw_body *b, double *y) {
  const double *x = of(s, b, s->x);
  double *out = y + (of(s, b, s->x) - s->x);
  if (!b->roll_block) return;
  for (size_t e = 0; e < b->plan->edges; e++) out[e] = x[e] + b->roll_turn[e];
}

double sw_roll_kinetic(const sw_system *s, const sw_body *b) {
  const double *v = of(s, b, s->v);
  double sum = 0;
  if (!b->roll_block) return 0;
  for (size_t e = 0; e < b->plan->edges; e++)
    sum += 0.5 * b->plan->beam.spin_inertia * b->plan->rest[e] * v[e] * v[e];
  return sum;
}
