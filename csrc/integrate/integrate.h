/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time integrators. A member is one file that ends in one sw_integrator, and one X(name) line in
 * list.def. Implicit members are rows of stages solved by sw_system_stage; explicit ones use lumped
 * masses and accelerations. An integrator knows a system, never a force or a wire. */
#ifndef SW_INTEGRATE_INTEGRATE_H
#define SW_INTEGRATE_INTEGRATE_H

#include <stddef.h>

#include "base/status.h"
#include "system/axial.h"
#include "system/system.h"

enum {
  SW_INTEGRATOR_IMPLICIT = 1,
  SW_INTEGRATOR_HISTORY = 2,    /* uses the state before last: equal steps only */
  SW_INTEGRATOR_EMBEDDED = 4,   /* gives an error estimate */
  SW_INTEGRATOR_NO_CONTACT = 8, /* gains energy in contact */
  SW_INTEGRATOR_ONWARDS = 16    /* the only stage lies within the step: see reach */
};

enum { SW_STAGES_MAX = 2 };

/* One stage of an implicit method: weights of the step h and of the states at the step's start (n),
 * after the first stage (1) and before the last step (p):
 *   xhat = xn x_n + x1 x_1 + xp x_p + xv hbar v_n + xa hbar^2 a_n,
 *   vhat = xn v_n + x1 v_1 + xp v_p + (xv + va) hbar a_n.
 * The velocity is (y - xhat)/hbar. inertia above 0 is a factor of the mass: the acceleration is
 * inertia (velocity - vhat)/hbar. */
typedef struct sw_stage_row {
  double time; /* share of the step, 0..1 */
  double hbar; /* share of the step */
  double xn, x1, xp, xv;
  double inertia, xa, va;
} sw_stage_row;

typedef struct sw_stepper sw_stepper;

typedef struct sw_integrator {
  const char *name;
  const char *summary;
  int order;
  unsigned flags;
  size_t stages; /* implicit members */
  sw_stage_row rows[SW_STAGES_MAX];
  /* for embedded methods and the method that starts them: h times the sum of the velocities at the
   * start and after each stage, with these weights, is the step's error, one order higher than the
   * method [-] */
  double error[SW_STAGES_MAX + 1];
  /* onwards: the step ends at x_n + reach (y - x_n), and the same for velocities. If keeps > 0, its
   * acceleration is a_n + keeps (a - a_n), with which the next step begins [-] */
  double reach, keeps;
  /* implicit: largest amplification of an infinitely stiff mode in one step [-] */
  double at_infinity;
  const char *start;     /* implicit: method for the first step after a
                            discontinuity; NULL = itself */
  double leapfrog_limit; /* explicit: stable while h omega_max is below; implicit: 0 [-] */
  /* explicit: advances (x, v) by h in place from time t. The stepper's work arrays may be used. */
  sw_status (*advance)(sw_stepper *stepper, sw_system *system, double t, double h, double *x,
                       double *v, sw_error *err);
} sw_integrator;

const sw_integrator *sw_integrator_find(const char *name);
const sw_integrator *const *sw_integrator_all(void); /* NULL-terminated */

struct sw_stepper {
  const sw_integrator *method, *start;
  size_t n;     /* the system's freedoms */
  double *work; /* one block for all of the following (n each) */
  double *xhat, *vhat;
  double *y[SW_STAGES_MAX], *w[SW_STAGES_MAX]; /* stage positions and velocities */
  double *a;                                   /* acceleration of the last stage */
  double *xp, *vp;                             /* state before last */
  /* strains (as many as the system's): base of the stage's rates; of the stages; rates of the last
   * stage; of the state before last. NULL without dashpots [-], [1/s] */
  double *strain_past, *strain[SW_STAGES_MAX], *strain_rate, *strain_before;
  double *tension; /* saved for a rejected step (edges) */
  /* axial forces integrated over time from the step's start to each stage (sw_system_pulls); their
   * mean over the last step, or NULL if only the forces at its end are known [N s], [N] */
  double *pulled[SW_STAGES_MAX], *mean;
  double *first;                /* axial forces of the first of two stages (edges) [N] */
  sw_between between;           /* the trial's mix of both stages for read-outs */
  double turning[SW_TURN_SIZE]; /* memory of the method about turning wires */
  double last_h;                /* of the last accepted step; 0 = none [s] */
  const sw_integrator *used;    /* method of the last trial, if implicit */
  double trial_h;               /* of the last trial [s] */
  int restart; /* not 0: the next step starts anew: a_n is stale; bit SW_HALTED: wires have halted
                */
  int plastic; /* the next trials use implicit Euler, so that impacts do not bounce */
  int booked;  /* 1: an evaluation of the explicit step was booked */
  double **extra; /* explicit methods' work arrays (SW_EXTRA of n) */
  void *outside;  /* an outside library's stepper */
  void (*free_outside)(void *outside);
  sw_newton newton;
  size_t iterations; /* of the last trial, all stages */
  double rotation;   /* of the last update: largest edge rotation [rad] */
  const double *trial_x, *trial_v, *trial_a, *trial_strain;
};

enum { SW_EXTRA = 6 };

/* Makes work space for a system of this size. SW_ENOMEM. */
sw_status sw_stepper_new(sw_stepper *stepper, const sw_integrator *method, sw_system *system);
void sw_stepper_free(sw_stepper *stepper);

/* Returns the size of a method's history: xp and all arrays after it (doubles). */
size_t sw_stepper_history(const sw_stepper *stepper, const sw_system *system);

/* Computes a trial step from the system's state at t. The state stays untouched, except for the
 * tension, which sw_stepper_reject restores. */
sw_status sw_stepper_trial(sw_stepper *stepper, sw_system *system, double t, double h,
                           sw_error *err);
/* 1 if the method of the last trial has an error estimate of its own. */
int sw_stepper_estimates(const sw_stepper *stepper);
/* Returns the order of that method [-]. */
int sw_stepper_order(const sw_stepper *stepper);
/* Returns the error of the last trial by its method's estimate; for implicit Euler it is half the
 * change of velocities times the step. Largest of the nodes from first up to end; 0 if the
 * stepper's method has no estimate [m]. */
double sw_stepper_error(const sw_stepper *stepper, const sw_system *system, size_t first,
                        size_t end);
/* The same against the error of the node `from`, along the edges before the nodes [m]. */
double sw_stepper_error_along(const sw_stepper *stepper, const sw_system *system, size_t first,
                              size_t end, size_t from);
/* For implicit methods without an estimate: returns the difference between the last trial's
 * displacement and the trapezoidal rule of its velocities, largest of these nodes. It is their
 * error up to a factor. 0 for other methods and for the implicit midpoint rule, which equals that
 * rule [m]. */
double sw_stepper_defect(const sw_stepper *stepper, const sw_system *system, size_t first,
                         size_t end);
/* Returns the error of the last trial for the mean place of these nodes [m]. */
double sw_stepper_error_of_mean(const sw_stepper *stepper, const sw_system *system, size_t first,
                                size_t end);
/* Returns the error that the last trial would have as a step of implicit Euler, which has no
 * estimate: half the change of velocities times the step [m]. */
double sw_stepper_drift(const sw_stepper *stepper, const sw_system *system);
void sw_stepper_reject(sw_stepper *stepper, sw_system *system);
/* Makes the trial the system's state. */
void sw_stepper_accept(sw_stepper *stepper, sw_system *system, double h);

/* Explicit methods call this after each evaluation: its forces act on the velocity for the time
 * share [s]. */
void sw_stepper_book(sw_stepper *stepper, sw_system *system, double share);

/* Returns the next step size after one of size h with this error and tolerance [s]. */
double sw_stepper_next_h(const sw_stepper *stepper, double h, double error, double tolerance);

#endif
