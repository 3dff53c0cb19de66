/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/again.h"

#include <string.h>

#include "solve/band3.h"
#include "system/twist.h"

/* Solves besides the first one: each takes less than a sixth of an iterate [-]. */
enum { MOST_AGAIN = 2 };

/* What changes at held nodes goes to what holds them. */
static void hold(sw_system *s, size_t body) {
  for (size_t i = 0; i < s->held_count; i++) {
    sw_held_node *h = &s->held[i];
    if (h->body != body) continue;
    double *more = s->more + 3 * h->node;
    h->own_force = sw_sub(h->own_force, sw_load(more));
    sw_store(more, sw_v(0, 0, 0));
  }
}

static void solve(sw_system *s, size_t body) {
  sw_body *b = &s->bodies[body];
  const size_t n = 3 * b->plan->nodes;
  double *more = s->more + 3 * b->first_node, *delta = s->delta + 3 * b->first_node;
  hold(s, body);
  sw_band3_solve(b->field.rows, b->plan->nodes, more);
  if (b->has_twist) sw_twist_correct_again(b, more);
  for (size_t i = 0; i < n; i++) delta[i] += more[i];
  memset(more, 0, n * sizeof *more);
}

void sw_system_solve_again(sw_system *s) {
  for (int k = 0; k < MOST_AGAIN; k++) {
    if (!s->coupling.follow(s->coupling.user, s, s->delta, s->more)) return;
    for (size_t b = 0; b < s->body_count; b++) {
      if (!s->bodies[b].followed) continue;
      solve(s, b);
      s->bodies[b].followed = 0;
    }
  }
}
