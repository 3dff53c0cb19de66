/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics: the held nodes' remaining distance in the equations, and repeated solves of touching
 * wires. */
#include "base/each.h"
#include "system/stage_parts.h"

/* Largest number of repeated solves at one place while touches come and go. */
enum { MOST_WAITS = 40 };
/* Largest number of shortened updates; solves that converge need up to 7. */
enum { MOST_SHORTENED = 16 };

static int is_led(const sw_system *s, const sw_held_node *h) {
  return !s->bodies[h->body].plan->web && !h->rail;
}

void sw_lead_begin(sw_system *s, const sw_stage *stage) {
  for (size_t i = 0; i < s->held_count; i++) {
    const size_t at = 3 * s->held[i].node;
    if (is_led(s, &s->held[i])) sw_store(stage->y + at, sw_load(stage->xhat + at));
  }
}

static sw_vec way_of(const sw_system *s, const sw_held_node *h, const double *y) {
  return sw_sub(sw_load(s->yhat + 3 * h->node), sw_load(y + 3 * h->node));
}

/* right -= u' d */
static void take_block(double *right, const double *u, sw_vec d) {
  right[0] -= u[0] * d.x + u[3] * d.y + u[6] * d.z;
  right[1] -= u[1] * d.x + u[4] * d.y + u[7] * d.z;
  right[2] -= u[2] * d.x + u[5] * d.y + u[8] * d.z;
}

void sw_lead_rows(sw_system *s, const double *y) {
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    const sw_body *b = &s->bodies[h->body];
    const size_t i = h->node - b->first_node, n = b->plan->nodes;
    const sw_vec d = way_of(s, h, y);
    double *right = s->delta + 3 * h->node;
    if (!is_led(s, h) || !(sw_norm2(d) > 0)) continue;
    if (i >= 2) take_block(right - 6, h->saved, d);
    if (i >= 1) take_block(right - 3, h->saved + 9, d);
    if (i + 1 < n) take_block(right + 3, h->saved + 18, d);
    if (i + 2 < n) take_block(right + 6, h->saved + 27, d);
  }
  for (size_t k = 0; k < s->held_count; k++)
    if (is_led(s, &s->held[k])) sw_store(s->delta + 3 * s->held[k].node, sw_v(0, 0, 0));
}

void sw_lead_update(sw_system *s, const double *y) {
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    if (is_led(s, h)) sw_store(s->delta + 3 * h->node, way_of(s, h, y));
  }
}

/* 1 if there are only wires, and something to touch. */
static int wires_touch(const sw_system *s) {
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].plan->web) return 0;
  return s->coupling.settled != NULL;
}

int sw_lead_waits(sw_system *s, const sw_newton *newton, const double *y, double share,
                  int *waits) {
  if (newton->statics && *waits < MOST_WAITS && wires_touch(s)) {
    s->rough = share < 1.0 ? SW_NOT_MADE : SW_MAY_BE_MADE;
    ++*waits;
    if (!s->coupling.settled(s->coupling.user, s, y, s->delta)) return 1;
  }
  s->rough = 0;
  *waits = 0;
  return 0;
}

int sw_lead_fails(const sw_system *s, const sw_newton *newton, int far, int shortened) {
  const int lost = newton->most_far && far > newton->most_far;
  return newton->statics && (lost || shortened > MOST_SHORTENED) && wires_touch(s);
}
