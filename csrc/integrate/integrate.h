/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time integrators. A member is one file ending in one sw_integrator and one
 * X(name) line in list.def. Implicit members are rows of stages solved by
 * sw_system_stage; explicit ones use lumped masses and accelerations. An
 * integrator knows a system, never a force or a wire. */
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

/* One stage of an implicit method; shares of the step h and of the states at
 * the step's start (n), after the first stage (1) and before the start (p):
 * xhat = xn x_n + x1 x_1 + xp x_p + xv hbar v_n + xa hbar^2 a_n,
 * vhat = xn v_n + x1 v_1 + xp v_p + (xv + va) hbar a_n.
 * With inertia above 0 mass acts as so many times itself: the velocity is
 * (y - xhat)/hbar, the acceleration inertia (velocity - vhat)/hbar. */
typedef struct sw_stage_row {
  double time; /* of the step, 0..1 */
  double hbar; /* of the step */
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
  /* embedded, and what such a method starts with: h times the sum of these shares of the velocities
   * at the start and after each stage is the step's error, of one order more than the method [-].
   */
  double error[SW_STAGES_MAX + 1];
  /* onwards: the step ends at x_n + reach (y - x_n), and its velocities; keeps > 0: its
   * accelerations at a_n + keeps (a - a_n), which the next step begins with [-]. */
  double reach, keeps;
  /* Amplification of an infinitely stiff mode in one step (implicit): its largest size [-]. */
  double at_infinity;
  const char *start;     /* implicit: method for the first step after a
                            discontinuity; NULL = itself */
  double leapfrog_limit; /* explicit: stable while h omega_max is below; implicit: 0 [-] */
  /* explicit: advance (x, v) by h in place from time t; stepper's work arrays
   * are free to use. */
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
  /* strains (of the system's number): where the stage's rates count from, stages', rates of the
   * last stage, of the state before last; NULL without dashpots [-], [1/s] */
  double *strain_past, *strain[SW_STAGES_MAX], *strain_rate, *strain_before;
  double *tension; /* saved for a rejected step (edges) */
  /* axial forces times time since the step's start, of stages (edges); mean over the last step, or
   * NULL: the method's end is all there is [N s], [N] */
  double *pulled[SW_STAGES_MAX], *mean;
  double *first;                /* axial forces of the first of two stages (edges) [N] */
  sw_between between;           /* where those of the trial are that are read out */
  double turning[SW_TURN_SIZE]; /* what it keeps of wires that turn */
  double last_h;                /* of the last accepted step; 0 = none [s] */
  const sw_integrator *used;    /* by the last trial, of an implicit method */
  double trial_h;               /* of the last trial [s] */
  int restart;                  /* next step starts anew: a_n is stale */
  int plastic;    /* the next trials are of implicit Euler: what strikes does not bounce */
  int booked;     /* 1: an evaluation of the explicit step was booked */
  double **extra; /* explicit methods' work arrays (SW_EXTRA of n) */
  void *outside;  /* an outside library's stepper */
  void (*free_outside)(void *outside);
  sw_newton newton;
  size_t iterations; /* of the last trial, all stages */
  double rotation;   /* largest edge rotation of the last update [rad] */
  const double *trial_x, *trial_v, *trial_a, *trial_strain;
};

enum { SW_EXTRA = 6 };

/* Work space for a system of this size. SW_ENOMEM. */
sw_status sw_stepper_new(sw_stepper *stepper, const sw_integrator *method, sw_system *system);
void sw_stepper_free(sw_stepper *stepper);

/* Size of the history of a method, if it has one: xp and all after it (doubles). */
size_t sw_stepper_history(const sw_stepper *stepper, const sw_system *system);

/* Compute a trial step from the system's state at t; the state stays untouched
 * apart from the tension, which sw_stepper_reject puts back. */
sw_status sw_stepper_trial(sw_stepper *stepper, sw_system *system, double t, double h,
                           sw_error *err);
/* Has the method that the last trial was taken with an estimate of its own? */
int sw_stepper_estimates(const sw_stepper *stepper);
/* Order of that method [-]. */
int sw_stepper_order(const sw_stepper *stepper);
/* Error of the last trial by its method's estimate, of implicit Euler half the change of
 * velocities times the step; the largest of nodes from first up to end; 0 when the stepper's method
 * has none [m]. */
double sw_stepper_error(const sw_stepper *stepper, const sw_system *system, size_t first,
                        size_t end);
/* Of implicit methods without an estimate: how far the way of the last trial is from the trapezoid
 * of its velocities, which is their error but for a factor; the largest of these nodes. 0 of
 * others, and of the implicit midpoint rule, whose way that is [m]. */
double sw_stepper_defect(const sw_stepper *stepper, const sw_system *system, size_t first,
                         size_t end);
/* Error of the last trial of the mean place of these nodes [m]. */
double sw_stepper_error_of_mean(const sw_stepper *stepper, const sw_system *system, size_t first,
                                size_t end);
/* What the last trial would be off by as a step of implicit Euler, which has no estimate: half the
 * change of velocities, times the step [m]. */
double sw_stepper_drift(const sw_stepper *stepper, const sw_system *system);
void sw_stepper_reject(sw_stepper *stepper, sw_system *system);
/* Make the trial the system's state. */
void sw_stepper_accept(sw_stepper *stepper, sw_system *system, double h);

/* Explicit methods, after each evaluation: its forces act on the velocity for so long [s]. */
void sw_stepper_book(sw_stepper *stepper, sw_system *system, double share);

/* The next step size after one of size h with such an error, for a tolerance of it [s]. */
double sw_stepper_next_h(const sw_stepper *stepper, double h, double error, double tolerance);

#endif
