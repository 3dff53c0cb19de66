/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weight: f_i = m_i g with lumped masses, which is also what consistent masses
 * give for a uniform field. Potential energy -m g.x, zero at the origin. */
#include "force/force.h"

static sw_status eval(const void *args, sw_field *field, sw_error *err) {
  (void)args;
  (void)err;
  const sw_plan *p = field->plan;
  const double *g = field->gravity;
  if (field->want & SW_WANT_FORCE)
    for (size_t i = 0; i < p->nodes; i++)
      for (int k = 0; k < 3; k++) field->force[3 * i + (size_t)k] += p->lumped[i] * g[k];
  if (field->want & SW_WANT_ENERGY)
    for (size_t i = 0; i < p->nodes; i++)
      for (int k = 0; k < 3; k++)
        field->energy -= p->lumped[i] * g[k] * field->x[3 * i + (size_t)k];
  return SW_OK;
}

const sw_force_class sw_force_gravity = {
    .name = "gravity",
    .summary = "weight of every node in the scene's gravity",
    .flags = SW_FORCE_INNER | SW_FORCE_ANY_BODY,
    .params = {"force gravity", NULL, 0},
    .eval = eval,
};
