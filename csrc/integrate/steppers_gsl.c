/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GSL's explicit steppers as members. The state (x, v) is one first-order system; each step is one
 * GSL step of fixed size. A user error in a force stops GSL with GSL_EBADFUNC and is returned
 * unchanged. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <string.h>

#include "base/alloc.h"
#include "integrate/integrate.h"

enum { MOST_CALLS = 32 }; /* of the right-hand side in a step [-] */

/* GSL's stepper, and the weight of each call of the right-hand side in a step [-]. */
typedef struct outside {
  gsl_odeiv2_step *step;
  double weight[MOST_CALLS];
} outside;

/* Data for GSL's callback. */
typedef struct bridge {
  sw_stepper *stepper;
  sw_system *system;
  sw_status status;
  sw_error *err;
  double h;
  size_t calls;
} bridge;

/* Right-hand side for weigh: value number k grows at a rate of 1 in call k only. */
static int pulses(double t SW_UNUSED, const double y[] SW_UNUSED, double dydt[], void *user) {
  size_t *calls = user;
  memset(dydt, 0, MOST_CALLS * sizeof *dydt);
  if (*calls < MOST_CALLS) dydt[*calls] = 1.0;
  ++*calls;
  return GSL_SUCCESS;
}

/* Finds the weights of the calls: the methods are Runge-Kutta methods, so a step is a weighted sum
 * of the calls. Returns 0 without memory. */
static int weigh(outside *o, const gsl_odeiv2_step_type *type) {
  double error[MOST_CALLS];
  size_t calls = 0;
  const gsl_odeiv2_system system = {pulses, NULL, MOST_CALLS, &calls};
  gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(type, MOST_CALLS);
  if (!step) return 0;
  memset(o->weight, 0, sizeof o->weight);
  gsl_odeiv2_step_apply(step, 0.0, 1.0, o->weight, error, NULL, NULL, &system);
  gsl_odeiv2_step_free(step);
  return 1;
}

static void free_outside(void *user) {
  outside *o = user;
  if (o->step) gsl_odeiv2_step_free(o->step);
  sw_free(o);
}

static sw_status new_outside(sw_stepper *p, const gsl_odeiv2_step_type *type) {
  outside *o = sw_alloc(1, sizeof *o);
  if (!o) return SW_ENOMEM;
  p->outside = o;
  p->free_outside = free_outside;
  o->step = gsl_odeiv2_step_alloc(type, 2 * p->n);
  return o->step && weigh(o, type) ? SW_OK : SW_ENOMEM;
}

static int derivative(double t, const double y[], double dydt[], void *user) {
  bridge *b = user;
  const size_t n = b->stepper->n;
  double *x = b->stepper->extra[4], *v = b->stepper->extra[5];
  memcpy(x, y, n * sizeof *x);
  memcpy(v, y + n, n * sizeof *v);
  b->status = sw_system_place_holds(b->system, t, x, v, NULL, b->err);
  if (b->status == SW_OK) b->status = sw_system_acceleration(b->system, t, x, v, dydt + n, b->err);
  const outside *o = b->stepper->outside;
  const double weight = b->calls < MOST_CALLS ? o->weight[b->calls] : 0.0;
  b->calls++;
  if (b->status == SW_OK) sw_stepper_book(b->stepper, b->system, weight * b->h);
  memcpy(dydt, v, n * sizeof *v);
  return b->status == SW_OK ? GSL_SUCCESS : GSL_EBADFUNC;
}

static sw_status advance(sw_stepper *p, sw_system *s, double t, double h, double *x, double *v,
                         sw_error *err, const gsl_odeiv2_step_type *type) {
  if (!p->outside && new_outside(p, type) != SW_OK) {
    if (p->outside) free_outside(p->outside);
    p->outside = NULL;
    return SW_ENOMEM;
  }
  outside *o = p->outside;
  double *y = p->extra[0], *error = p->extra[2]; /* each 2 n: two work arrays */
  bridge b = {p, s, SW_OK, err, h, 0};
  const gsl_odeiv2_system system = {derivative, NULL, 2 * p->n, &b};
  memcpy(y, x, p->n * sizeof *y);
  memcpy(y + p->n, v, p->n * sizeof *y);
  const int code = gsl_odeiv2_step_apply(o->step, t, h, y, error, NULL, NULL, &system);
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

/* Limits from the stability polynomials on the imaginary axis. GSL's rk2 is a method of third
 * order; its rk4 takes two half steps. The last three let an undamped oscillation grow a little at
 * every step: at their limits it grows a hundredfold in 20000 steps. */
MEMBER(rk2, "rk2", gsl_odeiv2_step_rk2, 3, 1.7320508075688772)
MEMBER(rk4, "rk4", gsl_odeiv2_step_rk4, 4, 5.6568542494923804)
MEMBER(rkf45, "rkf45", gsl_odeiv2_step_rkf45, 5, 0.827)
MEMBER(rkck, "rkck", gsl_odeiv2_step_rkck, 5, 1.003)
MEMBER(rk8pd, "rk8pd", gsl_odeiv2_step_rk8pd, 8, 3.723)
