/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bending of the string model: a linear spring on the second difference, E = 1/2 (EI/w_i) |e2/l2 -
 * e1/l1|^2 with unstressed lengths l. Its second derivatives are constant, so it is the cheapest
 * bending force. The energy has 4 sin^2(phi/2) instead of phi^2: 1 % too soft at 20 degrees per
 * hinge. */
#include <math.h>

#include "base/simd.h"
#include "force/force.h"

SW_HOT
static void add_gradient(const sw_plan *p, double EI, const double *restrict x,
                         double *restrict g) {
  for (size_t i = 1; i + 1 < p->nodes; i++) {
    const double k = p->hinge[i] > 0 ? EI / p->hinge[i] : 0.0;
    const double r1 = 1.0 / p->rest[i - 1], r2 = 1.0 / p->rest[i];
    const double d = (x[3 * i + 3] - x[3 * i]) * r2 - (x[3 * i] - x[3 * i - 3]) * r1;
    g[i - 1] -= k * r1 * d;
    g[i] += k * r2 * d;
  }
}

static void add_stiffness(const sw_plan *p, double EI, sw_field *f) {
  for (size_t i = 1; i + 1 < p->nodes; i++) {
    const double k = p->hinge[i] > 0 ? EI / p->hinge[i] : 0.0;
    const double r1 = 1.0 / p->rest[i - 1], r2 = 1.0 / p->rest[i];
    for (int c = 0; c < 6; c += (c == 0 ? 3 : 2)) { /* xx, yy, zz */
      f->own[c][i - 1] += k * r1 * r1;
      f->own[c][i] += k * r2 * r2;
    }
    for (int c = 0; c < 9; c += 4) f->next[c][i] -= k * r1 * r2;
  }
}

static double energy(const sw_plan *p, double EI, const double *x) {
  double sum = 0;
  for (size_t i = 1; i + 1 < p->nodes; i++) {
    if (!(p->hinge[i] > 0)) continue;
    double d2 = 0;
    for (size_t k = 0; k < 3; k++) {
      const double d = (x[3 * i + 3 + k] - x[3 * i + k]) / p->rest[i] -
                       (x[3 * i + k] - x[3 * i - 3 + k]) / p->rest[i - 1];
      d2 += d * d;
    }
    sum += 0.5 * EI / p->hinge[i] * d2;
  }
  return sum;
}

static void clamp_hinge(const sw_clamp_hinge *h, double EI, sw_field *f) {
  const size_t e = h->edge;
  const double *d0 = f->hold_directors + 3 * sw_clamp_place(h);
  const double k0 = EI / h->length, r = 1.0 / f->plan->rest[e];
  static const int diagonal[3] = {0, 3, 5};
  for (size_t k = 0; k < 3; k++) {
    const double d = (f->x[3 * e + 3 + k] - f->x[3 * e + k]) * r - d0[k];
    if (f->want & SW_WANT_ENERGY) f->energy += 0.5 * k0 * d * d;
    if (f->want & SW_WANT_FORCE) f->gradient[k][e] += k0 * d * r;
    if (f->want & SW_WANT_STIFFNESS) f->own[diagonal[k]][e] += k0 * r * r;
  }
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const double EI = ((const sw_bend_args *)args)->EI;
  if (!(EI > 0)) return SW_OK;
  if (f->want & SW_WANT_FORCE)
    for (int k = 0; k < 3; k++) add_gradient(f->plan, EI, f->x + k, f->gradient[k]);
  if (f->want & SW_WANT_STIFFNESS) add_stiffness(f->plan, EI, f);
  if (f->want & SW_WANT_ENERGY) f->energy += energy(f->plan, EI, f->x);
  for (size_t k = 0; k < f->plan->clamp_count; k++) clamp_hinge(&f->plan->clamps[k], EI, f);
  return SW_OK;
}

/* Returns e/l of an edge with its unstressed length. */
static sw_vec stretched(const sw_field *f, size_t e) {
  const sw_vec d = sw_sub(sw_vec_at(f->x, e + 1), sw_vec_at(f->x, e));
  return sw_scale(d, 1.0 / f->plan->rest[e]);
}

/* The second difference pulls along the edges too: by EI curvature^2 in a bend, and against a
 * tension that changes from edge to edge, most of all next to a clamp. The edges' springs carry
 * that much less. */
static void axial(const void *args, const sw_field *f, double *sum) {
  const double EI = ((const sw_bend_args *)args)->EI;
  const sw_plan *p = f->plan;
  for (size_t i = 1; EI > 0 && i + 1 < p->nodes; i++) {
    if (!(p->hinge[i] > 0)) continue;
    const sw_vec a = stretched(f, i - 1), b = stretched(f, i), d = sw_sub(b, a);
    sum[i - 1] -= EI / p->hinge[i] * sw_dot(d, sw_field_tangent(f, i - 1)) / p->rest[i - 1];
    sum[i] += EI / p->hinge[i] * sw_dot(d, sw_field_tangent(f, i)) / p->rest[i];
  }
  for (size_t c = 0; EI > 0 && c < p->clamp_count; c++) {
    const sw_clamp_hinge *h = &p->clamps[c];
    const sw_vec d = sw_sub(stretched(f, h->edge), sw_vec_at(f->hold_directors, sw_clamp_place(h)));
    sum[h->edge] += EI / h->length * sw_dot(d, sw_field_tangent(f, h->edge)) / p->rest[h->edge];
  }
}

/* The second difference stiffens axial waves too, so the limit covers both: omega^2 <= 16 EI/(mu
 * l^4) + 4 EA/(mu l^2). */
static double stable_dt(const void *args, const sw_plan *plan) {
  const double EI = ((const sw_bend_args *)args)->EI, mu = plan->beam.mass;
  double smallest = HUGE_VAL;
  for (size_t e = 0; EI > 0 && e < plan->edges; e++) {
    const double l2 = plan->rest[e] * plan->rest[e];
    const double omega2 = 16.0 * EI / (mu * l2 * l2) + 4.0 * plan->beam.EA / (mu * l2);
    smallest = fmin(smallest, 2.0 / sqrt(omega2));
  }
  return smallest;
}

/* Returns e/l x k d: the couple of the linear spring between director and edge. */
static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *h) {
  const size_t e = h->edge;
  const sw_vec d = sw_vec_at(f->hold_directors, sw_clamp_place(h));
  const sw_vec edge = sw_sub(sw_load(f->x + 3 * e + 3), sw_load(f->x + 3 * e));
  const double k = ((const sw_bend_args *)args)->EI / h->length / f->plan->rest[e];
  return sw_scale(sw_cross(edge, d), k);
}

const sw_force_class sw_force_flex = {
    .name = "flex",
    .summary = "bending of the string model by second differences",
    .flags = SW_FORCE_INNER | SW_FORCE_BENDING,
    .params = {"force flex", NULL, 0},
    .eval = eval,
    .stable_dt = stable_dt,
    .axial = axial,
    .clamp_moment = clamp_moment,
};
