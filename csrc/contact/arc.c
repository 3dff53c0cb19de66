/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distance between the chords or the smooth curve of a wire and its arc round an obstacle
 * (arc.h). */
#include "contact/arc.h"

#include <math.h>

#include "touch/same.h"

/* Distance of an arc of curvature K from the middle of its chord, over K h^2. The nodes lie so far
 * outside the arc that the chord is as long as the arc [-]. */
static const double OFF = 1.0 / 12.0;
/* Factors on this distance for the first edges from a clamp. A clamp lies on the arc itself, and
 * its hinge moves the next node twice as far outside as later nodes. With these factors the
 * curvatures of a cable wound on a drum differ by 2.3 % beside the clamp; with factors of 1 by 2.9
 * % [-]. */
static const double FROM_CLAMP[] = {1.0, 5.0 / 8.0, 7.0 / 8.0};
enum { FAR = sizeof FROM_CLAMP / sizeof *FROM_CLAMP };

/* Edges up to FINE radii get the full shift, edges above COARSE radii none. The pull of a wire
 * drawn over a cylinder depends on which part of a coarse edge touches. The mean pull is too small
 * by 1 % for edges of R/2 and by 10 % for edges of R with the shift, by 0.1 and 4 % without
 * (spec/contact/capstan_spec). The first edges from a clamp are not drawn; they get all of it up to
 * HELD radii, and none above. Without it the clamp of a winding cable pulls up to twice as hard as
 * the brake for edges of 0.37 to 0.43 radii, with it 1.2 times, with a part of it near HELD 1.7
 * times (spec/contact/winding_clamp_spec) [-]. */
static const double FINE = 0.35, COARSE = 0.5, HELD = 0.47;
/* An arc begins at SW_GOES_ROUND and is complete at BENT: curvature times radius [-]. */
static const double BENT = 0.9;
/* In time steps the shift of a chord is a mean over this many steps. Otherwise a cable that begins
 * to wind beside a clamp shakes, with pulls up to twice the brake's force
 * (spec/contact/winding_spec). At a clamp a growing shift is taken at once, because a clamp presses
 * a chord that comes too late into the drum [-]. */
static const double MEAN_STEPS = 4.0;
/* The chord at a clamp has the shift of an arc from this turn on, as curvature of half an edge
 * times radius; it is 0.8 where the wire's curvature is 1/R. Beyond HALF of the edge the shift
 * decreases, to 0 at twice that: there the wire is on the chord again. Edges above COARSEST radii
 * get no shift at clamps [-]. */
static const double BENDS = 0.5, HALF = 5.0 / 12, COARSEST = 1.5;

/* The number of edges between an edge and the nearest clamp; FAR if there are FAR or more [-]. */
static size_t edges_from_clamp(const sw_plan *p, size_t e) {
  size_t nearest = FAR;
  for (size_t i = 0; i < p->clamp_count; i++) {
    const size_t node = p->clamps[i].node, away = e >= node ? e - node : node - 1 - e;
    if (away < nearest) nearest = away;
  }
  return nearest;
}

static int is_at_clamp(const sw_plan *p, size_t e) {
  for (size_t i = 0; i < p->clamp_count; i++)
    if (p->clamps[i].edge == e) return 1;
  return 0;
}

/* Curvature at an inner node, towards its centre; 0 at the wire's ends [1/m]. */
static sw_vec curvature_at(const sw_body *b, size_t i, const double *x) {
  const double *at = x + 3 * (b->first_node + i), *rest = b->plan->rest;
  if (i == 0 || i + 1 == b->plan->nodes) return sw_v(0, 0, 0);
  const sw_vec here = sw_load(at), before = sw_sub(here, sw_load(at - 3));
  const sw_vec turn = sw_sub(sw_scale(sw_sub(sw_load(at + 3), here), 1.0 / rest[i]),
                             sw_scale(before, 1.0 / rest[i - 1]));
  return sw_scale(turn, 2.0 / (rest[i - 1] + rest[i]));
}

/* Curvature of an edge as an arc of radius R: the mean of its two nodes; at a wire's end that of
 * the inner node [1/m]. */
static sw_vec round_on(const sw_body *b, size_t e, double R, const double *x) {
  const int first = e == 0, last = e + 2 >= b->plan->nodes;
  const sw_vec one = curvature_at(b, e, x), two = curvature_at(b, e + 1, x);
  const double round = R * sqrt(fmax(sw_norm2(one), sw_norm2(two)));
  const double begun = sw_limit((round - SW_GOES_ROUND) / (BENT - SW_GOES_ROUND), 0.0, 1.0);
  return sw_scale(sw_add(one, two), first == last ? 0.5 * begun : begun);
}

/* Shift of the chord of an edge at a clamp, at the share `at` of the edge, for a round side of
 * radius R, as a curvature [1/m]. The wire leaves the clamp's direction slowly, but the chord
 * leaves at once. A chord that has turned by an angle a is inside a circle by R a^2/2, although the
 * wire is outside until its curvature is 1/R. The shift is more than that, up to the shift of an
 * arc: it is computed at the step's start, and with just that no chord could turn further in a
 * step; some cables pressed the drum 2 to 13 times as hard at small steps. Without it a clamp
 * pressed the chord into a drum that began to wind, with about EI/(R h)
 * (spec/contact/winding_clamp_spec). */
static sw_vec leave(const sw_system *s, const sw_body *b, size_t e, double R, double at,
                    const double *x) {
  const sw_plan *p = b->plan;
  const double *here = x + 3 * (b->first_node + e), half = 0.5 * p->rest[e];
  const sw_vec t = sw_unit_or(sw_sub(sw_load(here + 3), sw_load(here)), sw_v(0, 0, 0));
  sw_vec most = sw_v(0, 0, 0);
  for (size_t i = 0; i < p->clamp_count; i++) {
    const sw_clamp_hinge *h = &p->clamps[i];
    if (h->edge != e) continue;
    const sw_vec change = sw_sub(t, sw_vec_at(s->directors_now, sw_clamp_place(h)));
    const sw_vec bend = sw_scale(change, h->side / half);
    const double from = h->side > 0 ? at : 1.0 - at;
    const double part = sw_limit(2.0 - from / HALF, 0.0, 1.0);
    const sw_vec shift = sw_scale(bend, part * OFF / fmax(R * sw_norm(bend), BENDS));
    if (sw_norm2(shift) > sw_norm2(most)) most = shift;
  }
  return most;
}

/* The shift of an edge's chord [m]. */
static sw_vec shift_on(const sw_system *s, const sw_body *b, size_t e, double R, double at,
                       const double *x) {
  const double edge = b->plan->rest[e];
  const size_t from = edges_from_clamp(b->plan, e);
  const double faded = sw_limit((COARSE - edge / R) / (COARSE - FINE), 0.0, 1.0);
  const double share = from < FAR ? FROM_CLAMP[from] * (edge < HELD * R) : faded;
  const sw_vec left = edge < COARSEST * R ? leave(s, b, e, R, at, x) : sw_v(0, 0, 0);
  sw_vec round = sw_v(0, 0, 0);
  if (share > 0) round = sw_scale(round_on(b, e, R, x), share * OFF);
  return sw_scale(sw_norm2(left) > sw_norm2(round) ? left : round, -edge * edge);
}

int sw_contact_arcs(const sw_contact *c, const sw_system *s, const sw_candidate *k) {
  return k->segment && c->round[k->obstacle] > 0 && !s->bodies[k->body].plan->web;
}

double sw_contact_arc_rise(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const sw_place *place, const double *y, sw_vec normal) {
  const int curved = place->sharp == SW_SHARP_ROUND, still = c->regime == SW_CONTACT_STATIC;
  if (!k->arcs || (place->sharp && !curved)) return 0;
  const sw_body *b = &s->bodies[k->body];
  const size_t e = k->node - b->first_node;
  const double R = c->round[k->obstacle] + k->skin, *x = still ? y : s->x;
  const double off = curved ? place->near.at - 0.5 : 0.0; /* from the middle of the edge */
  const size_t beside = off < 0 ? (e > 0 ? e - 1 : e) : e + 1 < b->plan->edges ? e + 1 : e;
  sw_vec shift = shift_on(s, b, e, R, place->near.at, x);
  if (off != 0)
    shift = sw_lerp(shift, shift_on(s, b, beside, R, off < 0 ? 1.0 : 0.0, x), fabs(off));
  if (!still && c->broad.moves[k->obstacle])
    shift = sw_rotate(c->now[k->obstacle].pose.q, sw_unrotate(c->start[k->obstacle].pose.q, shift));
  const double rise = sw_dot(normal, shift);
  return is_at_clamp(b->plan, e) ? sw_larger(0.0, rise) : rise;
}

double sw_contact_arc_mean(const sw_system *s, const sw_candidate *k, const sw_memory *m,
                           double rise) {
  if (!m || m->node != k->node || m->segment != k->segment) return rise;
  if (m->kept.left == HUGE_VAL) return rise; /* it has got other edges */
  const sw_body *b = &s->bodies[k->body];
  if (rise > m->rise && is_at_clamp(b->plan, k->node - b->first_node)) return rise;
  return m->rise + (rise - m->rise) / MEAN_STEPS;
}

/* A wire lies on a round side only if it crosses the middle line: squared sine of their angle from
 * SLANTED (nothing) to ACROSS (all) [-]. */
static const double SLANTED = 0.1, ACROSS = 0.25;

static double ramp(double x, double none, double all) {
  return sw_limit((x - none) / (all - none), 0.0, 1.0);
}

/* Curvature of the way of a wire's axis round the obstacle, if its squared sine to the middle line
 * is across [1/m]. */
static double way_round(const sw_contact *c, const sw_candidate *k, double across) {
  return across / (c->round[k->obstacle] + k->skin);
}

/* Squared sine of the angle between a local direction and the middle line at a touch; 0: the touch
 * is not on the round side [-]. */
static double across_middle(const sw_contact *c, const sw_touch *t, sw_vec along) {
  sw_vec q, middle;
  if (!(sw_shape_middle(c->obstacles[t->obstacle].shape, t->local, &q, &middle) > 0)) return 0;
  return sw_norm2(sw_cross(along, middle)) / sw_norm2(along);
}

sw_vec sw_contact_arc_lies(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const double *y, const sw_touch *t) {
  const sw_body *b = &s->bodies[k->body];
  const sw_contact_at *at = c->regime == SW_CONTACT_STATIC ? c->now : c->start;
  const double *x = c->regime == SW_CONTACT_STATIC ? y : s->x;
  const sw_vec none = sw_v(0, 0, 0);
  if (!b->roll_block || !(c->round[k->obstacle] > 0) || c->obstacles[k->obstacle].grips > 0)
    return none;
  const size_t i = k->node - b->first_node, e = i < b->plan->edges ? i : i - 1;
  const double edge = b->plan->rest[e];
  const sw_quat back = sw_quat_conj(at[k->obstacle].pose.q);
  const sw_vec chord = sw_sub(sw_vec_at(x, b->first_node + e + 1), sw_vec_at(x, b->first_node + e));
  const sw_vec along = sw_rotate(back, sw_unit_or(chord, none));
  const double across = across_middle(c, t, along), round = way_round(c, k, across);
  if (!(across > SLANTED)) return none;
  const sw_vec n =
      sw_rotate(at[k->obstacle].pose.q, sw_unrotate(c->now[k->obstacle].pose.q, t->press.normal));
  const double one = -sw_dot(n, curvature_at(b, k->segment ? e : i, x));
  const double two = k->segment ? -sw_dot(n, curvature_at(b, e + 1, x)) : one;
  const double share = ramp(edge * round, COARSE, FINE) * ramp(across, SLANTED, ACROSS) *
                       ramp(fmax(one, two) / round, SW_GOES_ROUND, BENT);
  return sw_scale(along, share * k->radius);
}

/* The friction at the axis that draws a wire as mu at its surface does, where it lies on a round
 * side. Balances of an element, with the way's curvature K, tension T and shear force V: V = r mu
 * N, N = K T - V', T' = mu N (1 - r K). So T grows as exp(a K s) with a + mu r K a^2 = mu (1 - r
 * K) [-]. */
static double at_axis(const sw_contact *c, const sw_candidate *k, const sw_touch *t, double mu) {
  const double share = t->sharp ? 0.0 : sw_norm(t->edge) / k->radius;
  if (!(share > 0)) return mu;
  const double bent = k->radius * way_round(c, k, across_middle(c, t, t->edge));
  const double draws =
      2.0 * mu * (1.0 - bent) / (1.0 + sqrt(1.0 + 4.0 * mu * mu * (1.0 - bent) * bent));
  return mu + share * (draws - mu);
}

/* MOST_ARC: largest sine of a turn between chords that represent an arc. A neighbouring chord
 * counts fully from 1/BESIDE of the force on, and gradually below; otherwise friction would jump
 * with it [-]. */
static const double MOST_ARC = 0.8, BESIDE = 10.0;

/* Normal force of the candidate's obstacle on the segment before (by -1) or after (by 1) [N]. */
static double force_beside(const sw_contact *c, const sw_candidate *k, int by) {
  const int id = c->obstacles[k->obstacle].id;
  const size_t node = k->node + (size_t)by;
  double sum = 0;
  for (size_t i = by < 0 ? k->memory : k->memory_end;
       by < 0 ? i-- > 0 : i<c->memory_count; i += by> 0) {
    const sw_memory *m = &c->memory[i];
    if (by < 0 ? m->node < node : m->node > node) break;
    if (m->node == node && m->obstacle == id && m->segment) sum += m->kept.steady;
  }
  return sum;
}

double sw_contact_arc_friction(const sw_contact *c, const sw_system *s, const sw_memory *m,
                               const sw_touch *t, double mu) {
  const sw_candidate *k = &c->candidates[t->candidate];
  const sw_body *b = &s->bodies[t->body];
  const size_t i = k->node - b->first_node;
  mu = at_axis(c, k, t, mu);
  if (!m || !(m->kept.steady > 0) || !k->segment || (k->smooth && !k->round) || k->samples ||
      b->plan->web)
    return mu;
  const sw_vec zero = sw_v(0, 0, 0);
  double turn = 0;
  for (int by = -1; by <= 1; by += 2) {
    if (by < 0 ? i == 0 : i + 1 >= b->plan->edges) continue;
    const size_t n = k->node + (size_t)by;
    const sw_vec edge = sw_sub(sw_vec_at(s->x, n + 1), sw_vec_at(s->x, n));
    const double in = -by * sw_dot(t->press.normal, sw_unit_or(edge, zero));
    const double share = sw_smaller(1.0, BESIDE * force_beside(c, k, by) / m->kept.steady);
    turn += 0.5 * share * asin(sw_smaller(sw_larger(in, 0.0), MOST_ARC));
  }
  return turn > 0 && mu > 0 ? sinh(mu * turn) / sin(turn) : mu;
}
