/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Torques of spans that end at joins: couples on the hubs' arms, their rows in the equations, and
 * the moments of joints. */
#include <math.h>

#include "base/each.h"
#include "system/bridge.h"
#include "system/join_twist.h"

static const double SHARPEST = 1e-3; /* least 1 + d.t, as in force/twist.c [-] */

/* --- forces ------------------------------------------------------------------------ */

/* Returns the slope of a span's twist by a turn of the hub at its end [-]. */
static sw_vec axis_of(const sw_system *s, const sw_join_link *l, sw_vec director, const double *x) {
  const sw_join_span *k = &s->joins->twisted[l->number];
  const double *at = x + 3 * (s->bodies[k->body].first_node + l->end->edge);
  const sw_vec t = sw_unit_or(sw_sub(sw_load(at + 3), sw_load(at)), director);
  const double over = 1.0 / fmax(SHARPEST, 1.0 + sw_dot(director, t));
  return sw_scale(sw_add(director, t), l->sign * over);
}

/* Computes the slopes by the vectors of the hub's arms, for a slope `axis` by its turn. */
static void slopes_of(const sw_join_hub *h, const sw_hub_arm *arms, const double C[9], sw_vec mean,
                      sw_vec axis, sw_vec *out) {
  const sw_vec turn = sw_hub_times(C, axis), across = sw_cross(axis, mean);
  double all = 0;
  for (size_t a = 0; a < h->count; a++)
    all += h->arms[a].k * h->arms[a].along * sw_dot(arms[a].p, mean);
  for (size_t a = 0; a < h->count; a++) {
    const sw_hub_arm *v = &arms[a];
    const double k = h->arms[a].k * v->inverse;
    /* coupling times turn; or the slope of the mean direction */
    const sw_vec way = h->line ? sw_scale(across, h->arms[a].along / all) : sw_cross(turn, v->r);
    out[a] = sw_scale(sw_madd(way, v->p, -sw_dot(way, v->p)), k);
  }
}

/* Returns the torque of a span with this twist [N m]. */
static double torque_of(const sw_system *s, const sw_join_span *k, const double *twist) {
  const sw_body *b = &s->bodies[k->body];
  return sw_span_torque(b->plan, &b->plan->spans[k->span], b->plan->beam.GJ, twist[k->span]);
}

void sw_join_twist_eval(sw_system *s, const sw_join_hub *h, const sw_hub_arm *arms,
                        const double C[9]) {
  struct sw_joins *all = s->joins;
  if (!h->link_count) return;
  for (size_t i = 0; i < h->link_count; i++) {
    sw_join_link *l = &all->links[h->links[i]];
    const sw_join_span *k = &all->twisted[l->number];
    const sw_body *b = &s->bodies[k->body];
    const struct sw_join_arm *own = &h->arms[l->arm];
    const double torque = torque_of(s, k, b->twist_now);
    const sw_vec axis = axis_of(s, l, own->now, b->field.x - 3 * b->first_node);
    slopes_of(h, arms, C, sw_scale(own->now, own->along), axis, l->slope);
    for (size_t a = 0; a < h->count; a++) {
      sw_join_add_force(s, h->arms[a].to, sw_scale(l->slope[a], -torque));
      sw_join_add_force(s, h->arms[a].from, sw_scale(l->slope[a], torque));
    }
  }
}

/* --- in the equations --------------------------------------------------------------- */

/* Returns the place of a node in the matrix, SIZE_MAX if it is held. */
static size_t row_of(const sw_system *s, uint32_t node) {
  const sw_body *b = &s->bodies[sw_system_body_of(s, node)];
  const size_t i = node - b->first_node;
  if (!b->bridged || b->plan->held[i] != SW_FREE) return SIZE_MAX;
  return s->bridges->block * (s->bridges->first[sw_system_body_of(s, node)] + i);
}

void sw_join_twist_put(const sw_system *s, size_t number, double *out) {
  const struct sw_joins *all = s->joins;
  const sw_join_span *k = &all->twisted[number];
  for (size_t i = 0; i < k->link_count; i++) {
    sw_join_link *l = &all->links[k->links[i]];
    const sw_join_hub *h = &all->hubs[l->hub];
    for (size_t a = 0; a < h->count; a++) {
      const size_t from = row_of(s, h->arms[a].from), to = row_of(s, h->arms[a].to);
      l->row[0][a] = from, l->row[1][a] = to;
      if (from != SIZE_MAX) sw_accumulate(out + from, sw_neg(l->slope[a]));
      if (to != SIZE_MAX) sw_accumulate(out + to, l->slope[a]);
    }
  }
}

double sw_join_twist_dot(const sw_system *s, size_t number, const double *x) {
  const struct sw_joins *all = s->joins;
  const sw_join_span *k = &all->twisted[number];
  double sum = 0;
  for (size_t i = 0; i < k->link_count; i++) {
    const sw_join_link *l = &all->links[k->links[i]];
    for (size_t a = 0; a < all->hubs[l->hub].count; a++) {
      const size_t from = l->row[0][a], to = l->row[1][a];
      if (from != SIZE_MAX) sum -= sw_dot(l->slope[a], sw_load(x + from));
      if (to != SIZE_MAX) sum += sw_dot(l->slope[a], sw_load(x + to));
    }
  }
  return sum;
}

void sw_join_twist_react(const sw_system *s, sw_held_node *held) {
  const struct sw_joins *all = s->joins;
  if (!all) return;
  SW_ITEMS(const sw_join_link, l, all->links, all->link_count) {
    const sw_join_hub *h = &all->hubs[l->hub];
    const sw_join_span *k = &all->twisted[l->number];
    const double gain = s->bodies[k->body].twist_gain[k->span];
    for (size_t a = 0; a < h->count; a++) {
      if (h->arms[a].from == held->node)
        held->reaction = sw_madd(held->reaction, l->slope[a], -gain);
      if (h->arms[a].to == held->node) held->reaction = sw_madd(held->reaction, l->slope[a], gain);
    }
  }
}

/* --- read-outs ------------------------------------------------------------------------ */

sw_vec sw_join_hub_give(const sw_system *s, const sw_join_hub *h, const sw_hub_arm *arms) {
  const struct sw_joins *all = s->joins;
  sw_vec load = sw_v(0, 0, 0);
  double C[9];
  if (!h->link_count || h->line) return load;
  for (size_t i = 0; i < h->link_count; i++) {
    const sw_join_link *l = &all->links[h->links[i]];
    const sw_join_span *k = &all->twisted[l->number];
    const double torque = torque_of(s, k, s->twist + s->bodies[k->body].first_span);
    load = sw_madd(load, arms[l->arm].r, -l->sign * torque);
  }
  sw_hub_rest_compliance(h, arms, C);
  return sw_hub_times(C, load);
}

void sw_join_hub_moment(const sw_system *s, const sw_join_hub *h, size_t number, const double *x,
                        sw_vec *bending, sw_vec *twisting) {
  const struct sw_joins *all = s->joins;
  sw_hub_arm arms[SW_HUB_ARMS];
  sw_vec slope[SW_HUB_ARMS];
  double C[9];
  const sw_quat q = sw_join_hub_turn(h, x);
  sw_hub_measure(h, x, arms);
  sw_hub_compliance(h, arms, C);
  *bending = sw_scale(sw_cross(arms[number].p, arms[number].r), h->arms[number].k);
  *twisting = sw_v(0, 0, 0);
  for (size_t i = 0; i < h->link_count; i++) {
    const sw_join_link *l = &all->links[h->links[i]];
    const sw_join_span *k = &all->twisted[l->number];
    const struct sw_join_arm *own = &h->arms[l->arm];
    const double torque = torque_of(s, k, s->twist + s->bodies[k->body].first_span);
    const sw_vec director = sw_join_director(h, own, q, x), axis = axis_of(s, l, director, x);
    const double length = 1.0 / arms[number].inverse;
    slopes_of(h, arms, C, sw_scale(director, own->along), axis, slope);
    *bending = sw_madd(*bending, sw_cross(arms[number].p, slope[number]), -torque * length);
    if (l->arm == number) *twisting = sw_madd(*twisting, axis, torque);
  }
}
