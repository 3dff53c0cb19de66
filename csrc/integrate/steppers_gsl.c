/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GSL's explicit steppers as members: the state (x, v) as one first-order
 * system, one GSL step of fixed size per step. A user error in a force stops
 * GSL with GSL_EBADFUNC and comes back unchanged. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <string.h>

#include "integrate/integrate.h"

/* What GSL's callback needs. */
typedef struct bridge {
  sw_stepper *stepper;
  sw_system *system;
  sw_status status;
  sw_error *err;
} bridge;

static int derivative(double t, const double y[], double dydt[], void *user) {
  bridge *b = user;
  const size_t n = b->stepper->n;
  double *x = b->stepper->extra[4], *v = b->stepper->extra[5];
  memcpy(x, y, n * sizeof *x);
  memcpy(v, y + n, n * sizeof *v);
  b->status = sw_system_place_holds(b->system, t, x, v, NULL, b->err);
  if (b->status == SW_OK) b->status = sw_system_acceleration(b->system, t, x, v, dydt + n, b->err);
  memcpy(dydt, v, n * sizeof *v);
  return b->status == SW_OK ? GSL_SUCCESS : GSL_EBADFUNC;
}

static void free_step(void *step) { gsl_odeiv2_step_free(step); }

static sw_status advance(sw_stepper *p, sw_system *s, double t, double h, double *x, double *v,
                         sw_error *err, const gsl_odeiv2_step_type *type) {
  if (!p->outside) {
    p->outside = gsl_odeiv2_step_alloc(type, 2 * p->n);
    p->free_outside = free_step;
    if (!p->outside) return SW_ENOMEM;
  }
  double *y = p->extra[0], *error = p->extra[2]; /* each 2 n: two work arrays in a row */
  bridge b = {p, s, SW_OK, err};
  const gsl_odeiv2_system system = {derivative, NULL, 2 * p->n, &b};
  memcpy(y, x, p->n * sizeof *y);
  memcpy(y + p->n, v, p->n * sizeof *y);
  const int code = gsl_odeiv2_step_apply(p->outside, t, h, y, error, NULL, NULL, &system);
  if (b.status != SW_OK) return b.status;
  if (code == GSL_ENOMEM) return SW_ENOMEM;
  if (code != GSL_SUCCESS) return sw_fail(err, SW_EDIVERGED, "GSL: %s", gsl_strerror(code));
  memcpy(x, y, p->n * sizeof *x);
  memcpy(v, y + p->n, p->n * sizeof *v);
  return sw_system_place_holds(s, t + h, x, v, NULL, err);
}

#define MEMBER(id, label, type, p_order, limit)                                             \
  static sw_status advance_##id(sw_stepper *p, sw_system *s, double t, double h, double *x, \
                                double *v, sw_error *err) {                                 \
    return advance(p, s, t, h, x, v, err, type);                                            \
  }                                                                                         \
  const sw_integrator sw_integrator_gsl_##id = {                                            \
      .name = "gsl-" label,                                                                 \
      .summary = "GSL's " label " with fixed steps",                                        \
      .order = (p_order),                                                                   \
      .leapfrog_limit = (limit),                                                            \
      .advance = advance_##id,                                                              \
  };

/* Limits by their stability polynomials on the imaginary axis. GSL's rk2 is a method of third
 * order, its rk4 takes two half steps. The last three let an undamped swing grow a little at every
 * step: their limits allow a hundredfold in 20000 steps. */
MEMBER(rk2, "rk2", gsl_odeiv2_step_rk2, 3, 1.7320508075688772)
MEMBER(rk4, "rk4", gsl_odeiv2_step_rk4, 4, 5.6568542494923804)
MEMBER(rkf45, "rkf45", gsl_odeiv2_step_rkf45, 5, 0.827)
MEMBER(rkck, "rkck", gsl_odeiv2_step_rkck, 5, 1.003)
MEMBER(rk8pd, "rk8pd", gsl_odeiv2_step_rk8pd, 8, 3.723)
