/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial forces and holds' loads of read-outs: between both stages, and extrapolated to the step's
 * end. */
#include <math.h>
#include <string.h>

#include "base/each.h"
#include "system/arrays.h"
#include "system/axial.h"
#include "system/borne.h"
#include "system/rail.h"

/* Larger relative changes in a step are blows, which do not last. The extrapolation of read-outs
 * adds this share at most [-]. */
static const double SMOOTH = 0.1;

sw_status sw_system_add_even(sw_system *s) {
  double *room;
  SW_TRY(sw_system_grow_state(s, 2 * s->edges + SW_TURN_SIZE, &room));
  s->even = room;
  s->between = room + s->edges;
  s->turning = s->between + s->edges;
  return SW_OK;
}

void sw_system_sum_pull(const sw_system *s, const double *tension, const double *rate,
                        double *out) {
  if (s->edges) memcpy(out, tension, s->edges * sizeof *out);
  for (size_t i = 0; rate && i < s->body_count; i++) {
    const sw_body *b = &s->bodies[i];
    if (!(b->axial_time > 0)) continue;
    for (size_t e = 0; e < sw_plan_axial(b->plan); e++)
      out[b->first_edge + e] += b->axial_time * sw_body_axial(b, e) * rate[b->first_edge + e];
  }
}

/* An axial force: mix of both stages, `behind` ago, and its extrapolation to the step's end. */
typedef struct evened {
  double between, now;
} evened;

static evened even_of(const sw_system *s, size_t e, double h, sw_between at, double first,
                      double last) {
  const double apart = h - at.behind + s->turning[SW_TURN_BEHIND];
  const double on = s->turning[SW_TURN_EVEN] > 0 && apart > 0 ? at.behind / apart : 0.0;
  const double between = first + at.share * (last - first), most = SMOOTH * fabs(between);
  const double more = on * (between - s->between[e]);
  return (evened){between, between + fmin(fmax(more, -most), most)};
}

void sw_system_find_excess(sw_system *s, double h, const double *first, const double *first_x,
                           const double *rate, sw_between at) {
  sw_system_sum_pull(s, s->tension, rate, s->excess);
  for (size_t e = 0; e < s->edges; e++)
    s->excess[e] -= even_of(s, e, h, at, first[e], s->excess[e]).now;
  s->first = (sw_first_stage){first_x, at.share, at.first};
}

void sw_system_even_out(sw_system *s, double h, const double *first, sw_between at) {
  sw_system_sum_pull(s, s->tension, s->strain_rate, s->even);
  for (size_t e = 0; e < s->edges; e++) {
    const evened x = even_of(s, e, h, at, first[e], s->even[e]);
    s->even[e] = x.now, s->between[e] = x.between;
  }
  s->turning[SW_TURN_EVEN] = 1, s->turning[SW_TURN_BEHIND] = at.behind;
}

void sw_system_uneven(sw_system *s) { s->turning[SW_TURN_EVEN] = 0; }

void sw_system_forget_turning(sw_system *s) {
  memset(s->turning, 0, SW_TURN_SIZE * sizeof *s->turning);
}

/* 1 if the body's axial forces are read between both stages. Solid elements are read at the step's
 * end, and so are springs beside them: both are large and nearly cancel. */
static int is_even(const sw_system *s, const sw_body *body) {
  const sw_web *web = body->plan->web;
  return s->turning[SW_TURN_EVEN] > 0 && !(web && web->solids);
}

const double *sw_system_pull(const sw_system *s, const sw_body *body) {
  const double *T = is_even(s, body) ? s->even : body->axial_time > 0 ? s->pull : s->tension;
  return sw_system_with_borne(s, body, T + body->first_edge, SW_BORNE_PULL);
}

const double *sw_system_elastic(const sw_system *s, const sw_body *body) {
  const int even = is_even(s, body) && !(body->axial_time > 0);
  const double *T = even ? s->even : s->tension;
  return sw_system_with_borne(s, body, T + body->first_edge, SW_BORNE_ELASTIC);
}

const double *sw_system_mean_pull(const sw_system *s, const sw_body *body, const double *mean) {
  return sw_system_with_borne(s, body, mean, SW_BORNE_MEAN);
}

/* Force at a node along its link to another node [N]. */
static sw_vec along(const double *x, size_t node, size_t other, double pull) {
  const sw_vec d = sw_sub(sw_vec_at(x, other), sw_vec_at(x, node));
  const double l = sw_norm(d);
  return l > 0 ? sw_scale(d, pull / l) : sw_v(0, 0, 0);
}

static void add_at(sw_hold_load *load, sw_vec force, sw_vec at, sw_vec point) {
  load->force = sw_add(load->force, force);
  load->moment = sw_add(load->moment, sw_cross(sw_sub(at, point), force));
}

/* Returns the hold of a held particle, or -1. */
static int hold_of(const sw_system *s, const sw_body *b, size_t node) {
  for (size_t k = b->held; k; k = s->held[k - 1].next)
    if (s->held[k - 1].node == node) return s->held[k - 1].hold;
  return -1;
}

/* Adds the spring forces of a mesh on held particles, minus those of read-outs. */
static void add_excess_of_web(const sw_system *s, const sw_body *b, const double *x, int hold,
                              sw_vec point, sw_hold_load *out) {
  const sw_plan *p = b->plan;
  const double *excess = s->excess + b->first_edge;
  for (size_t e = 0; e < p->web->links; e++) {
    const size_t ends[2] = {p->web->link[e].a, p->web->link[e].b};
    for (int i = 0; i < 2; i++) {
      const size_t node = b->first_node + ends[i], other = b->first_node + ends[1 - i];
      if (p->held[ends[i]] == SW_FREE || hold_of(s, b, node) != hold) continue;
      add_at(out, along(x, node, other, excess[e]), sw_vec_at(x, node), point);
    }
  }
}

/* Removes the force along a rail on which the node moves: the rail bears nothing along itself. */
static sw_vec across_rail(const sw_system *s, const sw_held_node *h, sw_vec force) {
  const sw_rail *rail = h->rail ? &s->rails[h->rail - 1] : NULL;
  if (!rail || rail->state != SW_RAIL_GOES) return force;
  const sw_vec along = sw_unit_or(rail->along, sw_v(0, 0, 0));
  return sw_madd(force, along, -sw_dot(force, along));
}

static void add_excess_of_line(const sw_system *s, const sw_held_node *h, const double *x,
                               sw_vec point, sw_hold_load *out) {
  const sw_body *b = &s->bodies[h->body];
  const double *excess = s->excess + b->first_edge;
  const size_t i = h->node - b->first_node;
  const sw_vec at = sw_vec_at(x, h->node);
  sw_vec pull = {0, 0, 0};
  if (i > 0) pull = sw_add(pull, along(x, h->node, h->node - 1, excess[i - 1]));
  if (i < b->plan->edges) pull = sw_add(pull, along(x, h->node, h->node + 1, excess[i]));
  add_at(out, across_rail(s, h, pull), at, point);
}

void sw_system_bears(const sw_system *s, int hold, const double *x, sw_vec point, sw_vec *force,
                     sw_vec *moment) {
  sw_system_reaction(s, hold, point, force, moment);
  if (!s->first.x || s->loads_kept) return;
  sw_hold_load more = {.force = {0, 0, 0}};
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    if (h->hold != hold || s->bodies[h->body].plan->web) continue;
    add_excess_of_line(s, h, x, point, &more);
  }
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    if (b->plan->web && b->held && !b->plan->web->solids)
      add_excess_of_web(s, b, x, hold, point, &more);
  }
  *force = sw_add(*force, more.force);
  *moment = sw_add(*moment, more.moment);
}
