/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Resistance of still air or liquid: f = -(c1 + c2 |v|) v per length of wire, the same along and
 * across (Morison's drag term with one coefficient). */
#include <math.h>
#include <stddef.h>

#include "force/force.h"

typedef struct drag_args {
  double linear;    /* [N s/m2] */
  double quadratic; /* [N s2/m3] */
} drag_args;

static const sw_param rows[] = {
    {"linear", SW_PARAM_NUMBER, "N s/m2", 0, 0, HUGE_VAL, SW_PARAM_CHANGES, NULL,
     offsetof(drag_args, linear), "drag per length and speed"},
    {"quadratic", SW_PARAM_NUMBER, "N s2/m3", 0, 0, HUGE_VAL, SW_PARAM_CHANGES, NULL,
     offsetof(drag_args, quadratic),
     "drag per length and speed squared; 1/2 rho Cd d for a cylinder across the flow"},
};

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const drag_args *a = args;
  const sw_plan *p = f->plan;
  for (size_t i = 0; i < p->nodes; i++) {
    const sw_vec v = sw_load(f->v + 3 * i);
    const double length = p->lumped[i] / p->beam.mass;
    const double c = length * (a->linear + a->quadratic * sw_norm(v));
    if (f->want & SW_WANT_FORCE) sw_accumulate(f->force + 3 * i, sw_scale(v, -c));
    if (f->want & SW_WANT_STIFFNESS) { /* c I + c2 l v v'/|v| */
      const double speed = sw_norm(v), rate = f->velocity_rate;
      const double along = speed > 0 ? length * a->quadratic / speed * rate : 0.0;
      const double u[3] = {v.x, v.y, v.z};
      double *row = f->rows + 24 * i;
      for (int k = 0, at = 0; k < 3; k++)
        for (int j = k; j < 3; j++, at++)
          row[at] += along * u[k] * u[j] + (k == j ? c * rate : 0.0);
    }
  }
  return SW_OK;
}

const sw_force_class sw_force_drag = {
    .name = "drag",
    .summary = "resistance of still air or liquid",
    .flags = SW_FORCE_DISSIPATIVE | SW_FORCE_ANY_BODY,
    .params = SW_PARAMS("force drag", rows),
    .eval = eval,
};
