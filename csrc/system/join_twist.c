/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Twist of straight wires that rigid joins pass on. A join ends a span of twist like a clamp: its
 * director r = R d turns with the hub. The hub turns with its arms' directions, so the span's twist
 * also has slopes at the nodes of the other wires, and its torque is a couple on them. By this
 * torque the hub turns on a little (see hub.c): spans at a hub are coupled by its compliance C. The
 * state has the twist of the wire itself, phi - d'w with the further turn w = -C sum d torque.
 *
 * Arms that are nearly in line leave the hub's turn about them open. Then all take one director,
 * the mean of their directions, which is carried along without a turn of its own; and the hub is
 * free to turn about it. Wires in line so twist like one. */
#include "system/join_twist.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "system/twist.h"

/* Compliance of a hub that is free to turn, over that of the softest span [-]. */
static const double OPEN = 1e6;

/* --- spans that end at joins ------------------------------------------------------- */

static const sw_span *span_of(const sw_system *s, const sw_join_span *k) {
  return &s->bodies[k->body].plan->spans[k->span];
}

static int is_awake(const sw_system *s, const sw_join_span *k) { return !s->bodies[k->body].waits; }

static double compliance_of(const sw_system *s, const sw_join_span *k) {
  return span_of(s, k)->length / s->bodies[k->body].plan->beam.GJ;
}

static sw_status list_places(sw_system *s) {
  struct sw_joins *all = s->joins;
  size_t count = 0;
  for (size_t h = 0; h < all->hub_count; h++)
    for (size_t a = 0; a < all->hubs[h].count; a++)
      if (all->hubs[h].arms[a].stop > count) count = all->hubs[h].arms[a].stop;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(all->places, count + 1), SW_ROOM(all->number, s->span_count + 1)));
  for (size_t h = 0; h < all->hub_count; h++)
    for (size_t a = 0; a < all->hubs[h].count; a++) {
      const size_t stop = all->hubs[h].arms[a].stop;
      if (stop) all->places[stop - 1 - s->hold_count] = (sw_join_place){h, a};
    }
  return SW_OK;
}

/* Lists the span's ends at hubs. */
static sw_status add_links(sw_system *s, size_t body, size_t span) {
  struct sw_joins *all = s->joins;
  const sw_plan *p = s->bodies[body].plan;
  const size_t ends[2] = {p->spans[span].left, p->spans[span].right}, number = all->twisted_count;
  sw_join_span new = {.body = body, .span = span};
  for (size_t side = 0; side < 2; side++) {
    const sw_clamp_hinge *end = &p->clamps[ends[side]];
    if (ends[side] < p->clamp_count) continue;
    const sw_join_place at = all->places[(size_t)end->hold - s->hold_count];
    sw_join_hub *hub = &all->hubs[at.hub];
    SW_TRY(SW_GROW(all->links, all->link_capacity, all->link_count + 1));
    all->links[all->link_count] = (sw_join_link){
        .hub = at.hub, .arm = at.arm, .number = number, .end = end, .sign = side ? 1.0 : -1.0};
    new.links[new.link_count++] = hub->links[hub->link_count++] = all->link_count++;
  }
  all->number[s->bodies[body].first_span + span] = new.link_count ? number : SIZE_MAX;
  if (!new.link_count) return SW_OK;
  SW_TRY(SW_GROW(all->twisted, all->twisted_capacity, number + 1));
  all->twisted[all->twisted_count++] = new;
  return SW_OK;
}

sw_status sw_joins_link(sw_system *s) {
  struct sw_joins *all = s->joins;
  if (!all || !all->hub_count) return SW_OK;
  SW_TRY(list_places(s));
  for (size_t b = 0; b < s->body_count; b++)
    for (size_t k = 0; s->bodies[b].has_twist && k < s->bodies[b].plan->span_count; k++)
      SW_TRY(add_links(s, b, k));
  const size_t m = all->twisted_count;
  all->give = sw_alloc(2 * m * m + 2 * m + 1, sizeof *all->give);
  if (!all->give) return SW_ENOMEM;
  all->stiffness = all->give + m * m;
  all->change = all->stiffness + m * m;
  return SW_OK;
}

size_t sw_joins_span(const sw_system *s, const sw_body *b, size_t span) {
  const struct sw_joins *all = s->joins;
  return all && b->plan->stops ? all->number[b->first_span + span] : SIZE_MAX;
}

/* --- compliance --------------------------------------------------------------------- */

/* Adds a hub's part to the give of all spans. */
static void add_give(struct sw_joins *all, const sw_join_hub *h, double open) {
  const size_t m = all->twisted_count;
  sw_hub_arm arms[SW_HUB_ARMS];
  double C[9];
  for (size_t a = 0; a < h->count; a++) arms[a].r = h->arms[a].rest, arms[a].inverse = 0;
  sw_hub_rest_compliance(h, arms, C);
  for (size_t i = 0; i < h->link_count; i++)
    for (size_t j = 0; j < h->link_count; j++) {
      const sw_join_link *p = &all->links[h->links[i]], *q = &all->links[h->links[j]];
      const struct sw_join_arm *a = &h->arms[p->arm], *b = &h->arms[q->arm];
      const double give =
          h->line ? open * a->along * b->along : sw_dot(a->rest, sw_hub_times(C, b->rest));
      all->give[m * p->number + q->number] += p->sign * q->sign * give;
    }
}

/* Replaces a positive definite matrix by its inverse. */
static void invert(double *a, size_t m) {
  for (size_t k = 0; k < m; k++) {
    const double pivot = 1.0 / a[m * k + k];
    a[m * k + k] = 1.0;
    for (size_t j = 0; j < m; j++) a[m * k + j] *= pivot;
    for (size_t i = 0; i < m; i++) {
      const double f = a[m * i + k];
      if (i == k || f == 0) continue;
      a[m * i + k] = 0;
      for (size_t j = 0; j < m; j++) a[m * i + j] -= f * a[m * k + j];
    }
  }
}

/* Computes what hubs give, and the spans' stiffness with it; again if lengths have changed. */
static void size_spans(const sw_system *s) {
  struct sw_joins *all = s->joins;
  const size_t m = all->twisted_count;
  double softest = 0;
  int changed = 0;
  SW_ITEMS(sw_join_span, k, all->twisted, m) {
    const double own = compliance_of(s, k);
    changed |= own != k->compliance;
    k->compliance = own;
    softest = fmax(softest, own);
  }
  if (!changed) return;
  memset(all->give, 0, m * m * sizeof *all->give);
  for (size_t h = 0; h < all->hub_count; h++)
    if (all->hubs[h].link_count) add_give(all, &all->hubs[h], OPEN * softest);
  memcpy(all->stiffness, all->give, m * m * sizeof *all->give);
  for (size_t k = 0; k < m; k++) all->stiffness[m * k + k] += all->twisted[k].compliance;
  invert(all->stiffness, m);
}

/* Turns changes of the spans' twist against the hubs into their torques [rad], [N m]. */
static void gain(const struct sw_joins *all, const double *change, double *torque) {
  const size_t m = all->twisted_count;
  for (size_t k = 0; k < m; k++) {
    torque[k] = 0;
    for (size_t j = 0; j < m; j++) torque[k] += all->stiffness[m * k + j] * change[j];
  }
}

void sw_joins_gain(sw_system *s) {
  const struct sw_joins *all = s->joins;
  const size_t m = all ? all->twisted_count : 0;
  for (size_t k = 0; k < m; k++) {
    const sw_join_span *at = &all->twisted[k];
    const sw_body *b = &s->bodies[at->body];
    all->change[k] = b->bridged ? b->twist_gain[at->span] * at->compliance : 0;
  }
  if (m) gain(all, all->change, all->change + m);
  for (size_t k = 0; k < m; k++) {
    const sw_body *b = &s->bodies[all->twisted[k].body];
    if (b->bridged) b->twist_gain[all->twisted[k].span] = all->change[m + k];
  }
}

void sw_joins_row(const sw_system *s, const sw_body *b, size_t span, size_t row) {
  const size_t number = sw_joins_span(s, b, span);
  if (number != SIZE_MAX) s->joins->twisted[number].row = row;
}

void sw_joins_add_give(const sw_system *s, double *S, size_t m) {
  const struct sw_joins *all = s->joins;
  const size_t n = all ? all->twisted_count : 0;
  for (size_t k = 0; k < n; k++)
    for (size_t j = 0; j < n; j++) {
      const sw_join_span *a = &all->twisted[k], *b = &all->twisted[j];
      if (s->bodies[a->body].bridged && s->bodies[b->body].bridged)
        S[m * a->row + b->row] += all->give[n * k + j];
    }
}

/* --- twist ------------------------------------------------------------------------- */

static void turn_hub(sw_system *s, sw_join_hub *h, const double *x) {
  if (!h->line) {
    const sw_quat before = sw_join_hub_turn(h, s->x), now = sw_join_hub_turn(h, x);
    h->before = before, h->now = now;
    for (size_t a = 0; a < h->count; a++) {
      h->edge[0][a] = sw_join_edge(&h->arms[a], s->x);
      h->edge[1][a] = sw_join_edge(&h->arms[a], x);
    }
  }
  SW_ITEMS(struct sw_join_arm, arm, h->arms, h->count) {
    if (!arm->stop) continue;
    arm->before = sw_join_director(h, arm, h->before, s->x);
    arm->now = sw_join_director(h, arm, h->now, x);
    for (size_t side = 0; side < 2; side++)
      sw_store(s->directors_now + 3 * (2 * (size_t)(arm->stop - 1) + side), arm->now);
  }
}

void sw_joins_twist(sw_system *s, const double *x) {
  struct sw_joins *all = s->joins;
  if (!all || !all->hub_count) return;
  double *const torque = all->change + all->twisted_count;
  size_spans(s);
  SW_ITEMS(sw_join_hub, h, all->hubs, all->hub_count) {
    const size_t body = sw_system_body_of(s, h->arms[0].from);
    if (h->link_count && !s->bodies[body].waits) turn_hub(s, h, x);
  }
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    for (size_t k = 0; b->plan->stops && b->has_twist && k < b->plan->span_count; k++)
      b->twist_now[k] = b->waits ? 0 : sw_twist_change(s, b, k, x);
  }
  SW_ITEMS(const sw_join_span, k, all->twisted, all->twisted_count) {
    all->change[k - all->twisted] = s->bodies[k->body].twist_now[k->span];
  }
  gain(all, all->change, torque);
  SW_ITEMS(const sw_join_span, k, all->twisted, all->twisted_count) {
    if (is_awake(s, k))
      s->bodies[k->body].twist_now[k->span] = torque[k - all->twisted] * k->compliance;
  }
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    for (size_t k = 0; b->plan->stops && b->has_twist && k < b->plan->span_count; k++)
      b->twist_now[k] += s->twist[b->first_span + k];
  }
}
