/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the touches of one wire agree with an iterate's solution, by further solves with the same
 * factor. Friction follows the normal force; pulling touches open; touches that the wire passes
 * close. The next iterate corrects the rest. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/simd.h"
#include "contact/surface.h"
#include "solve/dense.h"
#include "touch/spot.h"
#include "touch/way.h"

/* MOST_CHANGED: most touches opened and closed in an iterate; with more, the next iterate is
 * cheaper. MOST_PASSES: passes over them; after QUICK_PASSES touches change one by one, because
 * together they may alternate. MOST_FOLLOW: solves for friction; the second is right within 1 %
 * [-]. */
enum { MOST_CHANGED = 12, QUICK_PASSES = 4, MOST_PASSES = 20, MOST_FOLLOW = 2 };

/* A touch that is opened or closed: the normal force that cancels its pull or is its push, and the
 * shift by 1 N of this force. */
typedef struct changed {
  size_t touch;
  int closes, on; /* on = 0: the change was undone */
  double force;   /* [N] */
  double *shift;  /* (nodes x 3) [m/N] */
} changed;

typedef struct refined {
  sw_contact *c;
  sw_system *s;
  sw_body *body;
  size_t first, end; /* range of the body's touches */
  double scale;      /* [N] */
  double *delta;     /* (nodes x 3) the body's solution [m] */
  double *more;      /* (nodes x 3) [N], [m] */
  changed list[MOST_CHANGED];
  size_t count;
} refined;

double sw_contact_scale(const sw_contact *c, size_t first, size_t *end) {
  const size_t body = c->touches[first].body;
  double scale = 0;
  size_t i = first;
  for (; i < c->touch_count && c->touches[i].body == body; i++)
    scale = sw_larger(scale, c->touches[i].press.lag);
  *end = i;
  return scale;
}

static size_t values(const refined *r) { return 3 * r->body->plan->nodes; }

static sw_vec place(const refined *r, const sw_touch *t, const double *x) {
  return sw_mean_of(x, r->body->first_node, &t->spot);
}

/* Distributes a force at a touch to its nodes: shares of free nodes are added to `free` (unless it
 * is NULL), shares of held nodes to their holds if `held` is 1. */
static void push(const refined *r, const sw_touch *t, sw_vec f, double *free, int held) {
  const size_t from = r->body->first_node;
  for (size_t e = 0; e < t->spot.count; e++) {
    const sw_vec part = sw_scale(f, t->spot.w[e]);
    const size_t node = t->spot.node[e];
    if (r->body->plan->held[node - from] == SW_FREE) {
      if (free) sw_accumulate(free + 3 * (node - from), part);
    } else if (held) {
      sw_system_push_held(r->s, node, part);
    }
  }
}

SW_HOT
static void add(size_t n, double share, const double *restrict x, double *restrict to) {
  for (size_t i = 0; i < n; i++) to[i] += share * x[i];
}

/* --- friction ------------------------------------------------------------------- */

static int lags(const refined *r) {
  for (size_t i = r->first; i < r->end; i++) {
    const sw_touch *t = &r->c->touches[i];
    if (sw_press_lags(&t->press, t->friction, place(r, t, r->delta), r->scale)) return 1;
  }
  return 0;
}

/* Total difference between the normal forces and those used for friction [N]. */
static double off(const refined *r) {
  double sum = 0;
  for (size_t i = r->first; i < r->end; i++) {
    const sw_touch *t = &r->c->touches[i];
    sum += sw_press_off(&t->press, t->friction, place(r, t, r->delta));
  }
  return sum;
}

/* Updates friction to the normal forces; back = 1: resets it to the iterate's first solve. */
static void follow(refined *r, int back) {
  memset(r->more, 0, values(r) * sizeof *r->more);
  for (size_t i = r->first; i < r->end; i++) {
    sw_touch *t = &r->c->touches[i];
    sw_press *p = &t->press;
    const sw_vec f = back ? sw_press_unfollow(p, t->friction)
                          : sw_press_follow(p, t->friction, place(r, t, r->delta));
    push(r, t, f, r->more, 1);
  }
  sw_body_solve_again(r->body, r->more);
  add(values(r), 1.0, r->more, r->delta);
}

/* --- opening and closing ---------------------------------------------------------- */

static changed *listed(refined *r, size_t touch) {
  for (size_t k = 0; k < r->count; k++)
    if (r->list[k].touch == touch) return &r->list[k];
  return NULL;
}

/* 1 if the solution contradicts the touch's state. */
static int is_wrong(const refined *r, const sw_touch *t, const changed *one) {
  const sw_vec shift = place(r, t, r->delta);
  if (one && one->on && !one->closes) return sw_press_sinks(&t->press, shift);
  return sw_press_pulls(&t->press, shift) || (!t->held && sw_press_closes(&t->press, shift));
}

/* 1 if the touch's state may change here: only with friction, and if it slides or is inactive.
 * Wires with frames have no changes here, because their equations are not solved again. The next
 * iterate changes the others. */
static int may_change(const sw_touch *t) {
  return t->friction > 0 && (!t->press.active || t->press.sliding);
}

/* Lists a touch that changes, with the shift by a force of 1 N there. */
static void add_change(refined *r, size_t touch) {
  double *shift = r->more + (1 + r->count) * values(r);
  const sw_touch *t = &r->c->touches[touch];
  memset(shift, 0, values(r) * sizeof *shift);
  push(r, t, t->press.normal, shift, 0);
  sw_body_solve_again(r->body, shift);
  r->list[r->count++] = (changed){touch, !t->press.active, 0, 0, shift};
}

/* Undoes a change, except for its friction, which is added to r->more. Returns 1 if there is
 * any. */
static int put_back(refined *r, changed *one) {
  sw_touch *t = &r->c->touches[one->touch];
  if (!one->on) return 0;
  add(values(r), -one->force, one->shift, r->delta);
  one->on = 0, one->force = 0;
  if (!one->closes) return 0;
  const sw_vec f = sw_press_unfollow(&t->press, t->friction);
  push(r, t, f, r->more, 1);
  t->press.active = 0;
  return sw_norm2(f) > 0;
}

/* Solves for the friction in r->more, if there is any. */
static void rub_back(refined *r, int rubbed) {
  if (!rubbed) return;
  sw_body_solve_again(r->body, r->more);
  add(values(r), 1.0, r->more, r->delta);
}

/* Changes touches with a wrong state, at most `most` of them. Returns the number of wrong ones; -1:
 * too many, or one may not change. */
static int change_wrong(refined *r, int most) {
  size_t wrong[MOST_CHANGED];
  size_t all = r->count;
  int count = 0, rubbed = 0;
  for (size_t i = r->first; i < r->end && count < most; i++) {
    const sw_touch *t = &r->c->touches[i];
    const changed *one = listed(r, i);
    if (!is_wrong(r, t, one)) continue;
    if (!one && (all++ == MOST_CHANGED || !may_change(t))) return -1;
    wrong[count++] = i;
  }
  if (!count) return 0;
  memset(r->more, 0, values(r) * sizeof *r->more);
  for (int i = 0; i < count; i++) {
    changed *one = listed(r, wrong[i]);
    if (!one) add_change(r, wrong[i]), one = &r->list[r->count - 1];
    if (one->on) {
      rubbed |= put_back(r, one);
    } else {
      one->on = 1;
      if (one->closes) sw_press_close(&r->c->touches[one->touch].press);
    }
  }
  rub_back(r, rubbed);
  return count;
}

/* Balances the forces of changed touches: an opened one's spring is cancelled, a closed one gets a
 * spring. 0: there is no solution. */
static int balance(refined *r) {
  double S[MOST_CHANGED * MOST_CHANGED], z[MOST_CHANGED];
  changed *on[MOST_CHANGED];
  size_t m = 0;
  for (size_t k = 0; k < r->count; k++)
    if (r->list[k].on) on[m++] = &r->list[k];
  for (size_t k = 0; k < m; k++) {
    const sw_touch *t = &r->c->touches[on[k]->touch];
    const sw_press *p = &t->press;
    const double spring = on[k]->closes ? -p->k : p->k;
    z[k] = spring * (p->gap + sw_dot(p->normal, place(r, t, r->delta))) - on[k]->force;
    for (size_t j = 0; j < m; j++)
      S[m * k + j] = (k == j) - spring * sw_dot(p->normal, place(r, t, on[j]->shift));
  }
  if (!sw_dense_solve(S, m, z)) return 0;
  for (size_t k = 0; k < m; k++) {
    on[k]->force += z[k];
    add(values(r), z[k], on[k]->shift, r->delta);
  }
  return 1;
}

/* Opens touches that pull and closes touches that the wire passes, until none is left. 0: not
 * found. */
static int change_all(refined *r) {
  for (int pass = 0; pass < MOST_PASSES; pass++) {
    const int more = change_wrong(r, pass < QUICK_PASSES ? MOST_CHANGED : 1);
    if (!more) return 1;
    if (more < 0 || !balance(r)) return 0;
  }
  return 0;
}

/* Undoes all opening and closing. */
static void forget_changes(refined *r) {
  int rubbed = 0;
  memset(r->more, 0, values(r) * sizeof *r->more);
  for (size_t k = 0; k < r->count; k++) rubbed |= put_back(r, &r->list[k]);
  r->count = 0;
  rub_back(r, rubbed);
}

/* 1 if all touches stay as they were changed. */
static int stay(const refined *r) {
  for (size_t k = 0; k < r->count; k++) {
    const sw_touch *t = &r->c->touches[r->list[k].touch];
    const sw_vec shift = place(r, t, r->delta);
    if (!r->list[k].on) continue;
    if (r->list[k].closes ? sw_press_pulls(&t->press, shift)
                          : !sw_press_opens(&t->press, shift, r->scale))
      return 0;
  }
  return 1;
}

static void take_changes(const refined *r) {
  for (size_t k = 0; k < r->count; k++) {
    if (!r->list[k].on) continue;
    sw_touch *t = &r->c->touches[r->list[k].touch];
    push(r, t, sw_scale(t->press.normal, r->list[k].force), NULL, 1);
    if (r->list[k].closes) continue;
    t->press.active = 0, t->press.opened = 1;
    t->press.lift = r->list[k].force;
  }
}

/* A touch that shifts further than this is at another place in the next iterate and may not pull
 * there, except on a plane. Share of the radius [-]. */
static const double FAR = 0.1;

static int goes_far(const refined *r) {
  for (size_t i = r->first; i < r->end; i++) {
    const sw_touch *t = &r->c->touches[i];
    const double most = FAR * r->c->candidates[t->candidate].radius;
    if (!t->press.active || r->c->flat[t->obstacle]) continue;
    if (sw_norm2(place(r, t, r->delta)) > most * most) return 1;
  }
  return 0;
}

/* Solves for friction end when one leaves more than this share of the error. Friction that presses
 * its own touch may alternate and grow; the iterates' secants are better there [-]. */
static const double ENOUGH = 0.5;

/* Updates friction. Returns 1 if it fits, or nearly. */
static int follow_all(refined *r, int *changes) {
  double before = off(r);
  for (int k = 0; k < MOST_FOLLOW && lags(r); k++) {
    follow(r, 0);
    if (*changes && !(balance(r) && change_all(r))) {
      *changes = 0;
      forget_changes(r);
    }
    const double after = off(r);
    if (!(after <= ENOUGH * before)) return 0;
    before = after;
  }
  return 1;
}

/* 1 if the solution fits as it is. */
static int fits(const refined *r) {
  for (size_t i = r->first; i < r->end; i++) {
    const sw_touch *t = &r->c->touches[i];
    sw_touch_fetch(t, SW_FETCH_GAP);
    const sw_vec shift = place(r, t, r->delta);
    if (sw_press_pulls(&t->press, shift) || (!t->held && sw_press_closes(&t->press, shift)) ||
        sw_press_lags(&t->press, t->friction, shift, r->scale))
      return 0;
  }
  return 1;
}

static void refine(refined *r) {
  if (fits(r)) return;
  int changes = !goes_far(r) && change_all(r), any = r->count > 0;
  if (!changes) forget_changes(r);
  if (lags(r)) {
    any = 1;
    if (!follow_all(r, &changes)) {
      forget_changes(r);
      follow(r, 1);
    }
  }
  if (stay(r))
    take_changes(r);
  else
    forget_changes(r);
  if (any) sw_body_take_solution(r->body, r->delta);
}

void sw_contact_refine(void *contact, sw_system *s) {
  sw_contact *c = contact;
  for (size_t first = c->parts.touch, end; first < c->touch_count; first = end) {
    sw_body *b = &s->bodies[c->touches[first].body];
    const double scale = sw_contact_scale(c, first, &end);
    if (sw_body_rolls_again(s, b)) sw_contact_refine_rolling(c, s, first, end, scale);
    if (!sw_body_solves_again(s, b)) continue;
    const size_t n = 3 * b->plan->nodes;
    if (SW_GROW(c->room, c->room_capacity, (1 + MOST_CHANGED) * n) != SW_OK)
      return; /* out of memory: nothing is refined */
    refined r = {.c = c,
                 .s = s,
                 .body = b,
                 .first = first,
                 .end = end,
                 .scale = scale,
                 .delta = s->delta + 3 * b->first_node,
                 .more = c->room};
    refine(&r);
  }
}

void sw_contact_add_ways(sw_contact *c, const sw_system *s, sw_ways *to) {
  for (size_t i = c->parts.touch; i < c->touch_count; i++) {
    sw_touch *t = &c->touches[i];
    if (t->held || !s->bodies[t->body].bridged) continue;
    sw_ways_add(to, &t->press, t->friction, sw_mean_of(s->delta, 0, &t->spot));
  }
}

void sw_contact_add_spots(sw_contact *c, const sw_system *s, sw_spots *to) {
  for (size_t first = c->parts.touch, end; first < c->touch_count; first = end) {
    const double scale = sw_contact_scale(c, first, &end);
    const size_t body = c->touches[first].body;
    for (size_t i = first; i < end && s->bodies[body].bridged; i++) {
      sw_touch *t = &c->touches[i];
      const sw_spot spot = {.press = &t->press, .friction = t->friction, .scale = scale};
      sw_spots_add(to, s, spot, &t->spot, body, NULL, 0);
    }
  }
}
