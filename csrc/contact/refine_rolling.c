/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of a wire that rolls follows its normal forces within an iterate. The couple r mu N of
 * friction along the wire presses one neighbour of a touch and lifts the other by mu r/h of N
 * (edges of length h). Friction that only follows from iterate to iterate then converges slowly,
 * and not at all if mu r/h > 1. So the assumed normal forces are found by generalised conjugate
 * residuals (Eisenstat, Elman and Schultz 1983): the equations are (1 - L) e = r for the errors e
 * of the assumed forces, where r are the present differences, and L, the response of the normal
 * forces, has nearly imaginary eigenvalues. Each direction costs one solve. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/surface.h"

/* Most directions; with mu r/h = 1 each leaves 0.41 of the error, with 2 it leaves 0.62 [-]. */
enum { MOST = 6 };

/* Errors are reduced to this share of the tolerance [-]. */
static const double BELOW = 0.1;

typedef struct rolling {
  sw_contact *c;
  sw_system *s;
  sw_body *body;
  size_t first, end;  /* range of the body's touches */
  double *off;        /* (touches) normal force minus the assumed one [N] */
  double *change;     /* (MOST x touches) directions of assumed forces [N] */
  double *effect;     /* (MOST x touches) their effect on off, negative [N] */
  double *solution;   /* (MOST x nodes x 4) their effect on the solution [m], [rad] */
  double size2[MOST]; /* squares of the effects [N2] */
} rolling;

static sw_vec place(const rolling *r, const sw_touch *t, const double *x, size_t stride) {
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < t->spot.count; k++)
    sum = sw_madd(sum, sw_load(x + stride * (t->spot.node[k] - r->body->first_node)), t->spot.w[k]);
  return sum;
}

static void push_node(const rolling *r, size_t node, sw_vec f, double *load) {
  const size_t i = node - r->body->first_node;
  if (r->body->plan->held[i] != SW_FREE) {
    if (!load) sw_system_push_held(r->s, node, f);
  } else if (load) {
    sw_accumulate(load + 4 * i, f);
  }
}

/* Adds friction f at a touch to the loads of nodes and spins (nodes x 4); NULL: to the holds. */
static void push(const rolling *r, const sw_touch *t, sw_vec f, double *load) {
  const sw_levers l = sw_touch_levers(r->s, t);
  const sw_vec couple = sw_scale(l.pry, sw_dot(l.along, f));
  for (size_t k = 0; k < t->spot.count; k++)
    push_node(r, t->spot.node[k], sw_scale(f, t->spot.w[k]), load);
  if (sw_norm2(couple) > 0) {
    push_node(r, l.node[0], sw_neg(couple), load);
    push_node(r, l.node[1], couple, load);
  }
  for (size_t k = 0; load && k < l.count; k++) load[4 * (l.edge + k) + 3] += sw_dot(l.arm[k], f);
}

static size_t touches(const rolling *r) { return r->end - r->first; }

static double product(size_t n, const double *a, const double *b) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

static void add(size_t n, double f, const double *x, double *to) {
  for (size_t i = 0; i < n; i++) to[i] += f * x[i];
}

/* Sets off. Returns 1 if a touch lags by more than the tolerance. */
static int lags(const rolling *r, double force_scale) {
  const double *delta = r->s->delta + 3 * r->body->first_node;
  int any = 0;
  for (size_t i = r->first; i < r->end; i++) {
    const sw_touch *t = &r->c->touches[i];
    const sw_vec shift = place(r, t, delta, 3);
    const int slides = sw_press_slides(&t->press, t->friction);
    r->off[i - r->first] = slides ? sw_press_push(&t->press, shift) - t->press.lag : 0.0;
    any |= sw_press_lags(&t->press, t->friction, shift, BELOW * force_scale);
  }
  return any;
}

/* Solves for direction number k, a change of the assumed forces, and sets its effect. */
static void try_change(rolling *r, size_t k) {
  const size_t m = touches(r), n = 4 * r->body->plan->nodes;
  const double *change = r->change + k * m;
  double *effect = r->effect + k * m, *more = r->solution + k * n;
  memset(more, 0, n * sizeof *more);
  for (size_t i = 0; i < m; i++) {
    const sw_touch *t = &r->c->touches[r->first + i];
    sw_press press = t->press;
    if (change[i] == 0) continue;
    push(r, t, sw_press_assume(&press, t->friction, press.lag + change[i]), more);
  }
  sw_body_solve_rolling_again(r->body, more);
  for (size_t i = 0; i < m; i++) {
    const sw_touch *t = &r->c->touches[r->first + i];
    const int presses = r->off[i] + t->press.lag > 0; /* a touch that pulls has no force */
    const double response = -t->press.k * sw_dot(t->press.normal, place(r, t, more, 4));
    effect[i] = change[i];
    if (presses && sw_press_slides(&t->press, t->friction)) effect[i] -= response;
  }
}

/* Makes direction k's effect orthogonal to those before. 0: it has none. */
static int orthogonal(rolling *r, size_t k) {
  const size_t m = touches(r), n = 4 * r->body->plan->nodes;
  double *effect = r->effect + k * m;
  for (size_t j = 0; j < k; j++) {
    const double f = -product(m, effect, r->effect + j * m) / r->size2[j];
    add(m, f, r->effect + j * m, effect);
    add(m, f, r->change + j * m, r->change + k * m);
    add(n, f, r->solution + j * n, r->solution + k * n);
  }
  r->size2[k] = product(m, effect, effect);
  return r->size2[k] > 0 && isfinite(r->size2[k]);
}

/* Takes a share of direction k. */
static void take(rolling *r, size_t k, double share) {
  const size_t m = touches(r), nodes = r->body->plan->nodes;
  const double *change = r->change + k * m, *more = r->solution + 4 * k * nodes;
  double *delta = r->s->delta + 3 * r->body->first_node;
  for (size_t i = 0; i < m; i++) {
    sw_touch *t = &r->c->touches[r->first + i];
    if (change[i] == 0) continue;
    push(r, t, sw_press_assume(&t->press, t->friction, t->press.lag + share * change[i]), NULL);
  }
  add(4 * nodes, share, more, r->body->spin_delta);
  for (size_t i = 0; i < nodes; i++)
    sw_accumulate(delta + 3 * i, sw_scale(sw_load(more + 4 * i), share));
}

void sw_contact_refine_rolling(sw_contact *c, sw_system *s, size_t first, size_t end,
                               double force_scale) {
  sw_body *b = &s->bodies[c->touches[first].body];
  const size_t m = end - first, n = 4 * b->plan->nodes, room = m + MOST * (2 * m + n);
  if (SW_GROW(c->room, c->room_capacity, room) != SW_OK) return;
  rolling r = {.c = c, .s = s, .body = b, .first = first, .end = end, .off = c->room};
  r.change = r.off + m, r.effect = r.change + MOST * m, r.solution = r.effect + MOST * m;
  double before = HUGE_VAL;
  for (size_t k = 0; k < MOST && lags(&r, force_scale); k++) {
    const double now = product(m, r.off, r.off);
    if (!(now < before)) break;
    before = now;
    memcpy(r.change + k * m, r.off, m * sizeof *r.off);
    try_change(&r, k);
    if (!orthogonal(&r, k)) return;
    take(&r, k, product(m, r.off, r.effect + k * m) / r.size2[k]);
  }
}
