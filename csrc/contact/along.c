/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of a wire in its own direction: sums over its touches. */
#include <math.h>

#include "contact/halt.h"

/* Leaves out touches whose friction across the wire is above this share of its limit [-]. */
static const double ACROSS = 0.5;

void sw_along_add(const sw_system *s, size_t body, size_t node, sw_vec friction, double most,
                  sw_along *sum) {
  const sw_body *b = &s->bodies[body];
  const size_t e = node + 1 < b->first_node + b->plan->nodes ? node : node - 1;
  const sw_vec edge = sw_sub(sw_vec_at(s->x, e + 1), sw_vec_at(s->x, e));
  const sw_vec t = sw_unit_or(edge, sw_v(0, 0, 0));
  const double along = sw_dot(friction, t);
  if (sw_norm(sw_madd(friction, t, -along)) > ACROSS * most) return;
  sum->along += along, sum->most += most;
}

void sw_contact_along(const sw_contact *c, const sw_system *s, size_t body, sw_along *sum) {
  const size_t first = s->bodies[body].first_node, end = first + s->bodies[body].plan->nodes;
  const size_t count = sw_contact_touches(c);
  sw_contact_push p;
  for (size_t k = 0; k < count; k++) {
    if (!sw_contact_push_at(c, s, k, &p) || p.node < first || p.node >= end) continue;
    const sw_vec across = sw_madd(p.force, p.normal, -sw_dot(p.force, p.normal));
    sw_along_add(s, body, p.node, across, p.friction * p.normal_force, sum);
  }
}
