/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/wait.h"

#include <math.h>
#include <string.h>

#include "base/each.h"
#include "system/join.h"
#include "system/part.h"

/* A wire came to rest if no node is faster than SLOW [m/s], nor accelerated by more than BALANCED,
 * a billionth of gravity [m/s2]. Wires on a table get there by themselves, down to rounding: 1e-13
 * m/s in steps of 10 ms. */
static const double SLOW = 1e-10, BALANCED = 1e-8;

/* 1 if nothing but the wire's motion and touches can change a term's force. */
static int is_steady(const sw_term *t) {
  return !t->history && !(t->cls->flags & (SW_FORCE_EXPLICIT | SW_FORCE_DRIVEN));
}

/* 1 if the body may wait: a line that nothing holds, with steady forces. The others have unknowns
 * besides their nodes, or reactions. */
static int may_wait(const sw_body *b) {
  if (b->plan->web || b->roll_block || b->spin_block || b->has_twist || b->viscosity > 0) return 0;
  for (size_t i = 0; i < b->plan->nodes; i++)
    if (b->plan->held[i] != SW_FREE) return 0;
  SW_ITEMS(const sw_term, t, b->terms, b->term_count)
    if (!is_steady(t)) return 0;
  return 1;
}

static double largest(const double *values, size_t n) {
  double most = 0;
  for (size_t i = 0; i < n; i++) {
    const double size = fabs(values[i]);
    most = size <= most ? most : size; /* a value that is not a number is the largest */
  }
  return most;
}

void sw_waits_stop(sw_system *s) {
  s->awake = 0;
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    double *v = s->v + 3 * b->first_node, *a = s->a + 3 * b->first_node;
    const size_t n = 3 * b->plan->nodes;
    if (b->waits || b->coupled & SW_JOINED || !(largest(v, n) < SLOW) ||
        !(largest(a, n) < BALANCED) || !may_wait(b))
      continue;
    memset(v, 0, n * sizeof *v);
    memset(a, 0, n * sizeof *a);
  }
}

static int is_zero(const double *values, size_t n) {
  for (size_t i = 0; i < n; i++)
    if (values[i] != 0) return 0;
  return 1;
}

void sw_waits_find(sw_system *s, int may) {
  s->waiting = 0;
  may &= !s->awake;
  for (size_t b = 0; b < s->body_count; b++) s->bodies[b].coupled = 0;
  if (may) sw_joins_mark(s);
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    const size_t at = 3 * b->first_node, n = 3 * b->plan->nodes;
    b->waits = may && !b->coupled && is_zero(s->v + at, n) && is_zero(s->a + at, n) && may_wait(b);
    s->waiting |= b->waits;
    b->weighed &= b->waits;
    may &= !b->plan->web;
  }
  if (may) return;
  s->waiting = 0;
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) b->waits = 0;
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
