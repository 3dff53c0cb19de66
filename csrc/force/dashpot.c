/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "force/dashpot.h"

static sw_vec tangent_of(const sw_field *f, size_t e) {
  return sw_v(f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]);
}

/* Rotation of an edge without its spin: t x v / l [rad/s]. */
static sw_vec rotation_of(const sw_field *f, size_t e) {
  const sw_vec v = sw_sub(sw_load(f->v + 3 * e + 3), sw_load(f->v + 3 * e));
  return sw_scale(sw_cross(tangent_of(f, e), v), f->reciprocal[e]);
}

static void add_gradient(sw_field *f, size_t e, sw_vec g) {
  f->gradient[0][e] += g.x;
  f->gradient[1][e] += g.y;
  f->gradient[2][e] += g.z;
}

/* own[e] += k (I - t t') */
static void add_own(sw_field *f, size_t e, double k) {
  const double t[3] = {f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]};
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++) f->own[at][e] += k * ((i == j ? 1.0 : 0.0) - t[i] * t[j]);
}

static void node_hinge(double k, sw_field *f, size_t i) {
  const sw_vec t1 = tangent_of(f, i - 1), t2 = tangent_of(f, i);
  const double r1 = f->reciprocal[i - 1], r2 = f->reciprocal[i];
  if (f->want & (SW_WANT_FORCE | SW_WANT_POWER)) {
    const sw_vec rate = sw_sub(rotation_of(f, i), rotation_of(f, i - 1)), m = sw_scale(rate, k);
    if (f->want & SW_WANT_POWER) f->power += k * sw_norm2(rate);
    if (f->want & SW_WANT_FORCE) {
      add_gradient(f, i - 1, sw_scale(sw_cross(t1, m), r1));
      add_gradient(f, i, sw_scale(sw_cross(m, t2), r2));
    }
  }
  if (!(f->want & SW_WANT_STIFFNESS)) return;
  const double kr = k * f->velocity_rate, c = sw_dot(t1, t2);
  add_own(f, i - 1, kr * r1 * r1);
  add_own(f, i, kr * r2 * r2);
  const double a[3] = {t1.x, t1.y, t1.z}, b[3] = {t2.x, t2.y, t2.z};
  for (int row = 0; row < 3; row++)
    for (int column = 0; column < 3; column++)
      f->next[3 * row + column][i] -=
          kr * r1 * r2 * ((row == column ? c : 0.0) - b[row] * a[column]);
}

void sw_dashpot_hinges(double eta, sw_field *f) {
  const sw_plan *p = f->plan;
  for (size_t i = 1; i + 1 < p->nodes; i++)
    if (p->hinge[i] > 0) node_hinge(eta / p->hinge[i], f, i);
}

/* How fast the edge falls behind the hold, about axes across the edge [rad/s]. */
static sw_vec clamp_rate(const sw_field *f, const sw_clamp_hinge *h) {
  const size_t at = 3 * (2 * (size_t)h->hold + (h->side > 0 ? 1 : 0));
  const sw_vec held = sw_cross(sw_load(f->hold_directors + at), sw_load(f->hold_turns + at));
  const sw_vec rate = sw_sub(held, rotation_of(f, h->edge)), t = tangent_of(f, h->edge);
  return sw_madd(rate, t, -sw_dot(rate, t));
}

sw_vec sw_dashpot_clamp_moment(double eta, const sw_field *f, const sw_clamp_hinge *h) {
  return sw_scale(clamp_rate(f, h), eta / h->length);
}

void sw_dashpot_clamp(double eta, sw_field *f, const sw_clamp_hinge *h) {
  const double k = eta / h->length, r = f->reciprocal[h->edge];
  if (f->want & SW_WANT_POWER) f->power += k * sw_norm2(clamp_rate(f, h));
  if (f->want & SW_WANT_FORCE) {
    const sw_vec m = sw_scale(clamp_rate(f, h), k);
    add_gradient(f, h->edge, sw_scale(sw_cross(tangent_of(f, h->edge), m), r));
  }
  if (f->want & SW_WANT_STIFFNESS) add_own(f, h->edge, k * f->velocity_rate * r * r);
}
