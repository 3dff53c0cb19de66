/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which wires meet the facets of a round surface with their smooth curve. A chord is further out on
 * a corner than on a facet: as both pass each other, the wire's way changes, and the pull of a
 * drawn cable rippled by up to 29 %, for facets of any width. On the curve it is that of the round
 * surface within 2 % (spec/contact/facet_width_spec, narrow_facets_spec). */
#include <math.h>

#include "contact/round.h"

/* Facets wider than these shares of a wire's edges meet its curve: NARROW in poses, and where a
 * wire has become taut in motion, until it lifts off; else WIDE. The curve touches all corners
 * within an edge: where a soft wire falls on 13 of them, steps need 2.7 times the iterations
 * (spec/contact/smooth_spec), and poses do not come to rest on 60 [-]. */
static const double WIDE = 0.125, NARROW = 0.03;

/* The pull of a soft wire on the curve is low by about edge^2/8R^2. From this error on a wire in
 * motion stays on its chords: their pull ripples by more, but its mean is right within 1 %
 * (spec/contact/faceted_capstan_spec) [-]. */
static const double COARSE = 0.01;

static int is_coarse(const sw_contact *c, const sw_body *b, const sw_memory *m, size_t o) {
  const double edge = b->plan->rest[m->node - b->first_node];
  const double radius = c->facet_radius[o] + b->plan->beam.radius;
  return edge * edge > 8.0 * COARSE * radius * radius;
}

/* A wire is taut if it pulls with more than this many times its weight. A wire that falls on
 * something and hangs over it pulls with less [-]. */
static const double TAUT = 10.0;

static int is_taut(const sw_system *s, const sw_body *b, size_t node) {
  const sw_plan *p = b->plan;
  const double rest = p->rest[node - b->first_node];
  const double stretch = sw_dist(sw_vec_at(s->x, node), sw_vec_at(s->x, node + 1)) / rest - 1.0;
  return b->EA * stretch > TAUT * p->beam.mass * p->length * sw_norm(sw_load(s->gravity));
}

void sw_contact_find_curved(sw_contact *c, const sw_system *s, size_t body) {
  const sw_body *b = &s->bodies[body];
  if (b->plan->web || b->plan->beam.rolls) return;
  for (size_t i = sw_contact_first_memory(c, b->first_node); i < c->memory_count; i++) {
    const sw_memory *m = &c->memory[i];
    if (m->node >= b->first_node + b->plan->nodes) return;
    if (!m->segment || !(m->kept.normal_force > 0)) continue;
    const size_t o = sw_contact_index(c, m->obstacle);
    if (o == c->count || !(c->facet[o] > 0)) continue;
    if (m->kept.curve || (!is_coarse(c, b, m, o) && is_taut(s, b, m->node)))
      c->curved[o] = (int)body + 1;
  }
}

int sw_contact_meets_curve(const sw_contact *c, const sw_system *s, const sw_candidate *k) {
  const sw_body *b = &s->bodies[k->body];
  const sw_plan *p = b->plan;
  const size_t i = k->node - b->first_node;
  const size_t high = i < p->edges ? i : p->edges - 1, low = k->segment || i == 0 ? high : i - 1;
  const int narrow = c->regime == SW_CONTACT_STATIC || c->curved[k->obstacle] == (int)k->body + 1;
  return c->facet[k->obstacle] > (narrow ? NARROW : WIDE) * fmin(p->rest[low], p->rest[high]);
}
