/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of the last trial, by the method's estimate. */
#include <math.h>

#include "integrate/integrate.h"
#include "system/system.h"

/* Returns the weights of the velocities at the start and after each stage in the error of the last
 * trial; NULL: no estimate. Implicit Euler, which takes the steps of impacts without bounce, has
 * half the change of velocities. */
static const double *shares_of_error(const sw_stepper *p) {
  static const double EULER[SW_STAGES_MAX + 1] = {-0.5, 0.5};
  if (!p->used || !(p->method->flags & SW_INTEGRATOR_EMBEDDED)) return NULL;
  if (p->used->error[0] != 0) return p->used->error;
  return p->used->stages == 1 ? EULER : NULL;
}

/* Returns the error of one component divided by h [m/s]. */
static double off_by(const sw_stepper *p, const double *shares, const sw_system *s, size_t i) {
  double e = shares[0] * s->v[i];
  for (size_t k = 0; k < p->used->stages; k++) e += shares[1 + k] * p->w[k][i];
  return e;
}

/* The same of a node [m/s]. */
static sw_vec node_off_by(const sw_stepper *p, const double *shares, const sw_system *s, size_t i) {
  return sw_v(off_by(p, shares, s, 3 * i), off_by(p, shares, s, 3 * i + 1),
              off_by(p, shares, s, 3 * i + 2));
}

/* Spins are not judged: friction or twist binds them to the nodes' motion, much faster than a step.
 */
double sw_stepper_error(const sw_stepper *p, const sw_system *s, size_t first, size_t end) {
  const double *shares = shares_of_error(p);
  double largest = 0;
  for (size_t i = first; shares && i < end; i++)
    largest = fmax(largest, sw_norm2(node_off_by(p, shares, s, i)));
  return p->trial_h * sqrt(largest);
}

double sw_stepper_error_along(const sw_stepper *p, const sw_system *s, size_t first, size_t end,
                              size_t from) {
  const double *shares = shares_of_error(p);
  double largest = 0;
  if (!shares) return 0;
  const sw_vec origin = node_off_by(p, shares, s, from);
  for (size_t i = first + 1; i < end; i++) {
    const sw_vec edge = sw_sub(sw_vec_at(s->x, i), sw_vec_at(s->x, i - 1));
    const sw_vec off = sw_sub(node_off_by(p, shares, s, i), origin);
    largest = fmax(largest, fabs(sw_dot(off, sw_unit_or(edge, sw_v(0, 0, 0)))));
  }
  return p->trial_h * largest;
}

double sw_stepper_defect(const sw_stepper *p, const sw_system *s, size_t first, size_t end) {
  const unsigned flags = p->method->flags;
  double largest = 0;
  if (!(flags & SW_INTEGRATOR_IMPLICIT) || flags & SW_INTEGRATOR_EMBEDDED) return 0;
  for (size_t i = first; i < end; i++) {
    const sw_vec way = sw_sub(sw_vec_at(p->trial_x, i), sw_vec_at(s->x, i));
    const sw_vec sum = sw_add(sw_vec_at(p->trial_v, i), sw_vec_at(s->v, i));
    largest = fmax(largest, sw_norm2(sw_madd(way, sum, -0.5 * p->trial_h)));
  }
  return sqrt(largest);
}

double sw_stepper_error_of_mean(const sw_stepper *p, const sw_system *s, size_t first, size_t end) {
  const double *shares = shares_of_error(p);
  if (!shares || !(end > first)) return 0;
  double mean[3] = {0};
  for (size_t i = 3 * first; i < 3 * end; i++) mean[i % 3] += off_by(p, shares, s, i);
  return p->trial_h * sw_norm(sw_load(mean)) / (double)(end - first);
}

int sw_stepper_order(const sw_stepper *p) { return p->used ? p->used->order : p->method->order; }

int sw_stepper_estimates(const sw_stepper *p) { return p->used && p->used->error[0] != 0; }

double sw_stepper_drift(const sw_stepper *p, const sw_system *s) {
  double largest = 0;
  for (size_t i = 0; i < s->nodes; i++)
    largest = fmax(largest, sw_norm2(sw_sub(sw_vec_at(p->trial_v, i), sw_vec_at(s->v, i))));
  return 0.5 * p->trial_h * sqrt(largest);
}
