/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contact/spot.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* Solves for friction in an iterate: where hundreds of touches wedge each other each one takes off
 * a third of what is left, and a solve costs a tenth of a factor. Where one leaves more than ENOUGH
 * of what is off, friction that presses its own touches goes to and fro: there is no further
 * one [-]. */
enum { MOST_FOLLOW = 8 };
static const double ENOUGH = 0.8;

void sw_spots_free(sw_spots *g) {
  sw_free(g->list);
  sw_free(g->more);
}

void sw_spots_add(sw_spots *g, const sw_system *s, const uint32_t body[2], sw_spot spot) {
  if (!sw_press_slides(spot.press, spot.friction)) return;
  for (int i = 0; i < spot.count; i++) {
    const sw_body *b = &s->bodies[body[i / 2]];
    spot.held[i] = b->plan->held[spot.node[i] - b->first_node] != SW_FREE;
  }
  if (sw_grow((void **)&g->list, &g->capacity, g->count + 1, sizeof *g->list) == SW_OK)
    g->list[g->count++] = spot;
}

static sw_vec shift_of(const sw_spot *t, const double *delta) {
  sw_vec sum = sw_v(0, 0, 0);
  for (int i = 0; i < t->count; i++) sum = sw_madd(sum, sw_vec_at(delta, t->node[i]), t->weight[i]);
  return sum;
}

static int lags(const sw_spots *g, const double *delta) {
  for (size_t i = 0; i < g->count; i++) {
    const sw_spot *t = &g->list[i];
    if (sw_press_lags(t->press, t->friction, shift_of(t, delta), t->scale)) return 1;
  }
  return 0;
}

/* How far normal forces are from those that friction took as given [N]. */
static double off(const sw_spots *g, const double *delta) {
  double sum = 0;
  for (size_t i = 0; i < g->count; i++) {
    const sw_spot *t = &g->list[i];
    sum += sw_press_off(t->press, t->friction, shift_of(t, delta));
  }
  return sum;
}

static void push(sw_system *s, const sw_spot *t, sw_vec f, double *more) {
  for (int i = 0; i < t->count; i++) {
    const sw_vec part = sw_scale(f, t->weight[i]);
    if (t->held[i])
      sw_system_push_held(s, t->node[i], part);
    else
      sw_accumulate(more + 3 * t->node[i], part);
  }
}

/* back: friction is that of the iterate's first solve again. */
static void follow(sw_spots *g, sw_system *s, int back) {
  memset(g->more, 0, 3 * s->nodes * sizeof *g->more);
  for (size_t i = 0; i < g->count; i++) {
    const sw_spot *t = &g->list[i];
    const sw_vec f = back ? sw_press_unfollow(t->press, t->friction)
                          : sw_press_follow(t->press, t->friction, shift_of(t, s->delta));
    if (sw_norm2(f) > 0) push(s, t, f, g->more);
  }
  sw_bridges_solve_again(s, g->more);
  for (size_t i = 0; i < 3 * s->nodes; i++) s->delta[i] += g->more[i];
}

void sw_spots_follow(sw_spots *g, sw_system *s) {
  if (!sw_bridges_solves_again(s) || !lags(g, s->delta)) return;
  if (sw_grow((void **)&g->more, &g->room, 3 * s->nodes, sizeof *g->more) != SW_OK) return;
  double before = off(g, s->delta);
  for (int k = 0; k < MOST_FOLLOW && lags(g, s->delta); k++) {
    follow(g, s, 0);
    const double after = off(g, s->delta);
    if (k == 0 && !(after <= before)) {
      follow(g, s, 1);
      break;
    }
    if (!(after <= ENOUGH * before)) break;
    before = after;
  }
  sw_bridges_take_solution(s);
}
