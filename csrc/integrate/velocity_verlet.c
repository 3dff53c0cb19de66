/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Velocity Verlet (leapfrog): half kick, drift, half kick. Second order,
 * symplectic, stable while h omega_max < 2. */
#include "integrate/integrate.h"

static sw_status advance(sw_stepper *p, sw_system *s, double t, double h, double *x, double *v,
                         sw_error *err) {
  SW_TRY(sw_system_acceleration(s, t, x, v, p->a, err));
  sw_stepper_book(p, s, 0.5 * h);
  for (size_t i = 0; i < p->n; i++) {
    v[i] += 0.5 * h * p->a[i];
    x[i] += h * v[i];
  }
  SW_TRY(sw_system_place_holds(s, t + h, x, NULL, NULL, err));
  SW_TRY(sw_system_acceleration(s, t + h, x, v, p->a, err));
  sw_stepper_book(p, s, 0.5 * h);
  for (size_t i = 0; i < p->n; i++) v[i] += 0.5 * h * p->a[i];
  return sw_system_place_holds(s, t + h, NULL, v, NULL, err);
}

const sw_integrator sw_integrator_velocity_verlet = {
    .name = "velocity-verlet",
    .summary = "explicit leapfrog, second order, bounded energy error",
    .order = 2,
    .leapfrog_limit = 2.0,
    .advance = advance,
};
