/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reviews a trial step against obstacles: accepted, to be repeated, or to be made smaller. */
#include <math.h>

#include "base/each.h"
#include "contact/arc.h"
#include "contact/cross.h"
#include "contact/curve.h"
#include "contact/jolt.h"
#include "contact/rebound.h"
#include "touch/same.h"

/* 1 if a node left the range for which its candidates were chosen. Then the reserve is
 * increased. */
static int went_too_far(sw_contact *c, const sw_system *s, const double *x1) {
  double wider = 1.0;
  for (size_t i = 0; i < s->nodes; i++) {
    const sw_vec v = sw_load(s->v + 3 * i), way = sw_sub(sw_vec_at(x1, i), sw_vec_at(s->x, i));
    if (sw_norm2(way) <= SW_FLIGHT_LEAST * SW_FLIGHT_LEAST) continue;
    const double flight = sw_flight_reserve(c, s, v);
    const double shift = sw_norm(way);
    if (shift > flight * c->widening) wider = fmax(wider, shift / flight);
  }
  if (wider <= 1.0) return 0;
  c->widening = 1.5 * wider;
  return 1;
}

/* A step may make a touch deeper by at most this. The depth of the contact law is below half of it
 * [m]. */
static const double DEEPER = 1e-4;
/* The same where a touch is as soft as a section and should yield; share of the radius [-]. */
static const double SQUEEZED = 0.2;

/* Depth of a place of the candidate's wire [m]. */
static double depth_of(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                       const sw_contact_at *at, const double *x, const sw_place *place) {
  const sw_vec normal = sw_rotate(at[k->obstacle].pose.q, place->near.normal);
  const double aslant = sw_contact_aslant(c, k->node, k->other, place->near.at, normal);
  const double rise = sw_contact_arc_rise(c, s, k, place, x, normal);
  return k->skin - place->near.gap - rise - (place->sharp ? 0.0 : aslant);
}

/* Finds where the candidate's wire is deepest with positions x. 0: it is not in the obstacle. */
static int find_deepest(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                        const sw_contact_at *at, const double *x, sw_place *out, double *depth) {
  sw_places list;
  *depth = 0;
  sw_contact_near(c, s, k, at, x, k->skin, &list);
  for (size_t i = 0; i < list.count; i++) {
    const double deep = depth_of(c, s, k, at, x, &list.place[i]);
    if (deep > *depth) *depth = deep, *out = list.place[i];
  }
  return *depth > 0;
}

/* Depth of the candidate's wire at the step's start: the largest anywhere or at this place [m]. The
 * place itself is needed because the chord's nearest place may have been its end, which belongs to
 * its node. */
static double depth_before(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const sw_place *place) {
  sw_place before = *place;
  double deepest;
  find_deepest(c, s, k, c->start, s->x, &before, &deepest);
  if (!k->segment || place->sharp) return deepest;
  const double at = place->near.at;
  const sw_vec a = sw_contact_where(c, s->x, k->node, k->node, 0);
  const sw_vec b = sw_contact_where(c, s->x, k->other, k->other, 0);
  const sw_vec p = sw_pose_local(c->start[k->obstacle].pose, sw_lerp(a, b, at));
  before.sharp = SW_SHARP_NOT;
  const sw_vec way = sw_unrotate(c->start[k->obstacle].pose.q,
                                 sw_rotate(c->now[k->obstacle].pose.q, place->near.normal));
  if (!sw_shape_point_like(c->obstacles[k->obstacle].shape, p, k->skin, way, &before.near))
    return deepest;
  before.near.at = at;
  return fmax(deepest, depth_of(c, s, k, c->start, s->x, &before));
}

/* 1 if the wire moved far enough in the step to be deeper by this much. If not, a node has moved
 * from an edge, where the smooth curve counts, to a face, where the node counts: no smaller step
 * helps. */
static int may_sink(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                    const double *x1, double more) {
  if (!k->smooth || c->broad.moves[k->obstacle]) return 1;
  const sw_body *b = &s->bodies[k->body];
  const size_t end = b->first_node + b->plan->nodes;
  for (size_t i = k->node > b->first_node ? k->node - 1 : k->node; i < end && i <= k->node + 2; i++)
    if (sw_dist(sw_vec_at(x1, i), sw_vec_at(s->x, i)) >= more) return 1;
  return 0;
}

/* 1 if the step cuts too deep. The law uses places and normals of the last iterate; on edges and
 * corners these may be stale at the step's end. */
static int cuts_deep(const sw_contact *c, const sw_system *s, const double *x1, double h) {
  if (h < SW_SMALLEST_CARE * c->nominal || c->regime == SW_CONTACT_EXPLICIT) return 0;
  SW_ITEMS(const sw_candidate, k, c->candidates, c->candidate_count) {
    if (c->flat[k->obstacle] || sw_contact_is_held(s, k)) continue;
    const double more = k->given ? SQUEEZED * k->radius : DEEPER;
    sw_place place;
    double depth;
    if (find_deepest(c, s, k, c->now, x1, &place, &depth) && depth > more &&
        depth > depth_before(c, s, k, &place) + more && may_sink(c, s, k, x1, more))
      return 1;
  }
  return 0;
}

static const double ROUNDING = 1e-9; /* of parts [-] */

/* 1 if the step must be repeated without rebound, at most once. An impulse at the step's start does
 * not contain forces within the step that drive a wire into an obstacle. The integrator lets such a
 * touch bounce. Bounces off a moving obstacle do work in every step. A mesh would hop by g h^2 for
 * ever, because the restart at each landing gives back the energy that damping takes. In the parts
 * of a blow a rod may rebound by its own bends, as from a standing obstacle. */
static int bounces(sw_contact *c, const sw_system *s, const double *v1) {
  if (c->plastic || c->regime == SW_CONTACT_EXPLICIT) return 0;
  const int whole = c->h > SW_LONGEST_PART * (1 + ROUNDING);
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    if (t->known || !(t->press.normal_force > 0) || c->obstacles[t->obstacle].restitution > 0)
      continue;
    const sw_vec wall = sw_obstacle_velocity(&c->now[t->obstacle], t->point);
    const int moves = fabs(sw_dot(wall, t->press.normal)) > SW_SLOWEST_IMPACT;
    if (!(moves && whole) && !s->bodies[t->body].plan->web) continue;
    const sw_vec v = sw_sub(sw_mean_of(v1, 0, &t->spot), wall);
    if (sw_dot(v, t->press.normal) > SW_SLOWEST_IMPACT) return c->plastic = 1;
  }
  return 0;
}

/* A barrier acts like an endless face, even if the obstacle ends just above it. If it carries more
 * than this many weights (or bending forces) of its wire, the wire would pass over the obstacle,
 * and the barrier is in its way; a smaller step decides [-]. */
static const double MOST_BORNE = 10.0;

static int bars_too_hard(const sw_contact *c, const sw_system *s, double h) {
  if (!c->barrier_count || h < SW_SMALLEST_CARE * c->nominal) return 0;
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    if (t->feature != SW_BEHIND_BARRIER || !(t->press.normal_force > 0)) continue;
    const double usual = sw_contact_usual_force(s, s->bodies[t->body].plan);
    if (t->press.normal_force > MOST_BORNE * usual) return 1;
  }
  return 0;
}

/* A wire held by pads or friction may leave them sideways in one step by at most this share of its
 * radius. A step begins with free flight, in which a wire may fall out from between pads before any
 * touch is found. A quarter to twice this value ends the same grips [-]. */
static const double AT_ONCE = 0.5;
/* A touch holds the wire if it presses with more than this many times its node's share of the
 * wire's weight. Half and twice this value hold the same grips [-]. */
static const double HELD = 2.0;
/* A wire that slips off moves sideways at least this many times as far as along the normal; a
 * lifted wire moves along the normal [-]. */
static const double ASLANT = 10.0;

static int is_pressed_still(const sw_contact *c, const sw_memory *m) {
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    const size_t apart = t->node > m->node ? t->node - m->node : m->node - t->node;
    if (apart <= 1 && t->press.normal_force > 0 && c->obstacles[t->obstacle].id == m->obstacle)
      return 1;
  }
  return 0;
}

/* Direction of the wire at a node, in the obstacle's axes. */
static sw_vec tangent_at(const sw_contact *c, const sw_body *b, size_t o, const double *x1,
                         size_t node) {
  const size_t first = node + 1 < b->first_node + b->plan->nodes ? node : node - 1;
  const sw_vec t = sw_sub(sw_vec_at(x1, first + 1), sw_vec_at(x1, first));
  return sw_unit_or(sw_rotate(sw_quat_conj(c->now[o].pose.q), t), sw_v(1, 0, 0));
}

/* 1 if a wire left a remembered touch sideways. Wires that already slide may go on in their own
 * direction. */
static int went_sideways(const sw_contact *c, const sw_body *b, const sw_memory *m,
                         const double *x1) {
  const size_t o = sw_contact_index(c, m->obstacle);
  if (o == c->count) return 0;
  const sw_vec at = sw_contact_where(c, x1, m->node, m->node + (m->segment != 0), m->at);
  sw_vec way = sw_sub(sw_pose_local(c->now[o].pose, at), m->seen);
  const double along = sw_dot(way, m->normal);
  way = sw_madd(way, m->normal, -along);
  if (m->kept.sliding) {
    const sw_vec t = tangent_at(c, b, o, x1, m->node);
    way = sw_madd(way, t, -sw_dot(way, t));
  }
  const double aside = sw_norm(way);
  return aside > AT_ONCE * b->plan->beam.radius && aside > ASLANT * along;
}

/* 1 if a held wire gets free in a way that only a long step allows. */
static int slips_off(const sw_contact *c, const sw_system *s, const double *x1, double h) {
  const sw_body *b = s->bodies, *of = NULL;
  double most = 0; /* force of a touch that does not hold the wire [N] */
  if (h < SW_SMALLEST_CARE * c->nominal || c->regime == SW_CONTACT_EXPLICIT) return 0;
  if (sw_contact_all_wait(c, s)) return 0;
  for (size_t i = 0; i < c->memory_count; i++) { /* memory is in the order of nodes */
    const sw_memory *m = &c->memory[i];
    while (m->node >= b->first_node + b->plan->nodes) b++;
    if (b->plan->web || b->waits) continue;
    if (of != b) most = HELD * sw_contact_usual_force(s, b->plan) / (double)b->plan->nodes, of = b;
    if (!(m->kept.normal_force > most)) continue;
    if (went_sideways(c, b, m, x1) && !is_pressed_still(c, m)) return 1;
  }
  return 0;
}

static int brushes(const sw_contact *c, const sw_system *s, const double *x1, double h) {
  if (h < SW_SMALLEST_CARE * c->nominal || c->regime == SW_CONTACT_EXPLICIT) return 0;
  return sw_contact_brushes(c, s, x1);
}

sw_contact_verdict sw_contact_review(sw_contact *c, sw_system *s, const double *x1,
                                     const double *v1, double h, int dull) {
  sw_error err;
  const int hasty = c->hasty;
  c->hasty = 0;
  if (went_too_far(c, s, x1)) {
    c->pressed_count = 0;
    return sw_contact_find_candidates(c, s, &err) == SW_OK ? SW_CONTACT_REDO : SW_CONTACT_SMALLER;
  }
  /* kicks are added at the end: no impulse must see its neighbours' effect on the edges between */
  double *kicks = s->delta + 3 * s->nodes, *rates = s->v + 3 * s->nodes;
  for (size_t e = 0; e < s->rolls; e++) kicks[e] = 0;
  c->soonest = HUGE_VAL;
  const int crossed = sw_contact_cross(c, s, x1, h);
  const int struck = sw_contact_strike_all(c, s, h, dull);
  c->careful |= hasty && !struck;
  for (size_t e = 0; e < s->rolls; e++) rates[e] += kicks[e];
  c->pressed_count = 0;
  if (c->soonest < h) return SW_CONTACT_SOONER;
  if (crossed || struck || hasty) return SW_CONTACT_REDO;
  if (bounces(c, s, v1)) return SW_CONTACT_STRIKE;
  const int smaller = bars_too_hard(c, s, h) || cuts_deep(c, s, x1, h) || slips_off(c, s, x1, h) ||
                      brushes(c, s, x1, h);
  if (smaller) return SW_CONTACT_SMALLER;
  const int sooner = sw_contact_turns(c, s, v1, h) || sw_contact_breaks_loose(c, s, h);
  return sooner ? SW_CONTACT_SOONER : SW_CONTACT_ACCEPT;
}

int sw_contact_review_static(sw_contact *c, sw_system *s, const double *x1) {
  return sw_contact_cross(c, s, x1, 0.0);
}
