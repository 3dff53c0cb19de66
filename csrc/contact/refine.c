/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches agree with the solution of an iterate's equations within its linearisation, where a solve
 * with the same factor does that: friction of what slides follows the normal force, and touches
 * that would pull open. What is left to do after that is up to the next iterate. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/spot.h"
#include "contact/touch.h"

/* Touches opened in an iterate, and solves for friction: the second one gets it right to a percent
 * or so [-]. */
enum { MOST_OPEN = 4, MOST_FOLLOW = 2 };

/* A touch that is opened: the force across that takes its pull away, and what one of 1 N does. */
typedef struct opened {
  size_t touch;
  double force;  /* [N] */
  double *shift; /* (nodes x 3) [m/N] */
} opened;

typedef struct refined {
  sw_contact *c;
  sw_system *s;
  sw_body *body;
  size_t first, end; /* its touches */
  double scale;      /* [N] */
  double *delta;     /* (nodes x 3) its solution [m] */
  double *more;      /* (nodes x 3) [N], [m] */
  opened open[MOST_OPEN];
  size_t count;
} refined;

double sw_contact_scale(const sw_contact *c, size_t first, size_t *end) {
  const size_t body = c->touches[first].body;
  double scale = 0;
  size_t i = first;
  for (; i < c->touch_count && c->touches[i].body == body; i++)
    scale = fmax(scale, c->touches[i].press.lag);
  *end = i;
  return scale;
}

static size_t values(const refined *r) { return 3 * r->body->plan->nodes; }

static sw_vec place(const refined *r, const sw_touch *t, const double *x) {
  return sw_mean_of(x, r->body->first_node, &t->spot);
}

/* Share of a force at a touch that its nodes get, to free nodes here and to held ones' holds. */
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

static void add(size_t n, double share, const double *x, double *to) {
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

/* How far normal forces are from those that friction took as given [N]. */
static double off(const refined *r) {
  double sum = 0;
  for (size_t i = r->first; i < r->end; i++) {
    const sw_touch *t = &r->c->touches[i];
    sum += sw_press_off(&t->press, t->friction, place(r, t, r->delta));
  }
  return sum;
}

/* Friction follows the normal forces; back: it is that of the iterate's first solve again. */
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

/* --- opening -------------------------------------------------------------------- */

static void open_one(refined *r, size_t touch) {
  double *shift = r->more + (1 + r->count) * values(r);
  const sw_touch *t = &r->c->touches[touch];
  memset(shift, 0, values(r) * sizeof *shift);
  push(r, t, t->press.normal, shift, 0);
  sw_body_solve_again(r->body, shift);
  r->open[r->count++] = (opened){touch, 0, shift};
}

static int is_open(const refined *r, size_t touch) {
  for (size_t k = 0; k < r->count; k++)
    if (r->open[k].touch == touch) return 1;
  return 0;
}

/* Open the touches that pull. Returns how many do now; -1: they are too many, or stick. Those
 * without friction are left to the next iterate, as are those of wires with frames, whose equations
 * are not solved again: both move alike. */
static int open_pulling(refined *r) {
  int more = 0;
  for (size_t i = r->first; i < r->end; i++) {
    const sw_touch *t = &r->c->touches[i];
    if (!sw_press_pulls(&t->press, place(r, t, r->delta)) || is_open(r, i)) continue;
    if (r->count == MOST_OPEN || !(t->friction > 0) || !t->press.sliding) return -1;
    open_one(r, i);
    more++;
  }
  return more;
}

/* S z = z in place, with the largest pivots; 0: it cannot be solved. */
static int eliminate(size_t m, double S[MOST_OPEN][MOST_OPEN], double *z) {
  for (size_t k = 0; k < m; k++) {
    size_t best = k;
    for (size_t i = k + 1; i < m; i++)
      if (fabs(S[i][k]) > fabs(S[best][k])) best = i;
    for (size_t j = k; j < m; j++) {
      const double swap = S[k][j];
      S[k][j] = S[best][j], S[best][j] = swap;
    }
    const double swap = z[k];
    z[k] = z[best], z[best] = swap;
    if (!(fabs(S[k][k]) > 0)) return 0;
    for (size_t i = k + 1; i < m; i++) {
      const double f = S[i][k] / S[k][k];
      for (size_t j = k; j < m; j++) S[i][j] -= f * S[k][j];
      z[i] -= f * z[k];
    }
  }
  for (size_t k = m; k-- > 0;) {
    for (size_t j = k + 1; j < m; j++) z[k] -= S[k][j] * z[j];
    z[k] /= S[k][k];
    if (!isfinite(z[k])) return 0;
  }
  return 1;
}

/* Opened touches' forces, so that nothing of their springs is left. */
static int balance(refined *r) {
  double S[MOST_OPEN][MOST_OPEN], z[MOST_OPEN];
  for (size_t k = 0; k < r->count; k++) {
    const sw_touch *t = &r->c->touches[r->open[k].touch];
    const sw_press *p = &t->press;
    z[k] = p->k * (p->gap + sw_dot(p->normal, place(r, t, r->delta))) - r->open[k].force;
    for (size_t j = 0; j < r->count; j++)
      S[k][j] = (k == j) - p->k * sw_dot(p->normal, place(r, t, r->open[j].shift));
  }
  if (!eliminate(r->count, S, z)) return 0;
  for (size_t k = 0; k < r->count; k++) {
    r->open[k].force += z[k];
    add(values(r), z[k], r->open[k].shift, r->delta);
  }
  return 1;
}

/* Open what pulls, until nothing does. */
static int open_all(refined *r) {
  for (;;) {
    const int more = open_pulling(r);
    if (more < 0 || (more && !balance(r))) return 0;
    if (!more) return 1;
  }
}

static void forget_opened(refined *r) {
  for (size_t k = 0; k < r->count; k++)
    add(values(r), -r->open[k].force, r->open[k].shift, r->delta);
  r->count = 0;
}

/* Do all stay open? */
static int stay_open(const refined *r) {
  for (size_t k = 0; k < r->count; k++) {
    const sw_touch *t = &r->c->touches[r->open[k].touch];
    if (!sw_press_opens(&t->press, place(r, t, r->delta), r->scale)) return 0;
  }
  return 1;
}

static void take_opened(const refined *r) {
  for (size_t k = 0; k < r->count; k++) {
    sw_touch *t = &r->c->touches[r->open[k].touch];
    t->press.active = 0, t->press.opened = 1;
    t->press.lift = r->open[k].force;
    push(r, t, sw_scale(t->press.normal, r->open[k].force), NULL, 1);
  }
}

/* A touch that goes further is at another place in another iterate, and may not pull there; of the
 * radius [-]. */
static const double FAR = 0.1;

static int goes_far(const refined *r) {
  for (size_t i = r->first; i < r->end; i++) {
    const sw_touch *t = &r->c->touches[i];
    const double most = FAR * r->c->candidates[t->candidate].radius;
    if (t->press.active && sw_norm2(place(r, t, r->delta)) > most * most) return 1;
  }
  return 0;
}

/* Friction that presses its own touch may go to and fro, more at each turn: the iterates find that
 * out better, by secants. Where a solve leaves more than this of what is off there is no further
 * one [-]. */
static const double ENOUGH = 0.5;

/* 1: friction fits, or nearly so. */
static int follow_all(refined *r, int *opens) {
  double before = off(r);
  for (int k = 0; k < MOST_FOLLOW && lags(r); k++) {
    follow(r, 0);
    if (*opens && !((!r->count || balance(r)) && open_all(r))) {
      *opens = 0;
      forget_opened(r);
    }
    const double after = off(r);
    if (!(after <= ENOUGH * before)) return 0;
    before = after;
  }
  return 1;
}

static void refine(refined *r) {
  int opens = !goes_far(r) && open_all(r), changed = r->count > 0;
  if (!opens) forget_opened(r);
  if (lags(r)) {
    changed = 1;
    if (!follow_all(r, &opens)) {
      forget_opened(r);
      follow(r, 1);
    }
  }
  if (stay_open(r))
    take_opened(r);
  else
    forget_opened(r);
  if (changed) sw_body_take_solution(r->body, r->delta);
}

void sw_contact_refine(void *contact, sw_system *s) {
  sw_contact *c = contact;
  for (size_t first = c->parts.touch, end; first < c->touch_count; first = end) {
    sw_body *b = &s->bodies[c->touches[first].body];
    const double scale = sw_contact_scale(c, first, &end);
    if (!sw_body_solves_again(b)) continue;
    const size_t n = 3 * b->plan->nodes;
    if (sw_grow((void **)&c->room, &c->room_capacity, (1 + MOST_OPEN) * n, sizeof *c->room) !=
        SW_OK)
      return; /* the next iterate does without */
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

void sw_contact_add_spots(sw_contact *c, const sw_system *s, sw_spots *to) {
  for (size_t first = 0, end; first < c->touch_count; first = end) {
    const double scale = sw_contact_scale(c, first, &end);
    const uint32_t body[2] = {(uint32_t)c->touches[first].body};
    if (!s->bodies[body[0]].linked) continue;
    for (size_t i = first; i < end; i++) {
      sw_touch *t = &c->touches[i];
      const double at = t->segment ? t->at : 0.0;
      sw_spots_add(to, s, body,
                   (sw_spot){.press = &t->press,
                             .friction = t->friction,
                             .scale = scale,
                             .node = {t->node, t->other},
                             .weight = {1.0 - at, at},
                             .count = t->segment ? 2 : 1});
    }
  }
}
