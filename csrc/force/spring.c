/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Springs between the particles of a web: E = 1/2 k (l - l0)^2, force T = k (l - l0) along the
 * spring, stiffness k t t' + (T/l)(I - t t'). As for a rod's edges, the geometric part uses the T
 * that is the solver's own unknown (see system/stage.c). Springs in compression have this part too,
 * because in a bent section tension and compression must cancel; only iterations that do not
 * converge omit it. Hooke's law in the change of length: valid while no spring is squeezed to zero
 * length. */
#include <math.h>

#include "base/each.h"
#include "base/simd.h"
#include "force/force.h"

static inline __attribute__((always_inline)) void add_stiffness(const sw_web_link *link,
                                                                double stored, double reciprocal,
                                                                const double t[3], size_t slot,
                                                                sw_field *f) {
  const double T = f->cautious ? fmax(0.0, stored) : stored;
  const double geometric = T * reciprocal, axial = link->k - geometric;
  const double K[6] = {
      axial * t[0] * t[0] + geometric, axial * t[0] * t[1], axial * t[0] * t[2],
      axial * t[1] * t[1] + geometric, axial * t[1] * t[2], axial * t[2] * t[2] + geometric};
  sw_field_add_pair(f, link->a, link->b, slot, K);
}

/* Returns the elongation of a spring [m]; fills its direction [-] and 1 / length [1/m] (0 if it has
 * none). */
static inline __attribute__((always_inline)) double stretch_of(const sw_web_link *link,
                                                               const double *x, double t[3],
                                                               double *reciprocal) {
  const double *a = x + 3 * (size_t)link->a, *b = x + 3 * (size_t)link->b;
  const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double l = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const double r = l > 0 ? 1.0 / l : 0.0;
  for (int k = 0; k < 3; k++) t[k] = d[k] * r;
  *reciprocal = r;
  return l - link->rest;
}

SW_HOT
static void add_all(const sw_web *web, sw_field *f) {
  const int stiffness = (f->want & SW_WANT_STIFFNESS) != 0;
  for (size_t e = 0; e < web->links; e++) {
    const sw_web_link *link = &web->link[e];
    double t[3], r;
    const double T = link->k * stretch_of(link, f->x, t, &r);
    double *fa = f->force + 3 * (size_t)link->a, *fb = f->force + 3 * (size_t)link->b;
    for (int k = 0; k < 3; k++) fa[k] += T * t[k];
    for (int k = 0; k < 3; k++) fb[k] -= T * t[k];
    if (stiffness && r > 0)
      add_stiffness(link, f->tension ? f->tension[e] : T, r, t, f->link_slot[e], f);
  }
}

static double energy_of(const sw_web *web, const double *x) {
  double energy = 0, t[3], r;
  SW_ITEMS(const sw_web_link, link, web->link, web->links) {
    const double stretch = stretch_of(link, x, t, &r);
    energy += 0.5 * link->k * stretch * stretch;
  }
  return energy;
}

static sw_status eval(const void *args SW_UNUSED, sw_field *f, sw_error *err SW_UNUSED) {
  if (f->want & (SW_WANT_FORCE | SW_WANT_STIFFNESS)) add_all(f->plan->web, f);
  if (f->want & SW_WANT_ENERGY) f->energy += energy_of(f->plan->web, f->x);
  return SW_OK;
}

/* By Gershgorin: omega^2 <= 2 (sum of a particle's springs) / its mass. */
static double stable_dt(const void *args SW_UNUSED, const sw_plan *plan) {
  return plan->web->rate2 > 0 ? 2.0 / sqrt(plan->web->rate2) : HUGE_VAL;
}

const sw_force_class sw_force_spring = {
    .name = "spring",
    .summary = "springs between the particles of a mesh",
    .stores = "stretch",
    .flags = SW_FORCE_INNER | SW_FORCE_ANY_BODY,
    .params = {"force spring", NULL, 0},
    .eval = eval,
    .stable_dt = stable_dt,
};
