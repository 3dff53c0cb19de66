/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds wires at rest and keeps them out of the solve. */
#include "system/wait.h"

#include <math.h>
#include <string.h>

#include "base/each.h"

/* A wire is at rest if no node is faster than SLOW [m/s], nor accelerated by more than BALANCED, a
 * billionth of gravity [m/s2]. Wires on a table come to rest down to rounding: 1e-13 m/s in steps
 * of 10 ms. */
static const double SLOW = 1e-10, BALANCED = 1e-8;

/* 1 if only the wire's motion and touches change the term's force. */
static int is_steady(const sw_term *t) {
  return !t->history && !(t->cls->flags & (SW_FORCE_EXPLICIT | SW_FORCE_DRIVEN));
}

static const sw_held_node *held_at(const sw_system *s, size_t number) {
  return number ? &s->held[number - 1] : NULL;
}

/* 1 if the body may wait: a line with steady forces, whose holds stand. Webs and wires with spins
 * have more unknowns than their nodes. */
static int may_wait(const sw_system *s, const sw_body *b) {
  if (b->plan->web || b->roll_block || b->spin_block) return 0;
  for (const sw_held_node *h = held_at(s, b->held); h; h = held_at(s, h->next))
    if (!s->standing[h->hold].stands) return 0;
  SW_ITEMS(const sw_term, t, b->terms, b->term_count)
    if (!is_steady(t)) return 0;
  return 1;
}

/* Copies a body's part of arrays of strains: of its edges, at its clamps, of held nodes. from NULL:
 * zeros. */
static void copy_strains(const sw_system *s, const sw_body *b, const double *from, double *to) {
  const size_t at[2] = {b->first_edge, b->first_clamp};
  const size_t count[2] = {sw_plan_axial(b->plan), 3 * b->kept_clamps};
  for (int k = 0; k < 2; k++)
    for (size_t i = at[k]; i < at[k] + count[k]; i++) to[i] = from ? from[i] : 0.0;
  for (const sw_held_node *h = held_at(s, b->held); h; h = held_at(s, h->next))
    for (size_t c = 0; h->kept && c < 3; c++) to[h->kept + c] = from ? from[h->kept + c] : 0.0;
}

static double largest(const double *values, size_t n) {
  double most = 0;
  for (size_t i = 0; i < n; i++) {
    const double size = fabs(values[i]);
    most = size <= most ? most : size; /* NaN counts as the largest */
  }
  return most;
}

int sw_waits_stopping(sw_system *s) {
  int any = 0;
  s->awake = 0;
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    const double *v = s->v + 3 * b->first_node, *a = s->a + 3 * b->first_node;
    const size_t n = 3 * b->plan->nodes;
    b->stops = !b->waits && largest(v, n) < SLOW && largest(a, n) < BALANCED && may_wait(s, b);
    any |= b->stops;
  }
  return any;
}

void sw_waits_stop(sw_system *s) {
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    const size_t at = 3 * b->first_node, size = 3 * b->plan->nodes * sizeof *s->v;
    if (!b->stops) continue;
    memset(s->v + at, 0, size);
    memset(s->a + at, 0, size);
    if (s->strain) copy_strains(s, b, NULL, s->strain_rate);
  }
}

static int is_zero(const double *values, size_t n) {
  for (size_t i = 0; i < n; i++)
    if (values[i] != 0) return 0;
  return 1;
}

static int is_straining(const sw_system *s, const sw_body *b) {
  if (!s->strain) return 0;
  for (const sw_held_node *h = held_at(s, b->held); h; h = held_at(s, h->next))
    if (h->kept && !is_zero(s->strain_rate + h->kept, 3)) return 1;
  return !is_zero(s->strain_rate + b->first_edge, sw_plan_axial(b->plan)) ||
         !is_zero(s->strain_rate + b->first_clamp, 3 * b->kept_clamps);
}

static int rests(const sw_system *s, const sw_body *b) {
  const size_t at = 3 * b->first_node, n = 3 * b->plan->nodes;
  return is_zero(s->v + at, n) && is_zero(s->a + at, n) && !is_straining(s, b);
}

void sw_waits_find(sw_system *s, int may) {
  s->waiting = 0;
  may &= !s->awake;
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    b->waits = may && rests(s, b) && may_wait(s, b);
    s->waiting |= b->waits;
    b->weighed &= b->waits;
    may &= !b->plan->web;
  }
  if (may) return;
  s->waiting = 0;
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) b->waits = 0;
}

int sw_waits_are(const sw_system *s, const unsigned char *flags) {
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].waits != flags[b]) return 0;
  return 1;
}

void sw_waits_place(const sw_system *s, const sw_stage *stage) {
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    const size_t at = 3 * b->first_node, n = 3 * b->plan->nodes;
    if (b->waits) memcpy(stage->y + at, s->x + at, n * sizeof *s->x);
  }
}

void sw_waits_finish(const sw_system *s, const sw_stage *stage) {
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    const size_t at = 3 * b->first_node, n = 3 * b->plan->nodes;
    if (!b->waits) continue;
    memset(stage->v + at, 0, n * sizeof *s->v);
    if (stage->a) memset(stage->a + at, 0, n * sizeof *s->a);
  }
}

void sw_waits_strain(const sw_system *s, double *guess) {
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count)
    if (b->waits) copy_strains(s, b, s->strain, guess);
}

void sw_waits_strain_rate(const sw_system *s, double *rate) {
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count)
    if (b->waits) copy_strains(s, b, NULL, rate);
}
