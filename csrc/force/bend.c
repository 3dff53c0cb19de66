/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Isotropic bending of a straight wire. Hinge i turns by the angle phi between the unit tangents
 * t1, t2 of its edges: E = 1/2 (EI/w_i) phi^2, with w_i the hinge length of the plan. Gradient and
 * second derivative are exact. They use s = phi/sin phi and w = -ds/dcos phi, both analytic in u =
 * sin^2(phi/2). Bergou et al. 2008 use 2 tan(phi/2) instead; the angle fits the corrected clamp,
 * see plan.c. Valid below about 1 rad per hinge; at pi the direction is undefined. */
#include <math.h>

#include "base/simd.h"
#include "force/force.h"
#include "state/angle.h"
#include "state/clamp.h"

/* Fills the scratch arrays for hinges 1..n-2: 0 cos phi, 1 k s, 2 k w. Returns the number of hinges
 * beyond the range of the fit (a count, because a loop with a maximum would not vectorise). */
SW_HOT
static long hinge_factors(size_t n, double EI, const double *restrict hinge,
                          const double *restrict tx, const double *restrict ty,
                          const double *restrict tz, double *restrict cosine, double *restrict ks,
                          double *restrict kw) {
  long sharp = 0;
  for (size_t i = 1; i + 1 < n; i++) {
    const double dx = tx[i] - tx[i - 1], dy = ty[i] - ty[i - 1], dz = tz[i] - tz[i - 1];
    const double u = 0.25 * (dx * dx + dy * dy + dz * dz);
    const double k = hinge[i] > 0 ? EI / hinge[i] : 0.0;
    sharp += !(u <= SW_ANGLE_FIT);
    cosine[i] = 1.0 - 2.0 * u;
    ks[i] = k * SW_FIT(u, SW_FIT_S);
    kw[i] = k * SW_FIT(u, SW_FIT_W);
  }
  return sharp;
}

static void sharp_hinges(size_t n, double EI, const double *hinge, const double *cosine, double *ks,
                         double *kw) {
  for (size_t i = 1; i + 1 < n; i++) {
    const double u = 0.5 * (1.0 - cosine[i]);
    if (u <= SW_ANGLE_FIT || !(hinge[i] > 0)) continue;
    double s, w;
    sw_angle_factors(u, &s, &w);
    ks[i] = EI / hinge[i] * s;
    kw[i] = EI / hinge[i] * w;
  }
}

SW_HOT
static void add_gradient(size_t n, const double *restrict c, const double *restrict ks,
                         const double *restrict rl, const double *restrict tx,
                         const double *restrict ty, const double *restrict tz, double *restrict gx,
                         double *restrict gy, double *restrict gz) {
  for (size_t i = 1; i + 1 < n; i++) { /* second edge of each hinge */
    const double f = -ks[i] * rl[i];
    gx[i] += f * (tx[i - 1] - c[i] * tx[i]);
    gy[i] += f * (ty[i - 1] - c[i] * ty[i]);
    gz[i] += f * (tz[i - 1] - c[i] * tz[i]);
  }
  for (size_t i = 1; i + 1 < n; i++) { /* first edge */
    const double f = -ks[i] * rl[i - 1];
    gx[i - 1] += f * (tx[i] - c[i] * tx[i - 1]);
    gy[i - 1] += f * (ty[i] - c[i] * ty[i - 1]);
    gz[i - 1] += f * (tz[i] - c[i] * tz[i - 1]);
  }
}

/* own += [kw p p' + ks (c (I - t t') + t p' + p t')] / l^2 for the edge at shift (0: second edge of
 * the hinge, -1: first) */
SW_HOT
static void add_own(size_t n, long shift, const double *restrict c, const double *restrict ks,
                    const double *restrict kw, const double *restrict rl, const double *restrict tx,
                    const double *restrict ty, const double *restrict tz, double *restrict o0,
                    double *restrict o1, double *restrict o2, double *restrict o3,
                    double *restrict o4, double *restrict o5) {
  for (long i = 1; i + 1 < (long)n; i++) {
    const long e = i + shift, o = i - 1 - shift; /* this edge, the other one */
    const double r2 = rl[e] * rl[e], a = ks[i] * r2, b = kw[i] * r2;
    const double px = tx[o] - c[i] * tx[e], py = ty[o] - c[i] * ty[e], pz = tz[o] - c[i] * tz[e];
    /* t p' + p t' - c t t' = t q' + p t' with q = p - c t */
    const double qx = px - c[i] * tx[e], qy = py - c[i] * ty[e], qz = pz - c[i] * tz[e];
    const double ac = a * c[i];
    o0[e] += b * px * px + a * (tx[e] * qx + px * tx[e]) + ac;
    o1[e] += b * px * py + a * (tx[e] * qy + px * ty[e]);
    o2[e] += b * px * pz + a * (tx[e] * qz + px * tz[e]);
    o3[e] += b * py * py + a * (ty[e] * qy + py * ty[e]) + ac;
    o4[e] += b * py * pz + a * (ty[e] * qz + py * tz[e]);
    o5[e] += b * pz * pz + a * (tz[e] * qz + pz * tz[e]) + ac;
  }
}

/* next += [kw p1 p2' - ks (I - t1 t1')(I - t2 t2')] / (l1 l2) */
SW_HOT
static void add_next(size_t n, const double *restrict c, const double *restrict ks,
                     const double *restrict kw, const double *restrict rl,
                     const double *restrict tx, const double *restrict ty,
                     const double *restrict tz, double *restrict n0, double *restrict n1,
                     double *restrict n2, double *restrict n3, double *restrict n4,
                     double *restrict n5, double *restrict n6, double *restrict n7,
                     double *restrict n8) {
  for (size_t i = 1; i + 1 < n; i++) {
    const double rr = rl[i - 1] * rl[i], a = ks[i] * rr, b = kw[i] * rr, ci = c[i];
    const double ax = tx[i - 1], ay = ty[i - 1], az = tz[i - 1];
    const double bx = tx[i], by = ty[i], bz = tz[i];
    const double px = b * (bx - ci * ax), py = b * (by - ci * ay), pz = b * (bz - ci * az);
    const double qx = ax - ci * bx, qy = ay - ci * by, qz = az - ci * bz;
    /* -(I - t1 t1' - t2 t2' + c t1 t2') = -I + t1 q' + t2 t2' */
    n0[i] += px * qx + a * (ax * qx + bx * bx - 1.0);
    n1[i] += px * qy + a * (ax * qy + bx * by);
    n2[i] += px * qz + a * (ax * qz + bx * bz);
    n3[i] += py * qx + a * (ay * qx + by * bx);
    n4[i] += py * qy + a * (ay * qy + by * by - 1.0);
    n5[i] += py * qz + a * (ay * qz + by * bz);
    n6[i] += pz * qx + a * (az * qx + bz * bx);
    n7[i] += pz * qy + a * (az * qy + bz * by);
    n8[i] += pz * qz + a * (az * qz + bz * bz - 1.0);
  }
}

/* The hinge between a held director d and one edge: the same energy with one tangent fixed. It is
 * symmetric in both directions, so the hinge's side does not matter. */
static void clamp_hinge(const sw_clamp_hinge *h, double EI, sw_field *field) {
  const size_t e = h->edge;
  const double *d0 = field->hold_directors + 3 * sw_clamp_place(h);
  const double t[3] = {field->tangent[0][e], field->tangent[1][e], field->tangent[2][e]};
  double u = 0, s, w, p[3];
  for (int k = 0; k < 3; k++) u += 0.25 * (t[k] - d0[k]) * (t[k] - d0[k]);
  sw_angle_factors(u, &s, &w);
  const double k0 = EI / h->length, c = 1.0 - 2.0 * u, rl = field->reciprocal[e];
  for (int k = 0; k < 3; k++) p[k] = d0[k] - c * t[k];
  if (field->want & SW_WANT_ENERGY) {
    const double phi = s * sqrt(4.0 * u * (1.0 - (u < SW_ANGLE_SHARPEST ? u : SW_ANGLE_SHARPEST)));
    field->energy += 0.5 * k0 * phi * phi;
  }
  if (field->want & SW_WANT_FORCE)
    for (int k = 0; k < 3; k++) field->gradient[k][e] -= k0 * s * p[k] * rl;
  if (!(field->want & SW_WANT_STIFFNESS)) return;
  const double a = k0 * s * rl * rl, b = k0 * w * rl * rl;
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++)
      field->own[at][e] += b * p[i] * p[j] + a * (t[i] * p[j] + p[i] * t[j] - c * t[i] * t[j]) +
                           (i == j ? a * c : 0.0);
}

/* Returns the stiffness that the hinge loses about the axis of its hold's give [N m]. */
static double softening(const sw_clamp_hinge *h, double EI) {
  return h->softer > 0 ? EI / h->length - EI / (h->length + h->softer) : 0.0;
}

/* Adds E = -1/2 k f^2 for that loss, with f the angle about the axis (state/clamp.h). With g =
 * dE/dt, H = d2E/dt2 and P = I - t t', the derivatives with respect to the edge vector are P g / l
 * and (P H P - (g.t) P - P g t' - t g' P) / l^2. */
static void soften_clamp(const sw_clamp_hinge *h, double EI, sw_field *field) {
  const size_t e = h->edge;
  const double k = softening(h, EI), rl = field->reciprocal[e];
  const sw_vec t = sw_field_tangent(field, e);
  const sw_clamp_bend b = sw_clamp_bend_of(h, field->hold_directors, field->hold_normals, t);
  const double f = b.angle, gt = -k * f * sw_dot(b.slope, t);
  const sw_vec slope = sw_madd(b.slope, t, -sw_dot(b.slope, t)), g = sw_scale(slope, -k * f);
  if (field->want & SW_WANT_ENERGY) field->energy -= 0.5 * k * f * f;
  const double G[3] = {g.x, g.y, g.z}, T[3] = {t.x, t.y, t.z};
  for (int i = 0; i < 3 && field->want & SW_WANT_FORCE; i++) field->gradient[i][e] += G[i] * rl;
  if (!(field->want & SW_WANT_STIFFNESS)) return;
  const sw_vec d = sw_madd(b.d, t, -sw_dot(b.d, t)), n = sw_madd(b.n, t, -sw_dot(b.n, t));
  const double S[3] = {slope.x, slope.y, slope.z}, D[3] = {d.x, d.y, d.z}, N[3] = {n.x, n.y, n.z};
  const double q = sw_dot(t, b.n);
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++) {
      const double second = q * b.v * D[i] * D[j] - b.w * (N[i] * D[j] + D[i] * N[j]);
      const double H = -k * (S[i] * S[j] + f * second);
      field->own[at][e] +=
          (H - gt * ((i == j) - T[i] * T[j]) - G[i] * T[j] - T[i] * G[j]) * rl * rl;
    }
}

/* Computes the energy of every hinge from phi = s sin phi. Returns the number beyond the fit's
 * range. */
SW_HOT
static long hinge_energies(size_t n, double EI, const double *restrict hinge,
                           const double *restrict tx, const double *restrict ty,
                           const double *restrict tz, double *restrict each) {
  long sharp = 0;
  for (size_t i = 1; i + 1 < n; i++) {
    const double dx = tx[i] - tx[i - 1], dy = ty[i] - ty[i - 1], dz = tz[i] - tz[i - 1];
    const double u = 0.25 * (dx * dx + dy * dy + dz * dz);
    const double k = hinge[i] > 0 ? EI / hinge[i] : 0.0, s = SW_FIT(u, SW_FIT_S);
    sharp += !(u <= SW_ANGLE_FIT);
    each[i] = 2.0 * k * u * (1.0 - u) * (s * s);
  }
  return sharp;
}

static void sharp_energies(size_t n, double EI, const double *hinge, double *const *t,
                           double *each) {
  for (size_t i = 1; i + 1 < n; i++) {
    double u = 0;
    for (int k = 0; k < 3; k++) u += 0.25 * (t[k][i] - t[k][i - 1]) * (t[k][i] - t[k][i - 1]);
    if (u <= SW_ANGLE_FIT || !(hinge[i] > 0)) continue;
    const double phi = 2.0 * asin(sqrt(fmin(1.0, u)));
    each[i] = 0.5 * EI / hinge[i] * phi * phi;
  }
}

enum { LANES = 8 }; /* parallel sums, for vector instructions [-] */

SW_HOT
static double sum_of(size_t n, const double *x) {
  double lane[LANES] = {0}, sum = 0;
  size_t i = 0;
  for (; i + LANES <= n; i += LANES)
    for (size_t k = 0; k < LANES; k++) lane[k] += x[i + k];
  for (; i < n; i++) sum += x[i];
  for (size_t k = 0; k < LANES; k++) sum += lane[k];
  return sum;
}

static double hinge_energy(const sw_field *f, double EI) {
  const sw_plan *p = f->plan;
  double *const *t = f->tangent, *each = f->scratch[3];
  if (p->nodes < 3) return 0.0;
  if (hinge_energies(p->nodes, EI, p->hinge, t[0], t[1], t[2], each))
    sharp_energies(p->nodes, EI, p->hinge, t, each);
  return sum_of(p->nodes - 2, each + 1);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const double EI = ((const sw_bend_args *)args)->EI;
  const sw_plan *p = f->plan;
  double *c = f->scratch[0], *ks = f->scratch[1], *kw = f->scratch[2];
  double *const *t = f->tangent;
  if (f->want & (SW_WANT_FORCE | SW_WANT_STIFFNESS) &&
      hinge_factors(p->nodes, EI, p->hinge, t[0], t[1], t[2], c, ks, kw))
    sharp_hinges(p->nodes, EI, p->hinge, c, ks, kw);
  if (f->want & SW_WANT_FORCE)
    add_gradient(p->nodes, c, ks, f->reciprocal, t[0], t[1], t[2], f->gradient[0], f->gradient[1],
                 f->gradient[2]);
  if (f->want & SW_WANT_STIFFNESS) {
    for (long shift = -1; shift <= 0; shift++)
      add_own(p->nodes, shift, c, ks, kw, f->reciprocal, t[0], t[1], t[2], f->own[0], f->own[1],
              f->own[2], f->own[3], f->own[4], f->own[5]);
    add_next(p->nodes, c, ks, kw, f->reciprocal, t[0], t[1], t[2], f->next[0], f->next[1],
             f->next[2], f->next[3], f->next[4], f->next[5], f->next[6], f->next[7], f->next[8]);
  }
  if (f->want & SW_WANT_ENERGY) f->energy += hinge_energy(f, EI);
  for (size_t k = 0; k < p->clamp_count; k++) clamp_hinge(&p->clamps[k], EI, f);
  for (size_t k = 0; k < p->clamp_count; k++)
    if (p->clamps[k].softer > 0) soften_clamp(&p->clamps[k], EI, f);
  return SW_OK;
}

/* omega_max <= 4 sqrt(EI/mu) / l^2 for equal edges and lumped masses. A hinge shorter than its edge
 * raises it by the square root of the ratio. */
static double stable_dt(const void *args, const sw_plan *plan) {
  const double EI = ((const sw_bend_args *)args)->EI;
  double smallest = HUGE_VAL;
  for (size_t e = 0; EI > 0 && e < plan->edges; e++) {
    double dt = 0.5 * plan->rest[e] * plan->rest[e] * sqrt(plan->beam.mass / EI);
    for (size_t i = e; i <= e + 1; i++)
      if (plan->hinge[i] > 0) dt *= sqrt(fmin(1.0, plan->hinge[i] / plan->rest[e]));
    if (dt < smallest) smallest = dt;
  }
  return smallest;
}

/* k phi about t x d: turns the edge towards the director. */
static sw_vec clamp_moment(const void *args, const sw_field *field, const sw_clamp_hinge *h) {
  const size_t e = h->edge;
  const sw_vec d = sw_vec_at(field->hold_directors, sw_clamp_place(h));
  const sw_vec t = sw_field_tangent(field, e);
  double s, w;
  sw_angle_factors(0.25 * sw_norm2(sw_sub(t, d)), &s, &w);
  const double EI = ((const sw_bend_args *)args)->EI;
  const sw_vec moment = sw_scale(sw_cross(t, d), EI / h->length * s);
  if (!(h->softer > 0)) return moment;
  const sw_clamp_bend b = sw_clamp_bend_of(h, field->hold_directors, field->hold_normals, t);
  return sw_madd(moment, sw_cross(b.slope, t), -softening(h, EI) * b.angle);
}

const sw_force_class sw_force_bend = {
    .name = "bend",
    .summary = "bending by the angle of each hinge, straight isotropic wire",
    .flags = SW_FORCE_INNER | SW_FORCE_BENDING,
    .params = {"force bend", NULL, 0},
    .eval = eval,
    .stable_dt = stable_dt,
    .clamp_moment = clamp_moment,
};
