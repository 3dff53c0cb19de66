/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics: touches find their states while the wires stay, which move only when all agree. A solve
 * holds for assumed states, and taking its new states may alternate for ever. But with given normal
 * forces for friction the energy is convex in the update: it has a minimum between the last update
 * and the new one, and steps to such minima always end. Only the touches' own forces are needed for
 * it; the rest is linear and in balance with the solve's forces. */
#include <math.h>

#include "base/alloc.h"
#include "contact/touch.h"

/* Halvings of the way until its share is known [-]. */
enum { HALVINGS = 20 };

/* Force of the touch by its law, shifted by s, with friction's normal force as given. */
static sw_vec force_at(const sw_touch *t, sw_vec s) {
  const sw_press *p = &t->press;
  const double across = sw_dot(p->normal, s), N = fmax(0.0, -p->k * (p->gap + across));
  const sw_vec u = sw_madd(sw_add(p->trial, s), p->normal, -across);
  const double most = t->friction * p->lag, spring = sw_press_grip(p) * sw_norm(u);
  const sw_vec f = sw_scale(p->normal, N);
  if (!(most > 0) || !(spring > 0)) return f;
  return sw_madd(f, u, -sw_press_grip(p) * fmin(1.0, most / spring));
}

size_t sw_contact_wrong(const sw_contact *c) {
  size_t count = 0;
  for (size_t i = 0; i < c->touch_count; i++)
    count += !c->touches[i].held && !sw_press_apart(&c->touches[i].press);
  return count;
}

/* Does any of them rub? */
static int rubs(const sw_contact *c) {
  for (size_t i = 0; i < c->touch_count; i++)
    if (c->touches[i].press.active && c->touches[i].friction > 0) return 1;
  return 0;
}

/* Slope of the energy at this share of the way [J]. */
static double slope(const sw_contact *c, const sw_ahead *to, double share) {
  double sum = 0;
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_ahead *a = &c->ahead[i];
    if (c->touches[i].held) continue;
    const sw_vec linear = sw_lerp(a->force, to[i].force, share);
    const sw_vec real = force_at(&c->touches[i], sw_lerp(a->shift, to[i].shift, share));
    sum += sw_dot(sw_sub(linear, real), sw_sub(to[i].shift, a->shift));
  }
  return sum;
}

static double least(const sw_contact *c, const sw_ahead *to) {
  double low = 0, high = 1.0;
  if (!(slope(c, to, 1.0) > 0) || !(slope(c, to, 0.0) < 0)) return 1.0;
  for (int i = 0; i < HALVINGS; i++) {
    const double middle = 0.5 * (low + high);
    if (slope(c, to, middle) > 0)
      high = middle;
    else
      low = middle;
  }
  return high;
}

/* The next solve is for the states there. */
static void go_on_from(sw_touch *t, sw_vec shift) {
  sw_press *p = &t->press;
  const double across = sw_dot(p->normal, shift), gap = p->gap + across;
  const sw_vec u = sw_madd(sw_add(p->trial, shift), p->normal, -across);
  p->take_on = !t->held && gap < 0;
  p->let_go = !p->take_on;
  p->normal_force = fmax(0.0, -p->k * gap);
  p->next_sliding = sw_press_grip(p) * sw_norm(u) > t->friction * p->normal_force;
  p->ahead = sw_madd(shift, p->normal, -across);
}

/* On stiff springs a wire bends within one edge where it lifts off, and each solve would release a
 * few nodes. On soft springs it bends over as many edges as the doublings, and lifts off in few
 * solves. Then springs become 16 times as stiff from solve to solve, which halves the uncertainty
 * of that place each time [-]. */
enum { DOUBLINGS = 12 };
static const double SOFTEST = 1e-9; /* of the touch's own stiffness [-] */

double sw_contact_softer(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                         double stiffness) {
  const sw_plan *p = s->bodies[k->body].plan;
  const double l = p->length / (double)p->edges;
  const double soft = 4.0 * p->beam.EI / (l * l * l) * pow(16.0, c->softer - DOUBLINGS - 1);
  return p->web ? stiffness : fmin(stiffness, fmax(SOFTEST * stiffness, soft));
}

/* Stages begin with bends of a share of the wire at most, and of so many edges for each touch that
 * is wrong [-]. */
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

/* Fewer wrong touches than this are found one by one [-]. */
enum { FEW = 4 };

/* Stages go on until they change nothing any more. */
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
  if (sw_grow((void **)&c->ahead, &c->ahead_capacity, 2 * n, sizeof *c->ahead) != SW_OK) return 0;
  to = c->ahead + n;
  const int goes_on = c->ahead_count == n;
  if (s->rolls) return 0; /* surfaces shift by turns too */
  for (size_t i = 0; i < n; i++) {
    const sw_touch *t = &c->touches[i];
    to[i].shift = sw_mean_of(delta, 0, &t->spot);
    to[i].force = sw_press_borne(&t->press, t->friction);
  }
  const double share = goes_on ? least(c, to) : 1.0;
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
