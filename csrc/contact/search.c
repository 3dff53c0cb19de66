/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics: finds the states of the touches (open, sticking, sliding) at fixed positions of the
 * wires. The wires move only when all touches agree. Each solve continues from the least energy
 * between the last update and the new one (touch/way.h). Everything except the touches' forces is
 * linear, and in balance with the forces of the solve. */
#include <math.h>

#include "base/alloc.h"
#include "contact/touch.h"
#include "touch/way.h"

size_t sw_contact_wrong(const sw_contact *c) {
  size_t count = 0;
  for (size_t i = 0; i < c->touch_count; i++)
    count += !c->touches[i].held && !sw_press_apart(&c->touches[i].press);
  return count;
}

/* 1 if any touch has friction. */
static int rubs(const sw_contact *c) {
  for (size_t i = 0; i < c->touch_count; i++)
    if (c->touches[i].press.active && c->touches[i].friction > 0) return 1;
  return 0;
}

typedef struct way {
  const sw_contact *c;
  const sw_ahead *to;
} way;

/* Slope of the energy at this share of the path [J]. */
static double slope(const void *user, double share) {
  const way *w = user;
  double sum = 0;
  for (size_t i = 0; i < w->c->touch_count; i++) {
    const sw_ahead *a = &w->c->ahead[i], *to = &w->to[i];
    const sw_touch *t = &w->c->touches[i];
    if (t->held) continue;
    const sw_vec linear = sw_lerp(a->force, to->force, share);
    const sw_vec real = sw_press_at(&t->press, t->friction, sw_lerp(a->shift, to->shift, share));
    sum += sw_dot(sw_sub(linear, real), sw_sub(to->shift, a->shift));
  }
  return sum;
}

/* Sets the touch's states for the next solve to those at this shift. */
static void go_on_from(sw_touch *t, sw_vec shift) {
  sw_press *p = &t->press;
  sw_press_go_on(p, t->friction, shift, !t->held);
  p->ahead = sw_madd(shift, p->normal, -sw_dot(p->normal, shift));
}

/* DOUBLINGS: doublings of the bend's length on the softest springs. On stiff springs a wire bends
 * within one edge where it lifts off, and each solve would release a few nodes. On soft springs it
 * bends over many edges and lifts off in few solves. Then springs become 16 times as stiff from
 * solve to solve; this halves the uncertainty of the lift-off place each time [-]. */
enum { DOUBLINGS = 12 };
static const double SOFTEST = 1e-9; /* smallest softened stiffness, over the touch's own [-] */

double sw_contact_softer(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                         double stiffness) {
  const sw_plan *p = s->bodies[k->body].plan;
  const double l = p->length / (double)p->edges;
  const double soft = 4.0 * p->beam.EI / (l * l * l) * pow(16.0, c->softer - DOUBLINGS - 1);
  return p->web ? stiffness : fmin(stiffness, fmax(SOFTEST * stiffness, soft));
}

/* In the first stage bends have at most the share WIDEST of the wire, and EACH edges for each wrong
 * touch [-]. */
static const double WIDEST = 0.25, EACH = 4.0;

static int first_stage(const sw_contact *c, const sw_system *s) {
  const double wrong = (double)sw_contact_wrong(c);
  double most = 1.0;
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    most = fmax(most, WIDEST * (double)s->bodies[t->body].plan->edges);
  }
  return (int)fmax(1.0, DOUBLINGS + 1 - floor(log2(fmin(most, EACH * wrong))));
}

/* At most this many wrong touches are found one by one [-]. */
enum { FEW = 4 };

/* Goes on to the next stage, until stages change nothing. */
static void harden(sw_contact *c, const sw_system *s) {
  int any = 0;
  for (size_t i = 0; i < c->touch_count; i++) any |= sw_touch_is_softer(&c->touches[i]);
  if (!c->softer)
    c->softer = first_stage(c, s);
  else
    c->softer = any ? c->softer + 1 : 0;
}

int sw_contact_search(sw_contact *c, const sw_system *s, const double *delta) {
  const size_t n = c->touch_count;
  sw_ahead *to;
  if (SW_GROW(c->ahead, c->ahead_capacity, 2 * n) != SW_OK) return 0;
  to = c->ahead + n;
  const int goes_on = c->ahead_count == n;
  if (s->rolls) return 0; /* surfaces shift by turns too */
  for (size_t i = 0; i < n; i++) {
    const sw_touch *t = &c->touches[i];
    to[i].shift = sw_mean_of(delta, 0, &t->spot);
    to[i].force = sw_press_borne(&t->press, t->friction);
  }
  const double share = goes_on ? sw_way_least(slope, &(way){c, to}) : 1.0;
  for (size_t i = 0; i < n; i++) {
    sw_ahead *a = &c->ahead[i];
    *a = goes_on ? (sw_ahead){sw_lerp(a->shift, to[i].shift, share),
                              sw_lerp(a->force, to[i].force, share)}
                 : to[i];
    go_on_from(&c->touches[i], a->shift);
  }
  if (!goes_on ? sw_contact_wrong(c) > FEW && !rubs(c) : c->softer) harden(c, s);
  c->ahead_count = n;
  return 1;
}
