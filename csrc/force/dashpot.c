/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moment eta (w2 - w1)/l of a hinge between edges with angular velocities w1 and w2; l: its
 * length. */
#include "force/dashpot.h"

#include <math.h>

#include "base/simd.h"
#include "state/clamp.h"

/* Returns the rotation of an edge without its spin: t x v / l [rad/s]. */
static sw_vec rotation_of(const sw_field *f, size_t e) {
  const sw_vec v = sw_sub(sw_load(f->v + 3 * e + 3), sw_load(f->v + 3 * e));
  return sw_scale(sw_cross(sw_field_tangent(f, e), v), f->reciprocal[e]);
}

/* own[e] += k (I - t t') */
static void add_own(sw_field *f, size_t e, double k) {
  const double t[3] = {f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]};
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++) f->own[at][e] += k * ((i == j ? 1.0 : 0.0) - t[i] * t[j]);
}

/* own += kr (I - t t') / l^2 for the edge at shift (0: second edge of the hinge, -1: first) */
SW_HOT
static void own_of_hinges(size_t n, long shift, double eta, const double *restrict hinge,
                          const double *restrict rl, const double *restrict tx,
                          const double *restrict ty, const double *restrict tz, double *restrict o0,
                          double *restrict o1, double *restrict o2, double *restrict o3,
                          double *restrict o4, double *restrict o5) {
  for (long i = 1; i + 1 < (long)n; i++) {
    const long e = i + shift;
    const double k = (hinge[i] > 0 ? eta / hinge[i] : 0.0) * rl[e] * rl[e];
    o0[e] += k * (1.0 - tx[e] * tx[e]);
    o1[e] -= k * tx[e] * ty[e];
    o2[e] -= k * tx[e] * tz[e];
    o3[e] += k * (1.0 - ty[e] * ty[e]);
    o4[e] -= k * ty[e] * tz[e];
    o5[e] += k * (1.0 - tz[e] * tz[e]);
  }
}

/* next -= kr (t1.t2 I - t2 t1') / (l1 l2) */
SW_HOT
static void next_of_hinges(size_t n, double eta, const double *restrict hinge,
                           const double *restrict rl, const double *restrict tx,
                           const double *restrict ty, const double *restrict tz,
                           double *restrict n0, double *restrict n1, double *restrict n2,
                           double *restrict n3, double *restrict n4, double *restrict n5,
                           double *restrict n6, double *restrict n7, double *restrict n8) {
  for (size_t i = 1; i + 1 < n; i++) {
    const double k = (hinge[i] > 0 ? eta / hinge[i] : 0.0) * rl[i - 1] * rl[i];
    const double ax = tx[i - 1], ay = ty[i - 1], az = tz[i - 1];
    const double bx = tx[i], by = ty[i], bz = tz[i], c = ax * bx + ay * by + az * bz;
    n0[i] -= k * (c - bx * ax);
    n1[i] += k * bx * ay;
    n2[i] += k * bx * az;
    n3[i] += k * by * ax;
    n4[i] -= k * (c - by * ay);
    n5[i] += k * by * az;
    n6[i] += k * bz * ax;
    n7[i] += k * bz * ay;
    n8[i] -= k * (c - bz * az);
  }
}

/* before, after: rotations of the hinge's edges. */
static void move_hinge(double k, sw_field *f, size_t i, sw_vec before, sw_vec after) {
  const sw_vec rate = sw_sub(after, before), m = sw_scale(rate, k);
  if (f->want & SW_WANT_POWER) f->power += k * sw_norm2(rate);
  if (!(f->want & SW_WANT_FORCE)) return;
  sw_field_add_gradient(f, i - 1,
                        sw_scale(sw_cross(sw_field_tangent(f, i - 1), m), f->reciprocal[i - 1]));
  sw_field_add_gradient(f, i, sw_scale(sw_cross(m, sw_field_tangent(f, i)), f->reciprocal[i]));
}

void sw_dashpot_hinges(double eta, sw_field *f) {
  const sw_plan *p = f->plan;
  const size_t n = p->nodes;
  double *const *t = f->tangent, *const *o = f->own, *const *x = f->next;
  if (n < 3) return;
  if (f->want & (SW_WANT_FORCE | SW_WANT_POWER)) {
    sw_vec before = rotation_of(f, 0);
    for (size_t i = 1; i + 1 < n; i++) {
      const sw_vec after = rotation_of(f, i);
      if (p->hinge[i] > 0) move_hinge(eta / p->hinge[i], f, i, before, after);
      before = after;
    }
  }
  if (!(f->want & SW_WANT_STIFFNESS)) return;
  const double k = eta * f->velocity_rate;
  for (long shift = -1; shift <= 0; shift++)
    own_of_hinges(n, shift, k, p->hinge, f->reciprocal, t[0], t[1], t[2], o[0], o[1], o[2], o[3],
                  o[4], o[5]);
  next_of_hinges(n, k, p->hinge, f->reciprocal, t[0], t[1], t[2], x[0], x[1], x[2], x[3], x[4],
                 x[5], x[6], x[7], x[8]);
}

/* Returns the speed at which a clamp's first edge grows: wire leaves a feed [m/s]. */
static double flow_of(const sw_field *f, const sw_clamp_hinge *h) {
  return h->side * f->hold_flows[h->hold];
}

/* Returns the rate at which a clamp's hinge grows, over its length [1/s]. */
static double growth_of(const sw_field *f, const sw_clamp_hinge *h) {
  const double flow = flow_of(f, h);
  return flow != 0 ? flow * sw_plan_clamp_growth(f->plan, h) : 0.0;
}

/* Returns the rotation from the edge to the hold in the unloaded wire [rad]. */
static sw_vec rest_of(const sw_field *f, const sw_clamp_hinge *h, sw_vec d) {
  const sw_plan *p = f->plan;
  if (!p->rest_bend || !f->hold_normals) return sw_v(0, 0, 0);
  const double *bend = p->rest_bend + 2 * (p->nodes + (size_t)(h - p->clamps));
  const sw_vec m1 = sw_vec_at(f->hold_normals, sw_clamp_place(h));
  const sw_vec turn = sw_madd(sw_scale(sw_cross(d, m1), bend[0]), m1, -bend[1]);
  return sw_scale(turn, -h->side);
}

/* Returns the rate at which the hold turns relative to the edge because the hinge grows, without
 * load in proportion to the edge's length [rad/s]. */
static sw_vec flowing(const sw_field *f, const sw_clamp_hinge *h, sw_vec d, sw_vec t) {
  const double flow = flow_of(f, h);
  if (flow == 0) return sw_v(0, 0, 0);
  const sw_vec rest = rest_of(f, h, d), bend = sw_sub(sw_cross(t, d), rest);
  return sw_madd(sw_scale(bend, growth_of(f, h)), rest, flow / f->plan->rest[h->edge]);
}

/* Returns the rotation rate of the hold relative to the edge, about axes across the edge
 * [rad/s]. Length that the hinge of a feed gains turns with its curvature, without any moment. By
 * velocities the edge turns like wire that flows along the bend, and so does the wire in the hold.
 */
static sw_vec clamp_rate(const sw_field *f, const sw_clamp_hinge *h) {
  const size_t c = (size_t)(h - f->plan->clamps);
  const sw_vec d = sw_vec_at(f->hold_directors, sw_clamp_place(h)),
               t = sw_field_tangent(f, h->edge);
  const sw_vec turn = sw_vec_at(f->hold_turns, (size_t)h->hold);
  const double spin = sw_dot(turn, d); /* spin does not count, see dashpot.h */
  if (f->clamp_past || f->clamp_rate) {
    const sw_vec away = f->clamp_past
                            ? sw_scale(sw_sub(t, sw_vec_at(f->clamp_past, c)), f->velocity_rate)
                            : sw_vec_at(f->clamp_rate, c);
    return sw_sub(sw_cross(sw_madd(away, sw_cross(d, t), spin), t), flowing(f, h, d, t));
  }
  const sw_vec flows = sw_scale(sw_cross(d, t), flow_of(f, h) / h->length);
  const sw_vec rate = sw_sub(sw_add(sw_madd(turn, d, -spin), flows), rotation_of(f, h->edge));
  return sw_madd(rate, t, -sw_dot(rate, t));
}

/* A hold's give makes the hinge longer about one axis, for bending and its damping alike. Returns
 * that axis across the edge, and what the hinge's viscosity loses about it [N m s]. */
static sw_vec softened(double eta, const sw_field *f, const sw_clamp_hinge *h, double *lost) {
  *lost = 0.0;
  if (!(h->softer > 0)) return sw_v(0, 0, 0);
  const sw_vec t = sw_field_tangent(f, h->edge);
  const sw_vec a = sw_vec_at(f->hold_normals, sw_clamp_place(h));
  *lost = eta / h->length - eta / (h->length + h->softer);
  return sw_unit_or(sw_madd(a, t, -sw_dot(a, t)), sw_v(0, 0, 0));
}

sw_vec sw_dashpot_clamp_moment(double eta, const sw_field *f, const sw_clamp_hinge *h) {
  double lost;
  const sw_vec rate = clamp_rate(f, h), axis = softened(eta, f, h, &lost);
  return sw_madd(sw_scale(rate, eta / h->length), axis, -lost * sw_dot(rate, axis));
}

/* own[e] -= k w w' */
static void take_own(sw_field *f, size_t e, double k, sw_vec w) {
  const double d[3] = {w.x, w.y, w.z};
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++) f->own[at][e] -= k * d[i] * d[j];
}

void sw_dashpot_clamp(double eta, sw_field *f, const sw_clamp_hinge *h) {
  const double k = eta / h->length, r = f->reciprocal[h->edge];
  const sw_vec t = sw_field_tangent(f, h->edge);
  if (f->want & (SW_WANT_FORCE | SW_WANT_POWER)) {
    const sw_vec rate = clamp_rate(f, h), m = sw_dashpot_clamp_moment(eta, f, h);
    if (f->want & SW_WANT_POWER) f->power += sw_dot(rate, m);
    if (f->want & SW_WANT_FORCE) sw_field_add_gradient(f, h->edge, sw_scale(sw_cross(t, m), r));
  }
  if (f->want & SW_WANT_STIFFNESS) {
    double lost;
    const sw_vec axis = softened(eta, f, h, &lost);
    const double speed = fmax(0.0, f->velocity_rate - growth_of(f, h)) * r * r;
    add_own(f, h->edge, k * speed);
    if (lost > 0) take_own(f, h->edge, lost * speed, sw_cross(axis, t));
  }
}
