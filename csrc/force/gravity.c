/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weight: f_i = m_i g with lumped masses; consistent masses give the same in a uniform field.
 * Potential energy -m g.x, zero at the origin. */
#include "base/simd.h"
#include "base/spread.h"
#include "force/force.h"

SW_HOT
static double height_energy(size_t n, const double *mass, const double *g, const double *x) {
  const double turning[12] = {g[0], g[1], g[2], g[0], g[1], g[2],
                              g[0], g[1], g[2], g[0], g[1], g[2]};
  const sw_spread down = sw_spread_load(turning);
  sw_quad all = {0};
  double sum = 0;
  size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    const sw_spread m = sw_spread_of(mass + i), at = sw_spread_load(x + 3 * i);
    all += m.part[0] * at.part[0] * down.part[0] + m.part[1] * at.part[1] * down.part[1] +
           m.part[2] * at.part[2] * down.part[2];
  }
  for (; i < n; i++) sum += mass[i] * (g[0] * x[3 * i] + g[1] * x[3 * i + 1] + g[2] * x[3 * i + 2]);
  return -(sum + ((all[0] + all[1]) + (all[2] + all[3])));
}

SW_HOT
static void add_weight(size_t n, const double *mass, const double *g, double *force) {
  const double turning[12] = {g[0], g[1], g[2], g[0], g[1], g[2],
                              g[0], g[1], g[2], g[0], g[1], g[2]};
  const sw_spread down = sw_spread_load(turning);
  size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    const sw_spread m = sw_spread_of(mass + i);
    sw_spread f = sw_spread_load(force + 3 * i);
    for (int k = 0; k < 3; k++) f.part[k] += m.part[k] * down.part[k];
    memcpy(force + 3 * i, &f, sizeof f);
  }
  for (; i < n; i++)
    for (size_t k = 0; k < 3; k++) force[3 * i + k] += mass[i] * g[k];
}

static sw_status eval(const void *args SW_UNUSED, sw_field *field, sw_error *err SW_UNUSED) {
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
