/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turns of a wire's edges about themselves, as its twist tells them. Along a span each hinge takes
 * its share of the span's twist; from a clamp to a free end the wire is not twisted. Wires with
 * material frames have these turns. */
#include <string.h>

#include "base/each.h"
#include "system/spin.h"
#include "system/twist.h"

/* One wire at the state and at positions x. */
typedef struct walk {
  const sw_plan *plan;
  const double *before, *now; /* nodes of the body (nodes x 3) [m] */
  double *turn;               /* (edges) [rad] */
} walk;

static sw_vec tangent(const double *x, size_t e) {
  const sw_vec d = sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e));
  return sw_unit_or(d, sw_v(1, 0, 0));
}

/* Change of twist of the hinge between edges e - 1 and e if neither turns about itself [rad]. */
static double at_hinge(const walk *w, size_t e) {
  return sw_hinge_change(tangent(w->before, e - 1), tangent(w->before, e), tangent(w->now, e - 1),
                         tangent(w->now, e));
}

/* Change of twist of the hinge between a clamp and its edge, likewise [rad]. */
static double at_clamp(const walk *w, const sw_clamp_hinge *h, const sw_clamp_change *c) {
  const sw_vec before = tangent(w->before, h->edge), now = tangent(w->now, h->edge);
  return h->side > 0 ? sw_hinge_change(c->before, before, c->now, now)
                     : sw_hinge_change(before, c->before, now, c->now);
}

/* Follows the wire from a clamp away from it up to edge `last`, without twist. Edges held by the
 * clamp, on its other side, turn with it. */
static void follow(walk *w, const sw_system *s, const sw_clamp_hinge *h, size_t last) {
  const sw_clamp_change c = sw_clamp_change_of(s, h);
  const int *held = w->plan->held;
  const size_t edges = w->plan->edges;
  double *turn = w->turn;
  turn[h->edge] = c.turn - h->side * at_clamp(w, h, &c);
  for (size_t e = h->edge; h->side > 0 && e < last; e++) turn[e + 1] = turn[e] - at_hinge(w, e + 1);
  for (size_t e = h->edge; h->side < 0 && e > last; e--) turn[e - 1] = turn[e] + at_hinge(w, e);
  for (size_t e = h->edge; h->side > 0 && e > 0 && held[e - 1] && held[e]; e--)
    turn[e - 1] = c.turn;
  for (size_t e = h->edge + 1; h->side < 0 && e < edges && held[e] && held[e + 1]; e++)
    turn[e] = c.turn;
}

/* Gives each edge of a span its share of what twists the span. */
static void share(walk *w, const sw_system *s, const sw_span *span) {
  const sw_clamp_hinge *right = &w->plan->clamps[span->right];
  const sw_clamp_change c = sw_clamp_change_of(s, right);
  const double twist = c.turn - w->turn[span->last] + at_clamp(w, right, &c);
  const double *at = w->plan->s, from = at[span->first], length = at[span->last + 1] - from;
  for (size_t e = span->first; e <= span->last; e++)
    w->turn[e] += twist * (0.5 * (at[e] + at[e + 1]) - from) / length;
}

int sw_system_turns(const sw_system *s, const sw_body *b, const double *x, double *turn) {
  const sw_plan *p = b->plan;
  const size_t clamps = p->clamp_count + p->stops;
  const sw_clamp_hinge *first = NULL, *last = NULL;
  walk w = {p, s->x + 3 * b->first_node, x + 3 * b->first_node, turn};
  for (size_t e = 0; p->beam.framed && e < p->edges; e++) turn[e] = sw_spin_turned(s, b, e);
  if (p->beam.framed) return 1;
  if (p->web || !clamps) return 0;
  memset(turn, 0, p->edges * sizeof *turn);
  SW_ITEMS(const sw_clamp_hinge, h, p->clamps, clamps) {
    if (h->side < 0 && (!first || h->edge < first->edge)) first = h;
    if (h->side > 0 && (!last || h->edge > last->edge)) last = h;
  }
  /* ends that are free; spans come after them */
  if (first) follow(&w, s, first, 0);
  if (last) follow(&w, s, last, p->edges - 1);
  SW_ITEMS(const sw_span, span, p->spans, p->span_count) {
    follow(&w, s, &p->clamps[span->left], span->last);
    share(&w, s, span);
  }
  return 1;
}
