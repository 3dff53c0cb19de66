/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires that are pushed onto an obstacle by their ends. For a short time inertia keeps a stiff
 * cable straight, and it carries far more than its buckling load. In a step longer than this time
 * it buckles at once or slips off, by chance. */
#include <math.h>

#include "contact/jolt.h"
#include "contact/touch.h"

/* A wire is pushed by its end if the cosine of its angle with the normal is above this [-]. */
static const double END_ON = 0.5;
/* Largest part, over the time for which the wire stays straight (see below). Of 40 random pokes
 * (spec/contact/poke_spec) 2 have a peak that is off by more than 10 %; with parts of 0.1 ms 9
 * have. Twice the value loses a cable that should stick (spec/contact/blows_spec); half of it
 * changes nothing [-]. */
static const double SHARE = 0.012;
/* Logarithm of the growth of the bending at which the wire is no longer straight [-]. */
static const double GROWTH = 8.0;

static int is_end_on(const sw_system *s, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  const size_t i = t->node - b->first_node, last = b->plan->nodes - 1;
  if (t->segment || b->plan->web || (i > 0 && i < last)) return 0;
  const size_t e = b->first_node + (i ? last - 1 : 0);
  const sw_vec edge = sw_sub(sw_vec_at(s->x, e + 1), sw_vec_at(s->x, e));
  return fabs(sw_dot(edge, t->press.normal)) > END_ON * sw_norm(edge);
}

double sw_contact_free_length(const sw_plan *p, int last) {
  double length = 0;
  for (size_t k = 0; k < p->edges; k++) {
    const size_t e = last ? p->edges - 1 - k : k;
    length += p->rest[e];
    if (p->held[last ? e : e + 1] != SW_FREE) break;
  }
  return length;
}

double sw_contact_push_speed(const sw_contact *c, const sw_system *s, size_t k) {
  const sw_touch *t = &c->touches[k];
  const sw_body *b = &s->bodies[t->body];
  const double aside =
      sw_dot(sw_obstacle_velocity(&c->now[t->obstacle], t->point), t->press.normal);
  double most = 0;
  for (size_t i = 0; i < b->plan->nodes; i++)
    most = fmax(most, aside - sw_dot(sw_vec_at(s->v, b->first_node + i), t->press.normal));
  return most;
}

/* Time for which the wire stays straight. Pushed with the speed v, its force rises as P = EA v t/L.
 * Under P its bending grows at the rate P/(2 sqrt(EI m)) at most, with the mass per length m. So
 * the time T follows from EA v T^2/(4 L sqrt(EI m)) = GROWTH. */
static double straight_for(const sw_body *b, double length, double speed) {
  const double inert = sqrt(b->plan->beam.EI * b->plan->beam.mass);
  return sqrt(4.0 * GROWTH * length * inert / (b->EA_push * speed));
}

double sw_contact_half_wave(const sw_body *b, double length, double speed) {
  const double most = b->EA_push * speed * straight_for(b, length, speed) / length;
  return M_PI * sqrt(2.0 * b->plan->beam.EI / most);
}

double sw_contact_push_part(const sw_contact *c, const sw_system *s) {
  double shortest = HUGE_VAL;
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    if (!(t->press.normal_force > 0) || c->obstacles[t->obstacle].grips > 0) continue;
    const sw_body *b = &s->bodies[t->body];
    if (!is_end_on(s, t) || !(b->plan->beam.EI > 0)) continue; /* a string bends at once */
    const double speed = sw_contact_push_speed(c, s, i);
    const double length = sw_contact_free_length(b->plan, t->node != b->first_node);
    if (speed > 0) shortest = fmin(shortest, SHARE * straight_for(b, length, speed));
  }
  return shortest;
}
