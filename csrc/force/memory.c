/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluates and commits a wire's slipping hinges, and carries their slip to another plan. */
#include "force/memory.h"

#include <math.h>

#include "force/slip.h"

enum { SLOT = 6, FIRST = 1 };
/* Share of the slip that reduces cautious stiffness: iterations overshoot a kink at most twofold
 * [-]. */
static const double CAUTIOUS_SHARE = 0.5;

size_t sw_memory_size(const sw_plan *p) { return FIRST + SLOT * (p->nodes + p->clamp_count); }

static sw_slip_memory load(const double *history, size_t slot) {
  const double *at = history + FIRST + SLOT * slot;
  return (sw_slip_memory){sw_load(at), sw_load(at + 3)};
}

static void store(double *history, size_t slot, const sw_slip_memory *m) {
  double *at = history + FIRST + SLOT * slot;
  sw_store(at, m->slipped);
  sw_store(at + 3, m->along);
}

static sw_slip_law law_of(const sw_memory_law *law, double length) {
  return (sw_slip_law){law->stiffness / length, law->own / length, law->hardening / length,
                       law->limit};
}

/* Returns the hinge of a node. At the wire's ends both tangents are those of the only edge. */
static sw_slip_hinge node_hinge(const sw_field *f, size_t i) {
  const size_t before = i > 0 ? i - 1 : 0, after = i < f->plan->edges ? i : i - 1;
  return (sw_slip_hinge){{sw_field_tangent(f, before), sw_field_tangent(f, after)},
                         {f->reciprocal[before], f->reciprocal[after]}};
}

static sw_slip_hinge clamp_hinge(const sw_field *f, const sw_clamp_hinge *c) {
  const sw_vec d = sw_vec_at(f->hold_directors, sw_clamp_place(c));
  const sw_vec t = sw_field_tangent(f, c->edge);
  const double r = f->reciprocal[c->edge];
  if (c->side > 0) return (sw_slip_hinge){{d, t}, {0, r}};
  return (sw_slip_hinge){{t, d}, {r, 0}};
}

static void add_edge(sw_field *f, size_t e, const sw_slip_answer *a, int side) {
  if (f->want & SW_WANT_FORCE) sw_field_add_gradient(f, e, a->gradient[side]);
  if (f->want & SW_WANT_STIFFNESS)
    for (int k = 0; k < 6; k++) f->own[k][e] += a->own[side][k];
}

static void add_energy(sw_field *f, const sw_slip_answer *a) {
  f->energy += a->energy;
  f->bending += a->elastic;
}

/* 1 if nothing has slipped and the hinge is bent too little to slip: phi <= pi sin(phi/2). */
static int is_idle(const sw_slip_law *law, const sw_slip_memory *m, const sw_slip_hinge *h) {
  if (law->own > 0 || sw_norm2(m->slipped) > 0) return 0;
  return 0.5 * M_PI * law->k * sw_dist(h->t[0], h->t[1]) <= law->limit;
}

void sw_memory_eval(const sw_memory_law *law, sw_field *f) {
  const sw_plan *p = f->plan;
  const double share = f->cautious ? CAUTIOUS_SHARE : 1.0;
  sw_slip_answer a;
  for (size_t i = 1; i + 1 < p->nodes; i++) {
    if (!(p->hinge[i] > 0)) continue;
    const sw_slip_law one = law_of(law, p->hinge[i]);
    const sw_slip_memory m = load(f->history, i);
    const sw_slip_hinge h = node_hinge(f, i);
    if (is_idle(&one, &m, &h)) continue;
    sw_slip_eval(&one, &m, &h, f->want, share, &a);
    add_edge(f, i - 1, &a, 0);
    add_edge(f, i, &a, 1);
    add_energy(f, &a);
    if (f->want & SW_WANT_STIFFNESS)
      for (int k = 0; k < 9; k++) f->next[k][i] += a.next[k];
  }
  for (size_t c = 0; c < p->clamp_count; c++) {
    const sw_slip_law one = law_of(law, p->clamps[c].length);
    const sw_slip_memory m = load(f->history, p->nodes + c);
    const sw_slip_hinge h = clamp_hinge(f, &p->clamps[c]);
    sw_slip_eval(&one, &m, &h, f->want, share, &a);
    add_edge(f, p->clamps[c].edge, &a, p->clamps[c].side > 0);
    add_energy(f, &a);
  }
}

void sw_memory_commit(const sw_memory_law *law, const sw_field *f, double *history) {
  const sw_plan *p = f->plan;
  for (size_t i = 0; i < p->nodes + p->clamp_count; i++) {
    const int at_clamp = i >= p->nodes;
    const sw_clamp_hinge *c = at_clamp ? &p->clamps[i - p->nodes] : NULL;
    const double length = at_clamp ? c->length : p->hinge[i];
    const sw_slip_hinge h = at_clamp ? clamp_hinge(f, c) : node_hinge(f, i);
    const int bends = at_clamp || (i > 0 && i + 1 < p->nodes && length > 0);
    const sw_slip_law one = bends ? law_of(law, length) : (sw_slip_law){0};
    sw_slip_memory m = load(history, i);
    history[0] += sw_slip_commit(bends ? &one : NULL, &h, &m);
    store(history, i, &m);
  }
}

static void eval_clamp(const sw_memory_law *law, const sw_field *f, const sw_clamp_hinge *c,
                       sw_slip_answer *out) {
  const sw_slip_law one = law_of(law, c->length);
  const sw_slip_memory m = load(f->history, f->plan->nodes + (size_t)(c - f->plan->clamps));
  const sw_slip_hinge h = clamp_hinge(f, c);
  sw_slip_eval(&one, &m, &h, SW_WANT_FORCE, 1.0, out);
}

/* Returns the couple that the hinge's gradient exerts on its edge. */
sw_vec sw_memory_clamp_moment(const sw_memory_law *law, const sw_field *f,
                              const sw_clamp_hinge *c) {
  sw_slip_answer a;
  eval_clamp(law, f, c, &a);
  const sw_vec edge = sw_scale(sw_field_tangent(f, c->edge), f->length[c->edge]);
  return sw_cross(a.gradient[c->side > 0], edge);
}

double sw_memory_clamp_energy(const sw_memory_law *law, const sw_field *f,
                              const sw_clamp_hinge *c) {
  sw_slip_answer a;
  eval_clamp(law, f, c, &a);
  return a.energy;
}

/* --- another plan ------------------------------------------------------------ */

/* Returns the length of the clamp hinge on one side of a node, or 0. */
static double clamp_length(const sw_plan *p, size_t node, int side) {
  for (size_t c = 0; c < p->clamp_count; c++)
    if (p->clamps[c].node == node && p->clamps[c].side == side) return p->clamps[c].length;
  return 0;
}

/* Finds the stretch of wire whose bending a slot holds. The stretches of all hinges and clamp
 * hinges lie one after another. */
static void stretch_of(const sw_plan *p, size_t slot, double *from, double *to) {
  if (slot >= p->nodes) {
    const sw_clamp_hinge *c = &p->clamps[slot - p->nodes];
    *from = c->side > 0 ? p->s[c->node] : p->s[c->node] - c->length;
    *to = *from + c->length;
    return;
  }
  const size_t i = slot;
  *from = *to = p->s[i];
  if (i > 0 && !(clamp_length(p, i, -1) > 0)) {
    const double cut = clamp_length(p, i - 1, +1);
    *from = cut > 0 ? p->s[i - 1] + cut : 0.5 * (p->s[i - 1] + p->s[i]);
  }
  if (i + 1 < p->nodes && !(clamp_length(p, i, +1) > 0)) {
    const double cut = clamp_length(p, i + 1, -1);
    *to = cut > 0 ? p->s[i + 1] - cut : 0.5 * (p->s[i] + p->s[i + 1]);
  }
}

static const double SAME = 1e-9; /* rounding of a stretch's ends, over its length [-] */

/* Sums the old plan's slipped angle between two arc lengths, in the plane across b. */
static sw_slip_memory collect(const sw_plan *old, const double *history, double from, double to,
                              sw_vec b) {
  sw_slip_memory sum = {sw_v(0, 0, 0), b};
  for (size_t k = 0; k < old->nodes + old->clamp_count; k++) {
    double lo, hi;
    stretch_of(old, k, &lo, &hi);
    const double length = hi - lo, shared = fmin(hi, to) - fmax(lo, from);
    if (!(length > 0) || !(shared > SAME * length)) continue;
    const sw_slip_memory m = load(history, k);
    if (fabs(lo - from) + fabs(hi - to) <= SAME * length) return m;
    const sw_vec here = sw_slip_carry(m.slipped, m.along, b);
    sum.slipped = sw_madd(sum.slipped, here, shared / length);
  }
  return sum;
}

void sw_memory_inherit(const sw_plan *old, const double *from, const sw_field *f, double *history) {
  const sw_plan *p = f->plan;
  history[0] = from[0];
  for (size_t i = 0; i < p->nodes + p->clamp_count; i++) {
    double lo, hi;
    stretch_of(p, i, &lo, &hi);
    const sw_vec b = i < p->nodes ? sw_add(node_hinge(f, i).t[0], node_hinge(f, i).t[1])
                                  : sw_field_tangent(f, p->clamps[i - p->nodes].edge);
    const sw_slip_memory m = collect(old, from, lo, hi, sw_unit_or(b, sw_v(1, 0, 0)));
    store(history, i, &m);
  }
}
