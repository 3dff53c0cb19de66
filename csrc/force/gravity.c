/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weight: f_i = m_i g with lumped masses, which is also what consistent masses
 * give for a uniform field. Potential energy -m g.x, zero at the origin. */
#include "base/simd.h"
#include "force/force.h"

SW_HOT
static double height_energy(size_t n, const double *restrict mass, const double *restrict g,
                            const double *restrict x) {
  double sum[3] = {0};
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < 3; k++) sum[k] += mass[i] * x[3 * i + k];
  return -(g[0] * sum[0] + g[1] * sum[1] + g[2] * sum[2]);
}

SW_HOT
static void add_weight(size_t n, const double *restrict mass, const double *restrict g,
                       double *restrict force) {
  const double gx = g[0], gy = g[1], gz = g[2];
  for (size_t i = 0; i < n; i++) {
    force[3 * i] += mass[i] * gx;
    force[3 * i + 1] += mass[i] * gy;
    force[3 * i + 2] += mass[i] * gz;
  }
}

static sw_status eval(const void *args, sw_field *field, sw_error *err) {
  (void)args;
  (void)err;
  const sw_plan *p = field->plan;
  const double *g = field->gravity;
  if (field->want & SW_WANT_FORCE) add_weight(p->nodes, p->lumped, g, field->force);
  if (field->want & SW_WANT_ENERGY)
    field->energy += height_energy(p->nodes, p->lumped, g, field->x);
  return SW_OK;
}

const sw_force_class sw_force_gravity = {
    .name = "gravity",
    .summary = "weight of every node in the scene's gravity",
    .flags = SW_FORCE_INNER | SW_FORCE_ANY_BODY,
    .params = {"force gravity", NULL, 0},
    .eval = eval,
};
