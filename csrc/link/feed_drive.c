/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The force of a feed's drive. Where a wire leaves the guide bent, each length that is paid out
 * takes up bending energy at the drive's cost, and the guide's walls push the wire out with
 * EI curvature^2 / 2 (Bigoni et al. 2015). The drive bears the rest of the axial force. The
 * curvature is the elastic one: the energies of the hinge in the guide are all 1 / length at given
 * angles, that of a permanent bend too. */
#include "link/feed_drive.h"

#include <math.h>

#include "base/each.h"
#include "link/hold.h"
#include "state/hinge.h"
#include "system/system.h"

/* Returns twice the energy per length at a clamp's hinge of forces that remember bends, such as
 * plastic [N]. */
static double remembered(const sw_body *b, const sw_clamp_hinge *c) {
  double sum = 0;
  sw_field field = b->field;
  SW_ITEMS(const sw_term, term, b->terms, b->term_count) {
    if (!term->cls->clamp_energy) continue;
    field.history = term->history;
    sum += term->cls->clamp_energy(term->args, &field, c);
  }
  return 2.0 * sum / c->length;
}

/* Returns EI times the squared curvature where the wire leaves the guide on the clamp's side [N].
 * In a wire with frames the curvature is that at rest plus the bending. In a wire that remembers
 * bends it is the elastic one, squared with its stiffness. */
static double bent(const sw_system *s, const sw_body *b, size_t clamp, const double *x) {
  const sw_plan *p = b->plan;
  const sw_clamp_hinge *c = &p->clamps[clamp];
  const size_t at = 2 * (size_t)c->hold + (c->side > 0 ? 1 : 0), number = p->nodes + clamp;
  const double *edge = x + 3 * (b->first_node + c->edge);
  const sw_vec d = sw_vec_at(s->directors_now, at);
  const sw_vec t = sw_unit_or(sw_sub(sw_load(edge + 3), sw_load(edge)), d);
  if (!b->spin_block) {
    const double curvature = 2.0 * asin(fmin(1.0, 0.5 * sw_dist(d, t))) / c->length;
    return p->beam.EI * curvature * curvature + remembered(b, c);
  }
  const sw_edge_frame held = {d, sw_vec_at(s->normals_now, at)};
  const double *const *n = b->field.normals;
  const sw_edge_frame own = {t, sw_v(n[0][c->edge], n[1][c->edge], n[2][c->edge])};
  double bend[2], sum = 0;
  sw_hinge_bend(c->side > 0 ? &held : &own, c->side > 0 ? &own : &held,
                b->field.hinge_twist[number], bend);
  for (int k = 0; k < 2; k++) {
    const double rest = p->rest_bend[2 * number + k];
    const double curvature = (bend[k] - rest) / c->length + 2.0 * rest / p->rest[c->edge];
    sum += p->beam.EI_axis[k] * curvature * curvature;
  }
  return sum;
}

/* Returns GJ times the squared twist there [N]. */
static double twisted(const sw_system *s, const sw_body *b, size_t clamp) {
  const sw_plan *p = b->plan;
  if (b->spin_block) {
    const double rest = p->rest_twist[p->nodes + clamp];
    const double strain = (b->field.hinge_twist[p->nodes + clamp] - rest) / p->clamps[clamp].length;
    const double twist = strain + 2.0 * rest / p->rest[p->clamps[clamp].edge];
    return p->beam.GJ * twist * twist;
  }
  for (size_t k = 0; b->has_twist && k < p->span_count; k++) {
    if (p->spans[k].left != clamp && p->spans[k].right != clamp) continue;
    const double twist = s->twist[b->first_span + k] / p->spans[k].length;
    return p->beam.GJ * twist * twist;
  }
  return 0;
}

sw_vec sw_feed_direction(const sw_hold *h, const sw_system *s) {
  return sw_scale(sw_vec_at(s->directors_now, 2 * h->number + 1), h->feed.guide.outward);
}

double sw_feed_drive(const sw_hold *h, const sw_link_wire *w, const double *x, sw_vec force) {
  const sw_system *y = w->system;
  const sw_body *b = &y->bodies[w->body];
  const int number = (int)h->number;
  double sum = sw_dot(force, sw_feed_direction(h, y));
  for (size_t c = 0; c < b->plan->clamp_count; c++) {
    if (b->plan->clamps[c].hold != number) continue;
    const int grows = b->plan->clamps[c].side * h->feed.guide.outward;
    sum -= 0.5 * grows * (bent(y, b, c, x) + twisted(y, b, c));
  }
  return sum;
}
