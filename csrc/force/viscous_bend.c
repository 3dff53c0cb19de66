/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Viscous bending: the moment eta d(kappa)/dt of a Kelvin-Voigt wire, clamps'
 * hinges included. The rate of a hinge of length w is rho / w with rho the
 * rotation of its second edge less that of its first, both without spin about
 * themselves: rho = t2 x t2' - t1 x t1'. In a plane that is the rate of the
 * angle whatever the wire's rotation; where a bent wire is spun about its own
 * axis, it counts as bending. A mode of angular frequency omega has the damping
 * ratio eta omega / (2 EI). */
#include <math.h>
#include <stddef.h>

#include "force/force.h"

typedef struct viscous_args {
  double eta; /* [N m2 s] */
} viscous_args;

static const sw_param rows[] = {
    {"eta", SW_PARAM_NUMBER, "N m2 s", 0, 0, HUGE_VAL, SW_PARAM_REQUIRED, NULL,
     offsetof(viscous_args, eta), "bending moment per rate of curvature"},
};

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
  if (f->want & SW_WANT_FORCE) {
    const sw_vec m = sw_scale(sw_sub(rotation_of(f, i), rotation_of(f, i - 1)), k);
    add_gradient(f, i - 1, sw_scale(sw_cross(t1, m), r1));
    add_gradient(f, i, sw_scale(sw_cross(m, t2), r2));
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

/* Moment of the hinge on its edge against what the edge turns past the hold. */
static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *h) {
  const double k = ((const viscous_args *)args)->eta / h->length;
  const size_t at = 3 * (2 * (size_t)h->hold + (h->side > 0 ? 1 : 0));
  const sw_vec held = sw_cross(sw_load(f->hold_directors + at), sw_load(f->hold_turns + at));
  const sw_vec m = sw_scale(sw_sub(held, rotation_of(f, h->edge)), k);
  const sw_vec t = tangent_of(f, h->edge);
  return sw_madd(m, t, -sw_dot(m, t));
}

static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  const double eta = ((const viscous_args *)args)->eta;
  const sw_plan *p = f->plan;
  (void)err;
  for (size_t i = 1; i + 1 < p->nodes; i++)
    if (p->hinge[i] > 0) node_hinge(eta / p->hinge[i], f, i);
  for (size_t c = 0; c < p->clamp_count; c++) {
    const sw_clamp_hinge *h = &p->clamps[c];
    const double r = f->reciprocal[h->edge];
    if (f->want & SW_WANT_FORCE) {
      const sw_vec m = clamp_moment(args, f, h);
      add_gradient(f, h->edge, sw_scale(sw_cross(tangent_of(f, h->edge), m), r));
    }
    if (f->want & SW_WANT_STIFFNESS)
      add_own(f, h->edge, eta / h->length * f->velocity_rate * r * r);
  }
  return SW_OK;
}

const sw_force_class sw_force_viscous_bend = {
    .name = "viscous_bend",
    .summary = "bending moment in proportion to the rate of curvature",
    .flags = SW_FORCE_DISSIPATIVE,
    .params = SW_PARAMS("force viscous_bend", rows),
    .eval = eval,
    .clamp_moment = clamp_moment,
};
