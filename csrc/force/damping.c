/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inner and outer damping: mass term f = -alpha m v; axial dashpot
 * c = beta EA/l0 along each edge; bending dashpot k = beta EI/w on the rate at
 * which neighbouring tangents turn against each other. alpha and beta are
 * Rayleigh's: a mode of angular frequency omega has the damping ratio
 * alpha/(2 omega) + beta omega/2 (small vibrations). In a mesh of particles the dashpots are
 * those of its springs, beta k each; its folds and solid elements have none. */
#include <math.h>
#include <stddef.h>

#include "force/force.h"

typedef struct damping_args {
  double mass;      /* alpha [1/s] */
  double stiffness; /* beta [s] */
} damping_args;

static const sw_param rows[] = {
    {"mass", SW_PARAM_NUMBER, "1/s", 0, 0, HUGE_VAL, 0, NULL, offsetof(damping_args, mass),
     "damping proportional to mass (Rayleigh's alpha)"},
    {"stiffness", SW_PARAM_NUMBER, "s", 0, 0, HUGE_VAL, 0, NULL, offsetof(damping_args, stiffness),
     "damping proportional to stiffness (Rayleigh's beta)"},
};

static void mass_term(double alpha, sw_field *f) {
  for (size_t i = 0; i < f->plan->nodes; i++) {
    const double c = alpha * f->plan->lumped[i];
    if (f->want & SW_WANT_FORCE)
      sw_accumulate(f->force + 3 * i, sw_scale(sw_load(f->v + 3 * i), -c));
    if (f->want & SW_WANT_STIFFNESS)
      for (int k = 0; k < 6; k += (k == 0 ? 3 : 2))
        f->rows[24 * i + (size_t)k] += c * f->velocity_rate;
  }
}

static sw_vec edge_tangent(const sw_field *f, size_t e) {
  return sw_v(f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]);
}

static sw_vec edge_rate(const sw_field *f, size_t e) {
  return sw_sub(sw_load(f->v + 3 * e + 3), sw_load(f->v + 3 * e));
}

static void add_gradient(sw_field *f, size_t e, sw_vec g) {
  f->gradient[0][e] += g.x;
  f->gradient[1][e] += g.y;
  f->gradient[2][e] += g.z;
}

/* own[e] += a (t t') + b (I - t t') */
static void add_own(sw_field *f, size_t e, double a, double b) {
  const double t[3] = {f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]};
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++) f->own[at][e] += (a - b) * t[i] * t[j] + (i == j ? b : 0.0);
}

static void axial_term(double beta, sw_field *f) {
  for (size_t e = 0; e < f->plan->edges; e++) {
    const double c = beta * f->plan->beam.EA / f->plan->rest[e];
    const sw_vec t = edge_tangent(f, e);
    if (f->want & SW_WANT_FORCE) add_gradient(f, e, sw_scale(t, c * sw_dot(t, edge_rate(f, e))));
    if (f->want & SW_WANT_STIFFNESS) add_own(f, e, c * f->velocity_rate, 0.0);
  }
}

/* rate at which the tangent turns: (I - t t') e'/l */
static sw_vec tangent_rate(const sw_field *f, size_t e) {
  const sw_vec t = edge_tangent(f, e), d = edge_rate(f, e);
  return sw_scale(sw_madd(d, t, -sw_dot(d, t)), f->reciprocal[e]);
}

static sw_vec across(const sw_field *f, size_t e, sw_vec a) {
  const sw_vec t = edge_tangent(f, e);
  return sw_madd(a, t, -sw_dot(a, t));
}

static void bending_term(double beta, sw_field *f) {
  for (size_t i = 1; i + 1 < f->plan->nodes; i++) {
    if (!(f->plan->hinge[i] > 0)) continue;
    const double k = beta * f->plan->beam.EI / f->plan->hinge[i];
    const double r1 = f->reciprocal[i - 1], r2 = f->reciprocal[i];
    if (f->want & SW_WANT_FORCE) {
      const sw_vec d = sw_scale(sw_sub(tangent_rate(f, i), tangent_rate(f, i - 1)), k);
      add_gradient(f, i - 1, sw_scale(across(f, i - 1, d), -r1));
      add_gradient(f, i, sw_scale(across(f, i, d), r2));
    }
    if (!(f->want & SW_WANT_STIFFNESS)) continue;
    const double kr = k * f->velocity_rate;
    add_own(f, i - 1, 0.0, kr * r1 * r1);
    add_own(f, i, 0.0, kr * r2 * r2);
    const sw_vec unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int c = 0; c < 3; c++) { /* columns of (I - t1 t1')(I - t2 t2') */
      const sw_vec column = across(f, i - 1, across(f, i, unit[c]));
      f->next[c][i] -= kr * r1 * r2 * column.x;
      f->next[3 + c][i] -= kr * r1 * r2 * column.y;
      f->next[6 + c][i] -= kr * r1 * r2 * column.z;
    }
  }
}

/* The hinge between a held director and an edge; not in statics, where nodes rest
 * while the director may be under way. */
static void clamp_term(double beta, sw_field *f, const sw_clamp_hinge *h) {
  const size_t e = h->edge, at = 3 * (2 * (size_t)h->hold + (h->side > 0 ? 1 : 0));
  const double k = beta * f->plan->beam.EI / h->length, r = f->reciprocal[e];
  if (f->want & SW_WANT_FORCE) {
    const sw_vec d = sw_scale(sw_sub(tangent_rate(f, e), sw_load(f->hold_turns + at)), k);
    add_gradient(f, e, sw_scale(across(f, e, d), r));
  }
  if (f->want & SW_WANT_STIFFNESS) add_own(f, e, 0.0, k * f->velocity_rate * r * r);
}

/* Dashpots beside the springs of a mesh. */
static void spring_term(double beta, sw_field *f) {
  const sw_web *w = f->plan->web;
  for (size_t e = 0; e < w->links; e++) {
    const size_t a = w->link[e].a, b = w->link[e].b;
    const double c = beta * w->link[e].k, r = c * f->velocity_rate;
    const sw_vec t = sw_unit_or(sw_sub(sw_vec_at(f->x, b), sw_vec_at(f->x, a)), sw_v(0, 0, 0));
    const sw_vec push = sw_scale(t, c * sw_dot(t, sw_sub(sw_vec_at(f->v, b), sw_vec_at(f->v, a))));
    if (f->want & SW_WANT_FORCE) {
      sw_accumulate(f->force + 3 * a, push);
      sw_accumulate(f->force + 3 * b, sw_neg(push));
    }
    if (!(f->want & SW_WANT_STIFFNESS)) continue;
    const double K[6] = {r * t.x * t.x, r * t.x * t.y, r * t.x * t.z,
                         r * t.y * t.y, r * t.y * t.z, r * t.z * t.z};
    sw_field_add_pair(f, a, b, f->link_slot[e], K);
  }
}

static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  const damping_args *a = args;
  (void)err;
  if (a->mass > 0) mass_term(a->mass, f);
  if (a->stiffness > 0 && f->plan->web) {
    spring_term(a->stiffness, f);
  } else if (a->stiffness > 0) {
    axial_term(a->stiffness, f);
    bending_term(a->stiffness, f);
    for (size_t k = 0; k < f->plan->clamp_count && !f->statics; k++)
      clamp_term(a->stiffness, f, &f->plan->clamps[k]);
  }
  return SW_OK;
}

const sw_force_class sw_force_damping = {
    .name = "damping",
    .summary = "Rayleigh damping, by mass and by axial and bending stiffness",
    .flags = SW_FORCE_DISSIPATIVE | SW_FORCE_ANY_BODY,
    .params = SW_PARAMS("force damping", rows),
    .eval = eval,
};
