/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Springs between the particles of a web: E = 1/2 k (l - l0)^2, force T = k (l - l0) along the
 * spring, stiffness k t t' + (T/l)(I - t t'). As for the edges of a rod, the T of the geometric
 * part is the solver's own unknown (see system/stage.c). Springs under pressure have that part
 * too, for in a bent section those pulled and pushed must cancel; only iterations that would
 * not converge leave it out. Hooke's law in the change of length: valid while springs are not
 * squeezed to a point. */
#include <math.h>

#include "force/force.h"

static void add_stiffness(const sw_web_link *link, double stored, double l, const double t[3],
                          size_t e, sw_field *f) {
  const double T = f->cautious ? fmax(0.0, stored) : stored;
  const double geometric = T / l, axial = link->k - geometric;
  const double K[6] = {
      axial * t[0] * t[0] + geometric, axial * t[0] * t[1], axial * t[0] * t[2],
      axial * t[1] * t[1] + geometric, axial * t[1] * t[2], axial * t[2] * t[2] + geometric};
  sw_field_add_pair(f, link->a, link->b, f->link_slot[e], K);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  const sw_web *web = f->plan->web;
  (void)args, (void)err;
  for (size_t e = 0; e < web->links; e++) {
    const sw_web_link *link = &web->link[e];
    const double *a = f->x + 3 * (size_t)link->a, *b = f->x + 3 * (size_t)link->b;
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double l = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double r = l > 0 ? 1.0 / l : 0.0, t[3] = {d[0] * r, d[1] * r, d[2] * r};
    const double T = link->k * (l - link->rest);
    if (f->want & SW_WANT_FORCE) {
      double *fa = f->force + 3 * (size_t)link->a, *fb = f->force + 3 * (size_t)link->b;
      for (int k = 0; k < 3; k++) fa[k] += T * t[k], fb[k] -= T * t[k];
    }
    if ((f->want & SW_WANT_STIFFNESS) && l > 0)
      add_stiffness(link, f->tension ? f->tension[e] : T, l, t, e, f);
    if (f->want & SW_WANT_ENERGY) f->energy += 0.5 * T * (l - link->rest);
  }
  return SW_OK;
}

/* By Gershgorin: omega^2 <= 2 (sum of a particle's springs) / its mass. */
static double stable_dt(const void *args, const sw_plan *plan) {
  (void)args;
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
