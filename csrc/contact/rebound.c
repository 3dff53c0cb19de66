/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When a place meets its obstacle within a step, and how much the rebound may change
 * (rebound.h). */
#include "contact/rebound.h"

#include <math.h>

sw_meeting sw_rebound_meet(double gap, double approach, double pull) {
  const double speed = sqrt(fmax(0.0, approach * fabs(approach) + 2.0 * pull * gap));
  return (sw_meeting){speed + approach > 0 ? 2.0 * gap / (speed + approach) : HUGE_VAL, speed};
}

/* A rebound acts at the step's start, above the surface, and so gains the height that the wire did
 * not fall. Allowed gain, over the rebound's own height [-]. */
static const double HEIGHT_ERROR = 0.02;
/* Largest gap at such a rebound, over the path in a whole step. It is an error of time [-]. */
static const double WAY_ERROR = 1.0 / 8;
/* A cut step ends before the touch, by this share of the time until it. The next step strikes at
 * its start [-]. */
static const double LEFT_OPEN = 0.02;
/* A wire that meets the surface earlier than by gravity alone is pushed there. The step is then cut
 * to this share [-]. */
static const double CUT_AGAIN = 0.7;

int sw_rebound_too_early(sw_contact *c, double e, double gap, double pull, sw_meeting m, double h) {
  const double height = e * e * m.speed * m.speed, fallen = 2.0 * (1.0 - e * e) * pull * gap;
  if (c->regime == SW_CONTACT_EXPLICIT || gap <= SW_CLOSED) return 0;
  if (fallen <= HEIGHT_ERROR * height && gap <= WAY_ERROR * m.speed * c->nominal) return 0;
  const double end = m.after < h ? (1.0 - LEFT_OPEN) * m.after : CUT_AGAIN * h;
  if (end < c->least) return 0;
  c->soonest = fmin(c->soonest, end);
  return 1;
}

/* Momentum of node i of a body along a direction, as seen from the wall [kg m/s]. */
static double momentum(const sw_system *s, const sw_body *b, size_t i, sw_vec wall, sw_vec along) {
  const sw_plan *p = b->plan;
  const double *v = s->v + 3 * b->first_node;
  double sum = p->mass_own[i] * sw_dot(along, sw_sub(sw_load(v + 3 * i), wall));
  if (i > 0) sum += p->mass_next[i - 1] * sw_dot(along, sw_sub(sw_load(v + 3 * i - 3), wall));
  if (i + 1 < p->nodes)
    sum += p->mass_next[i] * sw_dot(along, sw_sub(sw_load(v + 3 * i + 3), wall));
  return sum;
}

/* Masses couple neighbouring nodes. A node that reverses while its neighbours already fly off takes
 * kinetic energy from nowhere. A soft wire (E = 15 MPa, 20 edges) thrown at a table with
 * restitution 0.78 gained 2.8 % of its energy in one such impact, in steps of any size
 * (spec/physics/ledger_gain_spec). Nodes that land together rebound one after another, and the
 * energy lost by the first ones is available to the others. */
double sw_rebound_limit(sw_contact *c, const sw_system *s, const sw_pressed *t,
                        const sw_rebound *r) {
  const sw_body *b = &s->bodies[t->body];
  double towards = 0, mass = 0;
  if (b->plan->web) return r->wanted; /* their masses are lumped */
  for (size_t k = 0; k < t->spot.count; k++) {
    const size_t i = t->spot.node[k] - b->first_node;
    towards -= r->w[k] * momentum(s, b, i, r->wall, t->normal);
    for (size_t l = 0; l < t->spot.count; l++) {
      const size_t j = t->spot.node[l] - b->first_node;
      if (i == j) mass += r->w[k] * r->w[l] * b->plan->mass_own[i];
      if (i + 1 == j || j + 1 == i) mass += r->w[k] * r->w[l] * b->plan->mass_next[i < j ? i : j];
    }
  }
  if (!(mass > 0)) return r->wanted;
  /* cost of a change dv: dv (towards - mass dv/2) */
  double *lost = &c->lost[b->first_node];
  const double root = sqrt(fmax(0.0, towards * towards + 2.0 * mass * fmax(0.0, *lost)));
  const double dv = fmin(r->wanted, fmax(r->least, (towards + root) / mass));
  *lost += dv * (towards - 0.5 * mass * dv);
  return dv;
}
