/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plane strain: a stiff spring keeps each node or particle at its arc length along a line. Nothing
 * moves along the line, and sections deform only across it: E = 1/2 k l (d.(x - at) - s)^2, with l
 * the length of wire that the particle stands for. This models a slice of a long wire between
 * plates. Without arguments for it, the line is the one on which the wire lies when the force is
 * made. */
#include <math.h>
#include <stddef.h>

#include "force/force.h"

typedef struct plane_strain_args {
  sw_vec direction; /* [-] */
  sw_vec at;        /* [m] */
  double stiffness; /* [N/m2] */
} plane_strain_args;

static const sw_param rows[] = {
    {"direction", SW_PARAM_VECTOR, "-", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_REQUIRED, NULL,
     offsetof(plane_strain_args, direction), "direction of the wire, along which nothing may move"},
    {"at", SW_PARAM_VECTOR, "m", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(plane_strain_args, at),
     "any point of the plane in which the wire starts (default: its present start)"},
    {"stiffness", SW_PARAM_NUMBER, "N/m2", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(plane_strain_args, stiffness),
     "stiffness against motion, per length of wire (default: 10000 EA/radius^2)"},
};

static const double STIFF = 1e4; /* default, over a slice as thick as the wire's radius [-] */

static double stiffness_of(const plane_strain_args *a, const sw_beam *b) {
  return isnan(a->stiffness) ? STIFF * b->EA / (b->radius * b->radius) : a->stiffness;
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const plane_strain_args *a = args;
  const sw_plan *p = f->plan;
  const sw_vec d = sw_unit_or(a->direction, sw_v(1, 0, 0));
  const double u[3] = {d.x, d.y, d.z}, K = stiffness_of(a, &p->beam);
  for (size_t i = 0; i < p->nodes; i++) {
    const double k = K * p->lumped[i] / p->beam.mass;
    const double off = sw_dot(sw_sub(sw_load(f->x + 3 * i), a->at), d) - p->s[i];
    if (f->want & SW_WANT_FORCE) sw_accumulate(f->force + 3 * i, sw_scale(d, -k * off));
    if (f->want & SW_WANT_ENERGY) f->energy += 0.5 * k * off * off;
    if (!(f->want & SW_WANT_STIFFNESS)) continue;
    double *row = f->rows + 24 * i;
    for (int n = 0, at = 0; n < 3; n++)
      for (int j = n; j < 3; j++, at++) row[at] += k * u[n] * u[j];
  }
  return SW_OK;
}

static double stable_dt(const void *args, const sw_plan *plan) {
  return 2.0 * sqrt(plan->beam.mass / stiffness_of(args, &plan->beam));
}

static sw_status check(const void *args, const sw_beam *beam SW_UNUSED, sw_error *err) {
  const plane_strain_args *a = args;
  if (sw_norm(a->direction) > 0) return SW_OK;
  return sw_fail(err, SW_EINVAL, "force plane_strain: direction must not be zero");
}

/* A wire may be slightly bent, but must lie along direction: */
static const double LARGEST_OFF = 0.02; /* largest deviation over its length [-] */

static sw_status place(void *args, size_t n, const double *x, const double *s, sw_error *err) {
  plane_strain_args *a = args;
  if (sw_finite(a->at)) return SW_OK;
  if (!n)
    return sw_fail(err, SW_EINVAL,
                   "force plane_strain: at is required if it acts on several wires [m]: any point "
                   "of the plane in which they start; or give on");
  sw_vec d = sw_unit_or(a->direction, sw_v(1, 0, 0));
  double mean = 0, mean_s = 0, along = 0, most = 0, first = s[0], last = s[0];
  for (size_t i = 0; i < n; i++) {
    mean_s += s[i] / (double)n;
    first = fmin(first, s[i]), last = fmax(last, s[i]);
  }
  for (size_t i = 0; i < n; i++) along += (s[i] - mean_s) * sw_dot(sw_vec_at(x, i), d);
  if (along < 0) d = sw_scale(d, -1.0); /* drawn against direction */
  for (size_t i = 0; i < n; i++) mean += (sw_dot(sw_vec_at(x, i), d) - s[i]) / (double)n;
  for (size_t i = 0; i < n; i++) most = fmax(most, fabs(sw_dot(sw_vec_at(x, i), d) - s[i] - mean));
  if (most > LARGEST_OFF * (last - first))
    return sw_fail(
        err, SW_EINVAL,
        "force plane_strain: the wire does not lie along direction: it is up to %.3g m away from "
        "the place of its arc length; give the direction of the wire, or at [m] to pull it there",
        most);
  a->direction = d, a->at = sw_scale(d, mean);
  return SW_OK;
}

const sw_force_class sw_force_plane_strain = {
    .name = "plane_strain",
    .summary = "keeps nodes and particles in their place along the wire, free to move across it",
    .flags = SW_FORCE_ANY_BODY,
    .params = SW_PARAMS("force plane_strain", rows),
    .eval = eval,
    .stable_dt = stable_dt,
    .check = check,
    .place = place,
};
