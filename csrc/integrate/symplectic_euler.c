/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symplectic Euler: v first, then x with the new v. Stable while
 * h omega_max < 2; first order, energy error bounded. */
#include "integrate/integrate.h"

static sw_status advance(sw_stepper *p, sw_system *s, double t, double h, double *x, double *v,
                         sw_error *err) {
  SW_TRY(sw_system_acceleration(s, t, x, v, p->a, err));
  sw_stepper_book(p, s, h);
  for (size_t i = 0; i < p->n; i++) {
    v[i] += h * p->a[i];
    x[i] += h * v[i];
  }
  return sw_system_place_holds(s, t + h, x, v, NULL, err);
}

const sw_integrator sw_integrator_symplectic_euler = {
    .name = "symplectic-euler",
    .summary = "explicit, first order, bounded energy error",
    .order = 1,
    .leapfrog_limit = 2.0,
    .advance = advance,
};
