/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of a wire's centre line: places, velocities and forces on them. */
#include "force/axis.h"

#include <math.h>

enum { ROW = SW_FIELD_ROW };

size_t sw_axis_points(const sw_plan *p) {
  if (!p->web) return p->nodes;
  return p->web->per_ring ? p->web->rings : 0;
}

double sw_axis_s(const sw_plan *p, size_t i) { return p->s[p->web ? p->web->first[i] : i]; }

sw_vec sw_axis_middle(const sw_field *f, const double *values, size_t i) {
  double middle[3];
  sw_web_middle(f->plan->web, values, i, middle);
  return sw_load(middle);
}

double sw_axis_mass(const sw_plan *p, size_t i) {
  double sum = 0;
  if (!p->web) return p->lumped[i];
  for (size_t k = p->web->first[i]; k < p->web->first[i + 1]; k++) sum += p->web->mass[k];
  return sum;
}

double sw_axis_stable_dt(const sw_plan *p, double stiffness) {
  double least = HUGE_VAL;
  for (size_t i = 0; i + 1 < sw_axis_points(p); i++)
    least = fmin(least, sw_axis_s(p, i + 1) - sw_axis_s(p, i));
  return 2.0 / sqrt(stiffness / (0.5 * least * p->beam.mass));
}

void sw_axis_put(sw_field *f, size_t i, sw_vec force, const double *K) {
  const sw_web *web = f->plan->web;
  const size_t from = web ? web->first[i] : i, to = web ? web->first[i + 1] : i + 1;
  for (size_t p = from; p < to; p++) {
    const double share = web && sw_web_is_ring(web, i) ? web->share[p - from] : 1.0;
    if (f->want & SW_WANT_FORCE) sw_accumulate(f->force + 3 * p, sw_scale(force, share));
    double *row = f->rows + ROW * p;
    for (int k = 0, at = 0; K && k < 3; k++)
      for (int j = k; j < 3; j++, at++) row[at] += share * K[3 * k + j];
  }
}

void sw_axis_push(sw_field *f, size_t i, sw_vec force, sw_vec d, double k) {
  const double K[9] = {k * d.x * d.x, k * d.x * d.y, k * d.x * d.z, k * d.y * d.x, k * d.y * d.y,
                       k * d.y * d.z, k * d.z * d.x, k * d.z * d.y, k * d.z * d.z};
  sw_axis_put(f, i, force, f->want & SW_WANT_STIFFNESS && k > 0 ? K : NULL);
}
