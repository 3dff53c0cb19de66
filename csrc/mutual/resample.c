/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of touches of wires that have got other edges. Where wires cross, a touch is at one place:
 * it stays there. Where they lie along each other, each node stands for a stretch of its wire: a
 * new node takes the force of the former stretches that it covers, so that the sum of the forces
 * stays. */
#include "mutual/resample.h"

#include <math.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "mutual/meet.h"

/* A touch on the former edges. */
typedef struct sample {
  const sw_met *met;
  int side;            /* the wire whose node it is; crossings: 0 */
  double s, there;     /* places along this wire and along the other one [m] */
  double from, to;     /* stretch of this wire that it stands for [m] */
  size_t wire, number; /* former number of this wire; which of its nodes */
} sample;

/* A place on the present edges. */
typedef struct spot {
  uint32_t node, end, body;
  double at;
} spot;

static const sw_body *body_of(const sw_system *s, const sw_pairs_former *of, size_t wire) {
  return &s->bodies[of->now[wire]];
}

static size_t wire_of(const sw_pairs_former *of, size_t node) {
  size_t w = 0, end = of->wires;
  while (end - w > 1) {
    const size_t middle = w + (end - w) / 2;
    if (of->first[middle] <= node)
      w = middle;
    else
      end = middle;
  }
  return w;
}

/* Place along the wire of one side of a touch [m]. */
static double place_of(const sw_pairs_former *of, const sw_met *t, int side) {
  const double a = of->s[t->of.node[side]], b = of->s[t->of.end[side]];
  return a + t->at[side] * (b - a);
}

static spot spot_at(const sw_body *b, size_t body, double s) {
  double at;
  const size_t i = sw_plan_locate(b->plan, s, &at);
  const uint32_t node = (uint32_t)(b->first_node + i);
  return (spot){node, node + 1, (uint32_t)body, at};
}

/* Node i; the last one is the end of the edge before it. */
static spot spot_on(const sw_body *b, size_t body, size_t i) {
  const int last = i + 1 == b->plan->nodes;
  const uint32_t node = (uint32_t)(b->first_node + i - (size_t)last);
  return (spot){node, node + 1, (uint32_t)body, last};
}

/* Adds a touch with a share of the force of a former one, at the same stiffness. */
static sw_status add(sw_mutual *m, const sw_met *from, const spot place[2], double share) {
  if (place[0].node >= place[1].node) return SW_OK;
  SW_TRY(SW_GROW(m->memory, m->memory_capacity, m->memory_count + 1));
  sw_met *t = &m->memory[m->memory_count++];
  *t = *from;
  for (int k = 0; k < 2; k++) {
    t->of.node[k] = place[k].node, t->of.end[k] = place[k].end, t->of.body[k] = place[k].body;
    t->at[k] = place[k].at;
  }
  t->kept.normal_force *= share, t->kept.steady *= share, t->kept.depth *= share;
  t->kept.elastic = sw_scale(t->kept.elastic, share);
  t->kept.edited = 1; /* what the depth is more or less now is due to the edges */
  return SW_OK;
}

/* Lets a touch go on at its places. */
static sw_status stay(sw_mutual *m, const sw_system *s, const sw_pairs_former *of,
                      const sample *x) {
  const size_t other = wire_of(of, x->met->of.node[!x->side]);
  spot place[2];
  place[x->side] = spot_at(body_of(s, of, x->wire), of->now[x->wire], x->s);
  place[!x->side] = spot_at(body_of(s, of, other), of->now[other], x->there);
  return add(m, x->met, place, 1.0);
}

/* --- wires along each other ------------------------------------------------------------------- */

/* Where the other wire is beside s: between the samples, or further along their line [m]. */
static double there_at(const sample *x, size_t count, size_t k, double s) {
  const size_t before = k ? k - 1 : k, after = k + 1 < count ? k + 1 : k;
  const sample *a = &x[s < x[k].s ? before : k], *b = &x[s < x[k].s ? k : after];
  if (a == b) a = &x[before], b = &x[after];
  if (!(b->s > a->s)) return x[k].there;
  return a->there + (s - a->s) / (b->s - a->s) * (b->there - a->there);
}

/* A smaller share of a stretch is none [-]. */
static const double ROUNDING = 1e-9;

/* Adds what a new node, which stands for the wire from `from` to `to`, has of a row's force. first:
 * the first sample that may reach this far. */
static sw_status add_node(sw_mutual *m, const sw_system *s, const sw_pairs_former *of,
                          const sample *x, size_t first, size_t count, size_t i, double from,
                          double to) {
  const sw_body *b = body_of(s, of, x->wire);
  double force = 0;
  size_t near = SIZE_MAX;
  for (size_t k = first; k < count && x[k].from < to; k++) {
    const double covered = fmin(to, x[k].to) - fmax(from, x[k].from);
    if (!(covered > ROUNDING * (x[k].to - x[k].from))) continue;
    force += x[k].met->kept.normal_force * (covered / (x[k].to - x[k].from));
    if (near == SIZE_MAX || fabs(x[k].s - b->plan->s[i]) < fabs(x[near].s - b->plan->s[i]))
      near = k;
  }
  if (!(force > 0)) return SW_OK;
  const int side = x->side;
  const size_t other = wire_of(of, x->met->of.node[!side]);
  const double there = there_at(x, count, near, b->plan->s[i]);
  spot place[2];
  place[side] = spot_on(b, of->now[x->wire], i);
  place[!side] = spot_at(body_of(s, of, other), of->now[other], there);
  return add(m, x[near].met, place, force / x[near].met->kept.normal_force);
}

/* Nodes of a wire beside one other wire, in order. A node beside two places of it, as of a coil
 * that closes on itself, or a single one keeps its places instead. */
static sw_status add_row(sw_mutual *m, const sw_system *s, const sw_pairs_former *of,
                         const sample *x, size_t count) {
  const sw_plan *p = body_of(s, of, x->wire)->plan;
  int row = count > 1;
  for (size_t k = 1; k < count; k++) row = row && x[k].number == x[k - 1].number + 1;
  for (size_t k = 0; !row && k < count; k++) SW_TRY(stay(m, s, of, &x[k]));
  for (size_t i = 0, first = 0; row && i < p->nodes; i++) {
    const size_t a = i > 0 ? i - 1 : i, b = i + 1 < p->nodes ? i + 1 : i;
    const double from = 0.5 * (p->s[a] + p->s[i]), to = 0.5 * (p->s[i] + p->s[b]);
    while (first < count && x[first].to <= from) first++;
    SW_TRY(add_node(m, s, of, x, first, count, i, from, to));
  }
  return SW_OK;
}

static int by_size(double a, double b) { return a < b ? -1 : a > b; }

/* By kind, wires, and place along the wire. */
static int in_rows(const void *p, const void *q) {
  const sample *a = p, *b = q;
  if (a->met->kind != b->met->kind) return a->met->kind < b->met->kind ? -1 : 1;
  for (int k = 0; k < 2; k++)
    if (a->met->of.body[k] != b->met->of.body[k])
      return a->met->of.body[k] < b->met->of.body[k] ? -1 : 1;
  return a->s == b->s ? by_size(a->there, b->there) : by_size(a->s, b->s);
}

static int is_one_row(const sample *a, const sample *b) {
  return a->met->kind == b->met->kind && a->met->of.body[0] == b->met->of.body[0] &&
         a->met->of.body[1] == b->met->of.body[1] && b->number <= a->number + 1;
}

/* --- all -------------------------------------------------------------------------------------- */

/* 1 if the memory's touch presses and is of two lines that are still there, one of which has got
 * other edges. */
static int is_due(const sw_system *s, const sw_pairs_former *of, const sw_met *t) {
  int changed = 0;
  for (int k = 0; k < 2; k++) {
    const size_t w = wire_of(of, t->of.node[k]);
    if (of->now[w] == SIZE_MAX || body_of(s, of, w)->plan->web) return 0;
    if (t->of.end[k] != t->of.node[k] + 1) return 0;
    changed |= of->changed[w];
  }
  return changed && t->kept.normal_force > 0;
}

static sample sample_of(const sw_pairs_former *of, const sw_met *t) {
  const int side = t->kind == SW_NODE_OF_TWO;
  const size_t node = t->of.node[side] + (t->kind != SW_CROSSING && t->at[side] > 0.5);
  const size_t w = wire_of(of, t->of.node[side]);
  const size_t a = node > of->first[w] ? node - 1 : node;
  const size_t b = node + 1 < of->first[w + 1] ? node + 1 : node;
  return (sample){.met = t,
                  .side = side,
                  .s = place_of(of, t, side),
                  .there = place_of(of, t, !side),
                  .from = 0.5 * (of->s[a] + of->s[node]),
                  .to = 0.5 * (of->s[node] + of->s[b]),
                  .wire = w,
                  .number = node};
}

/* Forgets the pressing touches of present bodies whose edges have changed: of lines alone. */
static sw_status forget(sw_mutual *m, const sw_system *s, const sw_pairs_former *of) {
  char *changed SW_LOCAL = sw_alloc(s->body_count + 1, 1);
  size_t kept = 0;
  if (!changed) return SW_ENOMEM;
  for (size_t w = 0; w < of->wires; w++)
    if (of->changed[w] && of->now[w] < s->body_count) changed[of->now[w]] = 1;
  for (size_t i = 0; i < m->memory_count; i++) {
    const sw_met *t = &m->memory[i];
    const uint32_t *b = t->of.body;
    const int lines = !s->bodies[b[0]].plan->web && !s->bodies[b[1]].plan->web;
    const int due = lines && (changed[b[0]] || changed[b[1]]) && t->kept.normal_force > 0;
    if (!due) m->memory[kept++] = *t;
  }
  m->memory_count = kept;
  return SW_OK;
}

sw_status sw_pairs_resample(sw_mutual *m, const sw_system *s, const void *memory, size_t bytes,
                            const sw_pairs_former *of) {
  const sw_met *old = memory;
  const size_t all = bytes / sizeof *old;
  size_t count = 0;
  sample *x = sw_alloc(all + 1, sizeof *x);
  sw_status status = x ? SW_OK : SW_ENOMEM;
  for (size_t i = 0; x && i < all; i++)
    if (is_due(s, of, &old[i])) x[count++] = sample_of(of, &old[i]);
  if (x) status = forget(m, s, of);
  if (count) qsort(x, count, sizeof *x, in_rows);
  for (size_t k = 0, end; k < count && status == SW_OK; k = end) {
    end = k + 1;
    if (x[k].met->kind == SW_CROSSING || !of->changed[x[k].wire]) {
      status = stay(m, s, of, &x[k]);
      continue;
    }
    while (end < count && is_one_row(&x[end - 1], &x[end])) end++;
    status = add_row(m, s, of, &x[k], end - k);
  }
  sw_free(x);
  return status;
}
