/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes a plan: masses, holds, lengths of hinges, spans between clamps. */
#include "state/plan.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/halving.h"

sw_plan *sw_plan_retain(sw_plan *plan) {
  if (plan) plan->references++;
  return plan;
}

void sw_plan_release(sw_plan *plan) {
  if (!plan || --plan->references > 0) return;
  sw_web_release(plan->web);
  SW_FREE_ALL(plan->s, plan->rest, plan->lumped, plan->mass_own, plan->mass_next, plan->hinge,
              plan->held, plan->clamps, plan->spans, plan->rest_bend, plan->rest_twist,
              plan->drawn_arc, plan);
}

/* Hinge lengths near a clamp whose first edge has length b * l and whose second has l. An end-point
 * quadrature, exact for curvature moments 0, 1 and 2, so that the clamp acts at its arc length and
 * not half a cell inside. Valid for b in [0.5, 1.5); b = 1 gives 5/12 and 13/12. */
static double clamp_hinge_length(double b) { return 0.5 * b - 1.0 / (12.0 * b); }
static double clamp_hinge_slope(double b) { return 0.5 + 1.0 / (12.0 * b * b); }
static double next_hinge_length(double b) { return 0.5 * (1.0 + b) + 1.0 / (12.0 * b); }

/* Hinge length of a clamp with a single edge behind it (a short free stub): exact for a load at the
 * stub's end. */
static const double STUB_HINGE = 1.0 / 3.0; /* of the edge's length [-] */
static const double SMALLEST_RATIO = 0.45;  /* below this b the quadrature fails [-] */

void sw_plan_clamp_lengths(double first, double second, double *clamp, double *next) {
  const double b = second > 0 ? first / second : 0;
  *next = 0.5 * (first + second);
  *clamp = second > 0 ? 0.5 * first : STUB_HINGE * first;
  if (b < SMALLEST_RATIO) return; /* plain half cell, second order only for the average */
  *clamp = clamp_hinge_length(b) * second;
  *next = next_hinge_length(b) * second;
}

/* Returns the node k places from a clamp's own, on the side to which it looks; -1 beyond the wire.
 */
static long node_from(const sw_plan *p, const sw_clamp_hinge *c, long k) {
  const long i = (long)c->node + k * c->side;
  return i < (long)p->nodes ? i : -1;
}

/* Sets the length of the clamp's own hinge and adds its part to the next one. */
static void size_clamp(sw_plan *p, sw_clamp_hinge *c) {
  const long near = node_from(p, c, 1), far = node_from(p, c, 2);
  const double first = p->rest[c->edge];
  if (far < 0) {
    c->length = STUB_HINGE * first;
    return;
  }
  const double l = p->rest[c->side > 0 ? c->edge + 1 : c->edge - 1];
  const double b = first / l;
  if (b < SMALLEST_RATIO) { /* plain half cell, second order only for the average */
    c->length = 0.5 * first;
    return;
  }
  c->length = clamp_hinge_length(b) * l;
  p->hinge[near] += next_hinge_length(b) * l - 0.5 * (first + l);
}

double sw_plan_clamp_growth(const sw_plan *p, const sw_clamp_hinge *c) {
  if (node_from(p, c, 2) < 0) return STUB_HINGE / c->length;
  const double b = p->rest[c->edge] / p->rest[c->side > 0 ? c->edge + 1 : c->edge - 1];
  return (b < SMALLEST_RATIO ? 0.5 : clamp_hinge_slope(b)) / c->length;
}

/* Least share of each hinge that is kept: a hinge that hardly turns would be very stiff [-]. */
static const double LEAST_HINGE = 1.0 / 30.0;

/* The bending wire begins further out than the clamp: shortens the hinges from there on. */
static void shorten(sw_plan *p, sw_clamp_hinge *c, double by) {
  double cut = fmin(by, (1.0 - LEAST_HINGE) * c->length); /* all of a negative length */
  c->length -= cut;
  for (long k = 1; by - cut > 0; k++) {
    const long i = node_from(p, c, k);
    if (i < 0 || p->held[i] != SW_FREE) return;
    by -= cut;
    cut = fmin(by, (1.0 - LEAST_HINGE) * p->hinge[i]);
    p->hinge[i] -= cut;
  }
}

static void add_clamp(sw_plan *p, size_t node, int side, int hold, const sw_clamp_give *give) {
  if (side > 0 ? node + 1 == p->nodes : node == 0) return;
  const size_t edge = side > 0 ? node : node - 1;
  const size_t next = side > 0 ? node + 1 : node - 1;
  if (p->held[next] != SW_FREE) return; /* a rigid edge inside the grasped region */
  sw_clamp_hinge *c = &p->clamps[p->clamp_count++];
  *c = (sw_clamp_hinge){.node = node, .edge = edge, .side = side, .hold = hold};
  size_clamp(p, c);
  shorten(p, c, give->shorter);
  c->softer = give->softer, c->twist = give->twist;
}

static void set_mass(sw_plan *p, size_t i) {
  const double before = i > 0 ? p->beam.mass * (p->s[i] - p->s[i - 1]) : 0.0;
  const double after = i < p->edges ? p->beam.mass * (p->s[i + 1] - p->s[i]) : 0.0;
  p->lumped[i] = 0.5 * before + 0.5 * after;
  p->mass_own[i] = before / 3.0 + after / 3.0;
  if (i < p->edges) p->mass_next[i] = after / 6.0;
}

size_t sw_plan_first(const sw_plan *p, double s) {
  size_t i;
  SW_FIRST_NOT(p->s[i] < s, i, 0, p->nodes);
  return i;
}

static void set_holds(sw_plan *p, const sw_hold_place *holds, size_t count) {
  for (size_t k = 0; k < count; k++)
    for (size_t i = sw_plan_first(p, holds[k].s1);
         holds[k].clamped != SW_STOPS && i < p->nodes && p->s[i] <= holds[k].s2; i++)
      p->held[i] = SW_HELD;
  for (size_t i = 1; i + 1 < p->nodes; i++) p->hinge[i] = 0.5 * (p->rest[i - 1] + p->rest[i]);
  for (size_t k = 0; k < count; k++) {
    if (!holds[k].clamped || holds[k].clamped == SW_STOPS) continue;
    for (size_t i = sw_plan_first(p, holds[k].s1); i < p->nodes && p->s[i] <= holds[k].s2; i++) {
      p->hinge[i] = 0.0;
      if (p->s[i] == holds[k].s1) add_clamp(p, i, -1, holds[k].hold, &holds[k].give[0]);
      if (p->s[i] == holds[k].s2) add_clamp(p, i, +1, holds[k].hold, &holds[k].give[1]);
    }
  }
}

static int is_clamped(const sw_plan *p, size_t node) {
  for (size_t c = 0; c < p->clamp_count; c++)
    if (p->clamps[c].node == node) return 1;
  return 0;
}

/* Adds the ends of spans at joints, on both sides. After the last clamp. */
static void set_stops(sw_plan *p, const sw_hold_place *holds, size_t count) {
  for (size_t k = 0; k < count; k++) {
    const size_t i = sw_plan_first(p, holds[k].s1);
    if (holds[k].clamped != SW_STOPS || is_clamped(p, i)) continue;
    for (int side = -1; side <= 1; side += 2) {
      if (side > 0 ? i + 1 == p->nodes : i == 0) continue;
      const size_t edge = side > 0 ? i : i - 1;
      if (p->held[edge] != SW_FREE && p->held[edge + 1] != SW_FREE) continue; /* inside a grip */
      p->clamps[p->clamp_count + p->stops++] =
          (sw_clamp_hinge){.node = i, .edge = edge, .side = side, .hold = holds[k].hold};
    }
  }
}

/* Returns the nearest clamp hinge or stop, at an edge from `from` on, that looks to this side, or
 * their number. */
static size_t next_clamp(const sw_plan *p, int side, size_t from) {
  const size_t count = p->clamp_count + p->stops;
  size_t best = count;
  for (size_t c = 0; c < count; c++) {
    if (p->clamps[c].side != side || p->clamps[c].edge < from) continue;
    if (best == count || p->clamps[c].edge < p->clamps[best].edge) best = c;
  }
  return best;
}

/* Length between its clamps, with their give. */
static double span_length(const sw_plan *p, const sw_span *span) {
  const double length = p->s[span->last + 1] - p->s[span->first];
  const double give = p->clamps[span->left].twist + p->clamps[span->right].twist;
  return fmax(length + give, LEAST_HINGE * length);
}

static void set_spans(sw_plan *p) {
  const size_t none = p->clamp_count + p->stops;
  for (size_t e = 0; e < p->edges; e++) {
    const size_t left = next_clamp(p, 1, e);
    if (left == none) return;
    e = p->clamps[left].edge;
    const size_t right = next_clamp(p, -1, e);
    if (right == none) return;
    const size_t last = p->clamps[right].edge;
    sw_span *span = &p->spans[p->span_count++];
    *span = (sw_span){.first = e, .last = last, .left = left, .right = right};
    span->length = span_length(p, span);
  }
}

/* Makes a plan with room for n nodes and all that belongs to this many holds. */
static sw_plan *new_plan(const sw_beam *beam, size_t n, size_t edges, size_t holds) {
  sw_plan *p = sw_alloc(1, sizeof *p);
  if (!p) return NULL;
  *p = (sw_plan){.references = 1, .nodes = n, .edges = edges, .beam = *beam};
  if (SW_ALLOC_ALL(SW_ROOM(p->s, n), SW_ROOM(p->rest, n), SW_ROOM(p->lumped, n),
                   SW_ROOM(p->mass_own, n), SW_ROOM(p->mass_next, n), SW_ROOM(p->hinge, n),
                   SW_ROOM(p->held, n), SW_ROOM(p->clamps, 2 * holds + 1),
                   SW_ROOM(p->spans, holds + 1)) == SW_OK)
    return p;
  sw_plan_release(p);
  return NULL;
}

sw_status sw_plan_new(const sw_beam *beam, const double *s, size_t n, const sw_hold_place *holds,
                      size_t hold_count, sw_plan **out) {
  sw_plan *p = new_plan(beam, n, n - 1, hold_count);
  if (!p) return SW_ENOMEM;
  p->length = s[n - 1] - s[0];
  memcpy(p->s, s, n * sizeof *s);
  for (size_t e = 0; e < p->edges; e++) p->rest[e] = s[e + 1] - s[e];
  for (size_t i = 0; i < n; i++) set_mass(p, i);
  set_holds(p, holds, hold_count);
  set_stops(p, holds, hold_count);
  set_spans(p);
  *out = p;
  return SW_OK;
}

sw_status sw_plan_of_web(const sw_beam *beam, sw_web *web, const int *held, sw_plan **out) {
  sw_plan *p = new_plan(beam, web->particles, 0, 0);
  if (!p) return SW_ENOMEM;
  p->web = sw_web_retain(web);
  p->length = web->per_ring ? web->s[web->particles - 1] - web->s[0] : web->length;
  for (size_t i = 0; i < web->particles; i++) {
    p->s[i] = web->s[i];
    p->lumped[i] = p->mass_own[i] = web->mass[i];
    p->held[i] = held[i];
  }
  *out = p;
  return SW_OK;
}

double sw_plan_spacing(const sw_plan *p) {
  const sw_web *web = p->web;
  double shortest = HUGE_VAL;
  for (size_t e = 0; e < p->edges; e++) shortest = fmin(shortest, p->rest[e]);
  if (!web) return shortest;
  for (size_t e = 0; !web->per_ring && e < web->links; e++)
    shortest = fmin(shortest, web->link[e].rest);
  return web->rings > 1 ? fmin(shortest, p->length / (double)(web->rings - 1)) : shortest;
}

double sw_plan_lever(const sw_plan *p) {
  return p->web && p->web->rings > 1 ? p->beam.radius : 0.0;
}

void sw_plan_slide(sw_plan *p, size_t node, double s, const double spare[2]) {
  const size_t from = node > 0 ? node - 1 : 0, to = node + 1 < p->nodes ? node + 1 : node;
  p->s[node] = s;
  p->length = p->s[p->nodes - 1] - p->s[0];
  for (size_t e = from; e < to; e++) p->rest[e] = p->s[e + 1] - p->s[e] + spare[e == node];
  for (size_t i = from; i <= to; i++) {
    set_mass(p, i);
    if (i > 0 && i < p->edges && p->held[i] == SW_FREE)
      p->hinge[i] = 0.5 * (p->rest[i - 1] + p->rest[i]);
  }
  for (size_t c = 0; c < p->clamp_count; c++) {
    const long next = node_from(p, &p->clamps[c], 1);
    if (next == (long)from || next == (long)to) size_clamp(p, &p->clamps[c]);
  }
  for (size_t k = 0; k < p->span_count; k++) p->spans[k].length = span_length(p, &p->spans[k]);
}

sw_status sw_plan_add_rest(sw_plan *plan) {
  const size_t n = plan->nodes + plan->clamp_count;
  plan->rest_bend = sw_alloc(2 * n, sizeof *plan->rest_bend);
  plan->rest_twist = sw_alloc(n, sizeof *plan->rest_twist);
  return plan->rest_bend && plan->rest_twist ? SW_OK : SW_ENOMEM;
}

size_t sw_plan_locate(const sw_plan *plan, double s, double *fraction) {
  const size_t *first = plan->web ? plan->web->first : NULL;
  size_t after;
  const size_t to = plan->web ? plan->web->rings - 1 : plan->edges;
  SW_FIRST_NOT(plan->s[first ? first[after] : after] <= s, after, 1, to);
  const size_t at = after - 1;
  const double from = plan->s[first ? first[at] : at];
  const double apart = plan->s[first ? first[at + 1] : at + 1] - from;
  /* not by the rest length: beside a feed it exceeds the arc by the length still inside the feed */
  *fraction = fmin(1.0, fmax(0.0, (s - from) / apart));
  return at;
}

size_t sw_plan_shape(const sw_plan *p, const sw_web_solid *e) {
  int free[2] = {0, 0};
  if (!p->web->clamped_shapes) return e->shape;
  for (uint32_t i = 0; i < e->count; i++) free[2 * i >= e->count] |= p->held[e->node[i]] == SW_FREE;
  return e->shape + (free[0] != free[1] ? p->web->clamped_shapes : 0);
}
