/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Classical Runge-Kutta of fourth order; stable while h omega_max < 2.828. */
#include <string.h>

#include "integrate/integrate.h"

static sw_status advance(sw_stepper *p, sw_system *s, double t, double h, double *x, double *v,
                         sw_error *err) {
  static const double share[4] = {0.0, 0.5, 0.5, 1.0};
  static const double weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  double *xs = p->extra[0], *vs = p->extra[1], *dx = p->extra[2], *dv = p->extra[3];
  memset(dx, 0, p->n * sizeof *dx);
  memset(dv, 0, p->n * sizeof *dv);
  memcpy(xs, x, p->n * sizeof *xs);
  memcpy(vs, v, p->n * sizeof *vs);
  for (int k = 0; k < 4; k++) {
    const double ts = t + share[k] * h;
    if (k > 0) {
      for (size_t i = 0; i < p->n; i++) {
        const double v_before = vs[i];
        xs[i] = x[i] + share[k] * h * v_before;
        vs[i] = v[i] + share[k] * h * p->a[i];
      }
      SW_TRY(sw_system_place_holds(s, ts, xs, vs, NULL, err));
    }
    SW_TRY(sw_system_acceleration(s, ts, xs, vs, p->a, err));
    sw_stepper_book(p, s, weight[k] * h);
    for (size_t i = 0; i < p->n; i++) {
      dx[i] += weight[k] * vs[i];
      dv[i] += weight[k] * p->a[i];
    }
  }
  for (size_t i = 0; i < p->n; i++) {
    x[i] += h * dx[i];
    v[i] += h * dv[i];
  }
  return sw_system_place_holds(s, t + h, x, v, NULL, err);
}

const sw_integrator sw_integrator_rk4 = {
    .name = "rk4",
    .summary = "explicit Runge-Kutta, fourth order",
    .order = 4,
    .leapfrog_limit = 2.8284271247461903,
    .advance = advance,
};
