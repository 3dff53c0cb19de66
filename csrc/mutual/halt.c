/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of wires that slide on other wires and come to rest together with their drive (see
 * contact/halt.c). */
#include "mutual/halt.h"

#include <math.h>

#include "mutual/meet.h"

/* As in contact/halt.c [-], [s], [m/s]. */
static const double RESTS = 0.01, LATE = 1e-4, SLOW = 1e-6;

static double most_of(const sw_mutual *m, const sw_meet *t) {
  return sw_mutual_rule(m, t->of.body)->friction * fmax(0.0, t->press.normal_force);
}

static sw_vec along(sw_vec v, sw_vec normal) { return sw_madd(v, normal, -sw_dot(v, normal)); }

static double arc_of(const sw_system *s, const sw_meet *t, int side) {
  const sw_body *b = &s->bodies[t->of.body[side]];
  const double *arc = b->plan->s;
  const double from = arc[t->of.node[side] - b->first_node];
  return from + t->at[side] * (arc[t->of.end[side] - b->first_node] - from);
}

/* The nearest supports of a body on both sides of a place. Places of the same arc length are sorted
 * by their numbers. */
typedef struct beside {
  double at, before, after; /* arc lengths; +-HUGE_VAL: nothing [m] */
  size_t number;
} beside;

static void regard(beside *b, double at, size_t number) {
  const int is_before = at < b->at || (!(at > b->at) && number < b->number);
  if (is_before)
    b->before = fmax(b->before, at);
  else if (at > b->at || number > b->number)
    b->after = fmin(b->after, at);
}

/* Mass of the part of a wire that a touch holds at rest [kg]: on both sides half the length to the
 * next touch or hold, because friction there keeps the mean of the tensions between both; a free
 * end with all its mass. */
static double mass_of(const sw_mutual *m, const sw_contact *c, const sw_system *s, size_t number,
                      int side) {
  const uint32_t body = m->touches[number].of.body[side];
  const sw_body *b = &s->bodies[body];
  const sw_plan *p = b->plan;
  const double start = p->s[0], end = p->s[p->nodes - 1];
  beside at = {arc_of(s, &m->touches[number], side), -HUGE_VAL, HUGE_VAL,
               2 * number + (size_t)side};
  sw_contact_push push;
  for (size_t i = 0; i < 2 * m->touch_count; i++) {
    const sw_meet *t = &m->touches[i / 2];
    if (t->of.body[i % 2] == body && most_of(m, t) > 0) regard(&at, arc_of(s, t, (int)(i % 2)), i);
  }
  const size_t touches = c ? sw_contact_touches(c) : 0;
  for (size_t k = 0; k < touches; k++)
    if (sw_contact_push_at(c, s, k, &push) && push.friction > 0 && push.node >= b->first_node &&
        push.node < b->first_node + p->nodes)
      regard(&at, start + push.place, 2 * m->touch_count);
  for (size_t i = 0; i < p->nodes; i++)
    if (p->held[i] != SW_FREE) regard(&at, p->s[i], 2 * m->touch_count);
  const double from = at.before > -HUGE_VAL ? 0.5 * (at.at + at.before) : start;
  const double to = at.after < HUGE_VAL ? 0.5 * (at.at + at.after) : end;
  return p->beam.mass * fmax(0.0, to - from);
}

static int is_of_lines(const sw_system *s, const sw_meet *t) {
  return !s->bodies[t->of.body[0]].plan->web && !s->bodies[t->of.body[1]].plan->web;
}

/* Sets the friction of a touch. Returns the remaining sliding speed of its place [m/s]. */
static double halt(sw_mutual *m, const sw_contact *c, const sw_system *s, size_t number) {
  sw_meet *t = &m->touches[number];
  sw_press *p = &t->press;
  const double most = most_of(m, t);
  if (!(most > 0) || !is_of_lines(s, t)) return 0;
  const sw_vec v = along(sw_bows_apart(s->v, t->bow), p->normal);
  const sw_vec one = along(sw_mean_of(s->a, 0, &t->bow[0].spot), p->normal);
  const sw_vec two = along(sw_mean_of(s->a, 0, &t->bow[1].spot), p->normal);
  const double a = sw_dist(one, two);
  if (!(a > 0) || sw_norm(v) > fmax(RESTS * m->h, LATE) * a) return sw_norm(v);
  sw_vec rest = sw_madd(p->tangential, one, -mass_of(m, c, s, number, 0));
  rest = sw_madd(rest, two, mass_of(m, c, s, number, 1));
  p->tangential = sw_scale(rest, fmin(1.0, most / fmax(sw_norm(rest), 1e-300)));
  p->next_sliding = 0;
  return sw_norm(v);
}

double sw_mutual_halt(sw_mutual *m, const sw_contact *c, const sw_system *s, double still) {
  double moving = 0;
  for (size_t i = 0; i < m->touch_count; i++)
    if (halt(m, c, s, i) > still) moving += most_of(m, &m->touches[i]);
  return moving;
}

double sw_mutual_friction(const sw_mutual *m) {
  double most = 0;
  for (size_t i = 0; i < m->touch_count; i++) most += most_of(m, &m->touches[i]);
  return most;
}

void sw_mutual_against(const sw_mutual *m, const sw_system *s, sw_against *sum) {
  for (size_t i = 0; i < m->touch_count; i++) {
    const sw_meet *t = &m->touches[i];
    const double most = most_of(m, t);
    const sw_vec v = along(sw_bows_apart(s->v, t->bow), t->press.normal);
    if (!(most > 0) || sw_norm(v) < SLOW) continue;
    sum->against -= sw_dot(t->press.tangential, sw_scale(v, 1.0 / sw_norm(v)));
    sum->most += most;
  }
}

void sw_mutual_along(const sw_mutual *m, const sw_system *s, size_t body, sw_along *sum) {
  for (size_t i = 0; i < 2 * (m->touch_count + m->still.count); i++) {
    const size_t k = i / 2, side = i % 2;
    const sw_meet *t = k < m->touch_count ? &m->touches[k] : &m->still.list[k - m->touch_count];
    if (t->of.body[side] != body || !(t->press.normal_force > 0)) continue;
    const double most = sw_mutual_rule(m, t->of.body)->friction * t->press.normal_force;
    sw_along_add(s, body, t->of.node[side], sw_scale(t->press.tangential, side ? -1 : 1), most,
                 sum);
  }
}

int sw_mutual_drags(const sw_mutual *m) {
  for (size_t i = 0; i < m->touch_count; i++)
    if (most_of(m, &m->touches[i]) > 0) return 1;
  for (size_t i = 0; i < m->still.count; i++)
    if (most_of(m, &m->still.list[i]) > 0) return 1;
  return 0;
}

int sw_mutual_rubs(const sw_mutual *m) {
  for (size_t i = 0; i < m->bodies * m->bodies; i++)
    if (m->rules[i].on && m->rules[i].friction > 0) return 1;
  return 0;
}
