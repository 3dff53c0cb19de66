/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sets the friction of a wire that comes to rest together with its drive. While the wire
 * decelerates at a [m/s2], friction is mu N, the inertia m a helps the drive, and the wire has the
 * strain of mu N - m a. At rest friction must hold this strain. The spring of friction, however, is
 * still stretched by mu N/k and would pull the wire to the strain of mu N: micrometres suffice,
 * because an axially stiff cable yields less than the spring. So the spring is set to the force at
 * rest. On a rolling wire only friction along the wire is set: across it the wire also has the
 * inertia of its spin. */
#include "contact/halt.h"

#include <math.h>

#include "base/each.h"
#include "contact/recall.h"
#include "contact/surface.h"
#include "system/part.h"
#include "touch/same.h"

/* A place rests if its speed is below what it loses in this share of the step [-], or in LATE [s].
 * Velocities of a drive that is a function are differences over times before and after; they reach
 * zero late. */
static const double RESTS = 0.01, LATE = 1e-4;

/* A slower place does not slide [m/s]. */
static const double SLOW = 1e-6;

/* Part of v along the surface, and not in a direction in which the wire rolls. */
static sw_vec sliding_part(sw_vec v, sw_vec normal, const sw_levers *l) {
  v = sw_madd(v, normal, -sw_dot(v, normal));
  if (!l->count) return v;
  const sw_vec rolls = sw_unit_or(l->arm[0], sw_v(0, 0, 0));
  return sw_madd(v, rolls, -sw_dot(v, rolls));
}

/* The section of a mesh that a touch belongs to: its first node, and the one after its last. */
static void section_of(const sw_body *b, size_t node, size_t *first, size_t *end) {
  const sw_web *web = b->plan->web;
  const size_t ring = sw_web_ring_of(web, node - b->first_node);
  *first = b->first_node + web->first[ring], *end = b->first_node + web->first[ring + 1];
}

/* Arc length to which a line's touch holds it on one side: half way to the next touch with friction
 * or held node, or its end [m]. Touches are sorted along the line. */
static double holds_to(const sw_contact *c, const sw_system *s, const sw_touch *t, int way) {
  const sw_body *b = &s->bodies[t->body];
  const sw_plan *p = b->plan;
  const size_t number = (size_t)(t - c->touches), last = p->nodes - 1;
  const double start = p->s[0], here = start + sw_touch_arc(s, t);
  double to = p->s[way > 0 ? last : 0];
  int rests = 0;
  for (size_t i = number + (size_t)way; i < c->touch_count && c->touches[i].body == t->body;
       i += (size_t)way) {
    const sw_touch *other = &c->touches[i];
    if (other->held || !(other->friction > 0) || !(other->press.normal_force > 0)) continue;
    to = start + sw_touch_arc(s, other), rests = 1;
    break;
  }
  for (size_t k = t->node - b->first_node + (way > 0); k <= last; k += (size_t)way) {
    if ((p->s[k] - to) * way >= 0) break;
    if (p->held[k] == SW_FREE) continue;
    to = p->s[k], rests = 1;
    break;
  }
  return rests ? 0.5 * (here + to) : to;
}

/* Mass that a line's touch holds at rest [kg]. Where the line also touches other lines, that of its
 * nodes: those hold their part (mutual/halt.c). */
static double mass_of_line(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  if (!(b->coupled & SW_TOUCHING))
    return b->plan->beam.mass * fmax(0.0, holds_to(c, s, t, 1) - holds_to(c, s, t, -1));
  return c->candidates[t->candidate].mass;
}

/* Mass held by a touch [kg]. In a mesh the touching particles also hold the other particles of
 * their section, in proportion to their pressing force. */
static double mass_of(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  if (!b->plan->web) return mass_of_line(c, s, t);
  if (!b->plan->web->per_ring) return c->candidates[t->candidate].mass;
  size_t first, end;
  section_of(b, t->node, &first, &end);
  double force = 0, mass = 0;
  SW_ITEMS(const sw_touch, other, c->touches, c->touch_count) {
    if (other->node >= first && other->node < end) force += fmax(0.0, other->press.normal_force);
  }
  for (size_t i = first; i < end; i++) mass += b->plan->lumped[i - b->first_node];
  return mass * t->press.normal_force / force;
}

/* A touch that moves less in its step does not slide [m]. */
static const double LANDS = 1e-9;

/* Friction of a touch of a line before it halts [N]. If it slid through the step it is mu N against
 * the slide: at the end the trial's own may have turned round. An error of a nanometre is enough,
 * as friction near a stop is as stiff as the cable. */
static sw_vec friction_before(const sw_contact *c, const sw_system *s, const sw_touch *t,
                              double most, int *slid) {
  const sw_press *p = &t->press;
  *slid = 0;
  if (s->bodies[t->body].plan->web) return p->tangential;
  const sw_closest here = sw_contact_spotted(c, t);
  const sw_memory *m = sw_contact_remembered(c, &c->candidates[t->candidate], &here);
  if (!m || !m->kept.sliding || !(m->kept.normal_force > 0)) return p->tangential;
  sw_vec f = sw_rotate(c->now[t->obstacle].pose.q, sw_neg(m->kept.elastic));
  f = sw_unit_or(sw_madd(f, p->normal, -sw_dot(f, p->normal)), sw_v(0, 0, 0));
  if (!(sw_dot(f, p->slip) < -LANDS)) return p->tangential;
  *slid = 1;
  return sw_scale(f, most);
}

/* Speed of a mesh's section along the surface [m/s]. Single particles always tremble. */
static double section_speed(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  if (!b->plan->web->per_ring) return 0;
  size_t first, end;
  section_of(b, t->node, &first, &end);
  sw_vec v = sw_v(0, 0, 0);
  for (size_t i = first; i < end; i++)
    v = sw_madd(v, sw_vec_at(s->v, i), 1.0 / (double)(end - first));
  v = sw_sub(v, sw_obstacle_velocity(&c->now[t->obstacle], t->point));
  return sw_norm(sw_madd(v, t->press.normal, -sw_dot(v, t->press.normal)));
}

/* Sets the friction of a touch. Returns the remaining speed of its place along the surface
 * [m/s]. */
static double halt(const sw_contact *c, sw_system *s, sw_touch *t) {
  sw_press *p = &t->press;
  if (t->held || !(t->friction > 0) || !(p->normal_force > 0)) return 0;
  const sw_levers l = sw_touch_levers(s, t);
  const sw_vec o = sw_obstacle_velocity(&c->now[t->obstacle], t->point);
  const sw_vec v = sliding_part(sw_sub(sw_mean_of(s->v, 0, &t->spot), o), p->normal, &l);
  const sw_vec a = sliding_part(sw_mean_of(s->a, 0, &t->spot), p->normal, &l);
  if (sw_norm(v) > fmax(RESTS * c->h, LATE) * sw_norm(a)) return sw_norm(v);
  const double most = t->friction * p->normal_force;
  int slid;
  const sw_vec before = friction_before(c, s, t, most, &slid);
  const sw_vec rest = sw_madd(before, a, -mass_of(c, s, t));
  p->tangential = sw_scale(rest, fmin(1.0, most / fmax(sw_norm(rest), 1e-300)));
  p->next_sliding = slid; /* softly for one part: so friction stays, and the strain follows it */
  if (slid) p->soft = 0;
  if (t->spot.count == 1) sw_store(s->v + 3 * t->node, sw_sub(sw_load(s->v + 3 * t->node), v));
  return sw_norm(v);
}

void sw_contact_against(const sw_contact *c, const sw_system *s, sw_against *sum) {
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    const sw_press *p = &t->press;
    if (t->held || !(t->friction > 0) || !(p->normal_force > 0)) continue;
    const sw_levers l = sw_touch_levers(s, t);
    const sw_vec o = sw_obstacle_velocity_before(c, s, t);
    const sw_vec v = sliding_part(sw_sub(sw_mean_of(s->v, 0, &t->spot), o), p->normal, &l);
    if (sw_norm(v) < SLOW) continue;
    sum->against -= sw_dot(p->tangential, sw_scale(v, 1.0 / sw_norm(v)));
    sum->most += t->friction * p->normal_force;
  }
}

/* Friction has kept its direction if it is above this share of its limit, against the slide at the
 * start; else it has turned [-]. */
static const double KEPT = 0.5;

int sw_against_turned(const sw_against *sum) { return sum->against < KEPT * sum->most; }

static double most_of(const sw_touch *t) {
  return t->held ? 0.0 : t->friction * fmax(0.0, t->press.normal_force);
}

double sw_contact_halt(sw_contact *c, sw_system *s, double still) {
  double moving = 0;
  SW_ITEMS(sw_touch, t, c->touches, c->touch_count) {
    const int web = s->bodies[t->body].plan->web != NULL;
    const double section = web ? section_speed(c, s, t) : 0.0, own = halt(c, s, t);
    if ((web ? section : own) > still) moving += most_of(t);
  }
  return moving;
}

double sw_contact_friction(const sw_contact *c) {
  double most = 0;
  for (size_t i = 0; i < c->touch_count; i++) most += most_of(&c->touches[i]);
  return most;
}

double sw_contact_friction_moved(const sw_contact *c, const sw_body *b) {
  size_t first, end;
  double most = 0;
  if (!c->broad.mover_count) return 0;
  sw_contact_touches_of(c, b->first_node, b->first_node + b->plan->nodes, &first, &end);
  for (size_t i = first; i < end && i < c->touch_count; i++) { /* not those that wait */
    const sw_touch *t = &c->touches[i];
    if (c->broad.moves[t->obstacle]) most += most_of(t);
  }
  return most;
}

double sw_contact_landed(const sw_contact *c, const sw_system *s) {
  double most = 0, wire = 0;
  int held = 0;
  for (size_t i = 0; i < c->touch_count; i++) { /* sorted by wire */
    const sw_touch *t = &c->touches[i];
    if (i && t->body != c->touches[i - 1].body) most += held ? wire : 0.0, wire = 0, held = 0;
    const int begins = !t->held && !(t->slid > 0) && sw_norm(t->press.slip) > LANDS;
    held |= t->held;
    if (begins && !s->bodies[t->body].plan->web) wire += most_of(t);
  }
  return most + (held ? wire : 0.0);
}

/* In steps of 10 ms, touches on cables are a thousand times softer than the cable. At rest their
 * springs moved by as much as the cable had stretched, and the hold pulled with 0.72 instead of
 * -0.44 of mu N. A tenth of the edge's stiffness, or ten times it, is as exact
 * (spec/contact/soft_landing_spec). If new touches were this stiff, a cable that sinks onto a
 * table beside a grip would keep a pull of 0.04 of its weight instead of 0
 * (spec/contact/first_step_pull_spec). */
double sw_contact_softness(const sw_contact *c, const sw_system *s, const sw_memory *m,
                           const sw_touch *t) {
  const sw_web *web = s->bodies[t->body].plan->web;
  if (web) return web->per_ring ? 0.0 : fmin(SW_SOFTEST, (double)web->particles);
  /* pads turn; there stiff friction locks in tension */
  if (c->regime != SW_CONTACT_IMPLICIT || c->obstacles[t->obstacle].grips > 0) return 0.0;
  if (!c->brakes && !m) return 0.0;
  const double edge = sw_contact_edge_stiffness(s, t->body, t->node);
  const double usual = sw_contact_usual_force(s, s->bodies[t->body].plan);
  const double grip = c->brakes ? edge : m ? sw_kept_grip(&m->kept, edge, usual) : 0.0;
  return grip > t->press.k ? t->press.k / grip : 0.0;
}

/* Friction at rest keeps its force when a touch becomes softer. In poses and in pads it decreases;
 * otherwise it would lock in there. */
sw_vec sw_contact_stretch(const sw_contact *c, const sw_touch *t, const sw_kept *kept) {
  const int gives_way = c->regime == SW_CONTACT_STATIC || c->obstacles[t->obstacle].grips > 0;
  return sw_press_stretch(&t->press, kept, gives_way);
}
