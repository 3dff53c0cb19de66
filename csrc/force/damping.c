/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inner and outer damping: mass term f = -alpha m v; axial force beta EA per strain rate in each
 * edge; bending moment beta EI per rate of curvature. alpha and beta are Rayleigh's: a mode of
 * angular frequency omega has the damping ratio alpha/(2 omega) + beta omega/2 (small vibrations).
 * A mesh of particles has one dashpot of beta k beside each spring; its folds and solid elements
 * have none. */
#include <math.h>
#include <stddef.h>

#include "force/dashpot.h"
#include "force/force.h"

typedef struct damping_args {
  double mass;      /* alpha [1/s] */
  double stiffness; /* beta [s] */
} damping_args;

static const sw_param rows[] = {
    {"mass", SW_PARAM_NUMBER, "1/s", 0, 0, HUGE_VAL, SW_PARAM_CHANGES, NULL,
     offsetof(damping_args, mass), "damping proportional to mass (Rayleigh's alpha)"},
    {"stiffness", SW_PARAM_NUMBER, "s", 0, 0, HUGE_VAL, SW_PARAM_CHANGES, NULL,
     offsetof(damping_args, stiffness), "damping proportional to stiffness (Rayleigh's beta)"},
};

static void mass_term(double alpha, sw_field *f) {
  for (size_t i = 0; i < f->plan->nodes; i++) {
    const double c = alpha * f->plan->lumped[i];
    if (f->want & SW_WANT_FORCE)
      sw_accumulate(f->force + 3 * i, sw_scale(sw_load(f->v + 3 * i), -c));
    if (f->want & SW_WANT_POWER) f->power += c * sw_norm2(sw_load(f->v + 3 * i));
    if (f->want & SW_WANT_STIFFNESS)
      for (int k = 0; k < 6; k += (k == 0 ? 3 : 2))
        f->rows[24 * i + (size_t)k] += c * f->velocity_rate;
  }
}

static sw_vec edge_rate(const sw_field *f, size_t e) {
  return sw_sub(sw_load(f->v + 3 * e + 3), sw_load(f->v + 3 * e));
}

/* own[e] += a (t t') + b (I - t t') */
static void add_own(sw_field *f, size_t e, double a, double b) {
  const double t[3] = {f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]};
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++) f->own[at][e] += (a - b) * t[i] * t[j] + (i == j ? b : 0.0);
}

/* Returns the strain rate of an edge [1/s]. */
static double strain_rate(const sw_field *f, size_t e) {
  const double rest = f->plan->rest[e];
  if (f->strain_rate) return f->strain_rate[e];
  if (f->strain_past) return (f->length[e] / rest - 1.0 - f->strain_past[e]) * f->velocity_rate;
  return sw_dot(sw_field_tangent(f, e), edge_rate(f, e)) / rest;
}

/* Returns how much the dashpot's force changes the axial force that the stiffness across the edge
 * uses. In dynamics only tension counts there (see force/axial.h) [N]. */
static double pulled_more(double tension, double more) {
  return fmax(tension + more, 0.0) - fmax(tension, 0.0);
}

static void axial_term(double beta, sw_field *f) {
  const double c = beta * f->plan->beam.EA;
  for (size_t e = 0; e < f->plan->edges; e++) {
    if (f->want & (SW_WANT_FORCE | SW_WANT_POWER)) {
      const double rate = strain_rate(f, e);
      if (f->want & SW_WANT_FORCE)
        sw_field_add_gradient(f, e, sw_scale(sw_field_tangent(f, e), c * rate));
      f->power += f->want & SW_WANT_POWER ? c * rate * rate * f->plan->rest[e] : 0.0;
    }
    if (!(f->want & SW_WANT_STIFFNESS)) continue;
    double across = 0.0;
    if (f->strain_past && f->tension) {
      const double more = c * (f->strain[e] - f->strain_past[e]) * f->velocity_rate;
      across = pulled_more(f->tension[e], more) * f->reciprocal[e];
    }
    add_own(f, e, c / f->plan->rest[e] * f->velocity_rate, across);
  }
}

/* Adds the dashpot beside one spring of a mesh. */
static void spring_dashpot(double beta, sw_field *f, size_t e) {
  const sw_web_link *link = &f->plan->web->link[e];
  const double c = beta * link->k * link->rest;
  const sw_vec d = sw_sub(sw_vec_at(f->x, link->b), sw_vec_at(f->x, link->a));
  const sw_vec t = sw_unit_or(d, sw_v(0, 0, 0));
  const double l = sw_norm(d), known = l > 0 ? l / link->rest - 1.0 : 0.0;
  double rate;
  if (f->strain_rate)
    rate = f->strain_rate[e];
  else if (f->strain_past)
    rate = (known - f->strain_past[e]) * f->velocity_rate;
  else
    rate = sw_dot(t, sw_sub(sw_vec_at(f->v, link->b), sw_vec_at(f->v, link->a))) / link->rest;
  if (f->want & SW_WANT_POWER) f->power += c * rate * rate * link->rest;
  if (f->want & SW_WANT_FORCE) {
    sw_accumulate(f->force + 3 * (size_t)link->a, sw_scale(t, c * rate));
    sw_accumulate(f->force + 3 * (size_t)link->b, sw_scale(t, -c * rate));
  }
  if (!(f->want & SW_WANT_STIFFNESS)) return;
  double across = 0.0;
  if (f->strain_past && f->tension && l > 0) {
    const double more = c * (f->strain[e] - f->strain_past[e]) * f->velocity_rate;
    across = (f->cautious ? pulled_more(f->tension[e], more) : more) / l;
  }
  const double r = c / link->rest * f->velocity_rate - across;
  const double K[6] = {r * t.x * t.x + across, r * t.x * t.y, r * t.x * t.z,
                       r * t.y * t.y + across, r * t.y * t.z, r * t.z * t.z + across};
  sw_field_add_pair(f, link->a, link->b, f->link_slot[e], K);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const damping_args *a = args;
  if (a->mass > 0) mass_term(a->mass, f);
  if (a->stiffness > 0 && f->plan->web) {
    for (size_t e = 0; e < f->plan->web->links; e++) spring_dashpot(a->stiffness, f, e);
  } else if (a->stiffness > 0) {
    /* in statics nodes are at rest, but holds may be moving */
    const double eta = a->stiffness * f->plan->beam.EI;
    axial_term(a->stiffness, f);
    sw_dashpot_hinges(eta, f);
    for (size_t k = 0; k < f->plan->clamp_count && !f->statics; k++)
      sw_dashpot_clamp(eta, f, &f->plan->clamps[k]);
  }
  return SW_OK;
}

static double axial_time(const void *args) { return ((const damping_args *)args)->stiffness; }

static double viscosity(const void *args, const sw_plan *plan) {
  return ((const damping_args *)args)->stiffness * plan->beam.EI;
}

static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *h) {
  const double eta = ((const damping_args *)args)->stiffness * f->plan->beam.EI;
  return sw_dashpot_clamp_moment(eta, f, h);
}

const sw_force_class sw_force_damping = {
    .name = "damping",
    .summary = "Rayleigh damping, by mass and by axial and bending stiffness",
    .flags = SW_FORCE_DISSIPATIVE | SW_FORCE_ANY_BODY | SW_FORCE_POWER,
    .params = SW_PARAMS("force damping", rows),
    .eval = eval,
    .axial_time = axial_time,
    .viscosity = viscosity,
    .clamp_moment = clamp_moment,
};
