/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches in the equations (spot.h): iterates friction until it agrees with the normal forces. */
#include "touch/spot.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* Most solves for friction in an iterate; one costs a tenth of a factor. With 2 and 8, twenty
 * falling wires need 1.1 to 1.2 times the factors [-]. */
enum { MOST_FOLLOW = 4 };
/* A direction of which less than this share is left after removing earlier directions is rounding
 * [-]. */
static const double NOTHING_NEW = 1e-6;

void sw_spots_free(sw_spots *g) {
  sw_free(g->list);
  sw_free(g->more);
  sw_free(g->mixed);
}

/* Adds a place's nodes with their shares. */
static void add_place(sw_spot *spot, const sw_body *b, const sw_mean *at, double sign) {
  for (uint32_t i = 0; i < at->count; i++, spot->count++) {
    spot->node[spot->count] = at->node[i];
    spot->weight[spot->count] = sign * at->w[i];
    spot->held[spot->count] = b->plan->held[at->node[i] - b->first_node] != SW_FREE;
  }
}

sw_spot *sw_spots_add(sw_spots *g, const sw_system *s, sw_spot spot, const sw_mean *one,
                      size_t body_one, const sw_mean *two, size_t body_two) {
  if (!sw_press_slides(spot.press, spot.friction)) return NULL;
  add_place(&spot, &s->bodies[body_one], one, 1.0);
  if (two) add_place(&spot, &s->bodies[body_two], two, -1.0);
  if (SW_GROW(g->list, g->capacity, g->count + 1) != SW_OK) return NULL;
  g->list[g->count] = spot;
  return &g->list[g->count++];
}

static sw_vec shift_of(const sw_spot *t, const double *delta) {
  sw_vec sum = sw_v(0, 0, 0);
  for (int i = 0; i < t->count; i++) sum = sw_madd(sum, sw_vec_at(delta, t->node[i]), t->weight[i]);
  for (int i = 0; i < t->count && t->turns; i++)
    sum = sw_madd(sum, t->lever[i], sw_dot(t->press->normal, sw_vec_at(delta, t->node[i])));
  sum = sw_madd(sum, t->eases, -sw_dot(t->eases, sum));
  return sum;
}

static int lags(const sw_spots *g, const double *delta) {
  for (size_t i = 0; i < g->count; i++) {
    const sw_spot *t = &g->list[i];
    if (sw_press_lags(t->press, t->friction, shift_of(t, delta), t->scale)) return 1;
  }
  return 0;
}

static void push(sw_system *s, const sw_spot *t, sw_vec f, double *more) {
  for (int i = 0; i < t->count; i++) {
    sw_vec part = sw_scale(f, t->weight[i]);
    if (t->turns) part = sw_madd(part, t->press->normal, sw_dot(t->lever[i], f));
    if (t->held[i])
      sw_system_push_held(s, t->node[i], part);
    else
      sw_accumulate(more + 3 * t->node[i], part);
  }
}

/* Changes the normal forces used in friction to `forces`, or (NULL) back to those of the iterate's
 * first solve, and the solution with them. */
static void assume(sw_spots *g, sw_system *s, const double *forces) {
  memset(g->more, 0, 3 * s->nodes * sizeof *g->more);
  for (size_t i = 0; i < g->count; i++) {
    const sw_spot *t = &g->list[i];
    const sw_vec f = forces ? sw_press_assume(t->press, t->friction, forces[i])
                            : sw_press_unfollow(t->press, t->friction);
    if (sw_norm2(f) > 0) push(s, t, f, g->more);
  }
  sw_bridges_solve_again(s, g->more);
  for (size_t i = 0; i < 3 * s->nodes; i++) s->delta[i] += g->more[i];
}

static double dot(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

static void add(double *a, double share, const double *b, size_t n) {
  for (size_t i = 0; i < n; i++) a[i] += share * b[i];
}

/* Finds the fixed point of the map from assumed normal forces to those of the solve, by Anderson's
 * mixing (1965; type II of Fang and Saad 2009). Where touches wedge each other, the plain iteration
 * alternates for long, or for ever. All vectors have one number for each touch [N]. */
typedef struct mixing {
  size_t n, columns;
  double *found, *off,
      *next; /* forces of the solve; these minus the assumed ones; the next assumed ones */
  double *found_before, *off_before;
  double *change[MOST_FOLLOW]; /* changes of off, orthonormal */
  double *with[MOST_FOLLOW];   /* changes of found that go with these */
} mixing;

enum { VECTORS = 5 + 2 * MOST_FOLLOW };

static mixing mixing_in(double *room, size_t n) {
  mixing m = {.n = n};
  double **const all[] = {&m.found, &m.off, &m.next, &m.found_before, &m.off_before};
  for (size_t k = 0; k < 5; k++, room += n) *all[k] = room;
  for (int k = 0; k < MOST_FOLLOW; k++, room += 2 * n) m.change[k] = room, m.with[k] = room + n;
  return m;
}

static void look(mixing *m, const sw_spots *g, const double *delta) {
  for (size_t i = 0; i < g->count; i++) {
    const sw_spot *t = &g->list[i];
    m->found[i] = sw_press_push(t->press, shift_of(t, delta));
    m->off[i] = m->found[i] - t->press->lag;
  }
}

/* Adds one more direction from the last change. */
static void learn(mixing *m) {
  const size_t n = m->n, k = m->columns;
  double *change = m->change[k], *with = m->with[k];
  for (size_t i = 0; i < n; i++) {
    change[i] = m->off[i] - m->off_before[i];
    with[i] = m->found[i] - m->found_before[i];
  }
  const double length = sqrt(dot(change, change, n));
  for (size_t j = 0; j < k; j++) {
    const double along = dot(change, m->change[j], n);
    add(change, -along, m->change[j], n), add(with, -along, m->with[j], n);
  }
  const double left = sqrt(dot(change, change, n));
  if (!(left > NOTHING_NEW * length)) return;
  for (size_t i = 0; i < n; i++) change[i] /= left, with[i] /= left;
  m->columns++;
}

/* Computes the next forces: removes the error along known directions. */
static void mix(mixing *m) {
  const size_t n = m->n;
  memcpy(m->next, m->found, n * sizeof *m->next);
  for (size_t j = 0; j < m->columns; j++)
    add(m->next, -dot(m->off, m->change[j], n), m->with[j], n);
  for (size_t i = 0; i < n; i++) m->next[i] = sw_larger(m->next[i], 0.0);
  memcpy(m->found_before, m->found, n * sizeof *m->found);
  memcpy(m->off_before, m->off, n * sizeof *m->off);
}

void sw_spots_follow(sw_spots *g, sw_system *s) {
  if (!sw_bridges_solves_again(s) || !lags(g, s->delta)) return;
  if (SW_GROW(g->more, g->room, 3 * s->nodes) != SW_OK) return;
  if (SW_GROW(g->mixed, g->mixed_room, VECTORS * g->count) != SW_OK) return;
  mixing m = mixing_in(g->mixed, g->count);
  look(&m, g, s->delta);
  const double before = dot(m.off, m.off, m.n);
  for (int k = 0; k < MOST_FOLLOW && lags(g, s->delta); k++) {
    mix(&m);
    assume(g, s, m.next);
    look(&m, g, s->delta);
    learn(&m);
  }
  if (!(dot(m.off, m.off, m.n) <= before)) assume(g, s, NULL);
  sw_bridges_take_solution(s);
}
