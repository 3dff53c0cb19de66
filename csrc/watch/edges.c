/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports rods whose edges are too long for a bend. A bend over something sharp is then as wide as
 * an edge, and a taut wire, which cannot bend as much as it should, is stretched instead. */
#include <math.h>
#include <string.h>

#include "base/halving.h"
#include "contact/contact.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "system/axial.h"
#include "system/system.h"
#include "watch/observe.h"

/* An edge longer than LONG of the bend radius makes the radius about a tenth too large, and the
 * tension of a taut wire wrong by more. Edges of FINE of it make both right within a few percent
 * (spec/lua/long_edges_spec) [-]. */
static const double LONG = 0.8, FINE = 0.4;

/* Returns the number of the edge at s, on or before it. */
static size_t edge_at(const sw_plan *plan, double s) {
  size_t after;
  SW_FIRST_NOT(plan->s[after] <= s, after, 1, plan->edges);
  return after - 1;
}

/* --- a taut wire that bends within an edge ------------------------------------------------------
 */

/* A node is a bend from this turn on. Beside a round obstacle smaller turns than ROUND are allowed
 * for (contact/arc.h) [rad]. */
static const double BEND = 0.2, ROUND = 0.35;
/* A wire is taut between two holds if all other nodes and edges beside bends turn by less than this
 * share of the bends [-]. */
static const double LITTLE = 0.2;
/* The false part of a tension that is told [-]. */
static const double FALSE_PART = 0.1;
/* Edges of this share of sqrt(EI/T) resolve a bend under the tension T within 5 % [-]. */
static const double RESOLVED = 0.7;

static double turn_at(const sw_body *b, const double *x, size_t i) {
  const double *at = x + 3 * (b->first_node + i);
  const sw_vec zero = sw_v(0, 0, 0), here = sw_load(at);
  const sw_vec before = sw_unit_or(sw_sub(here, sw_load(at - 3)), zero);
  const sw_vec after = sw_unit_or(sw_sub(sw_load(at + 3), here), zero);
  return sw_dist(before, after);
}

static int is_on_round(const sw_scene *s, size_t node) {
  return sw_contact_round_beside(sw_scene_contact(s), sw_scene_system(s), node) > 0;
}

/* Two neighbouring bends a, b at one sharp edge make the path longer by NEXT a b h/8 more than each
 * by itself. Measured: 1.0 in all with edges of 2 sqrt(EI/T), 0.3 with RESOLVED ones
 * (spec/contact/led_over_spec) [-]. */
static const double NEXT = 0.5;

/* Bends of a stretch of wire between two holds: how much longer they make its path, about a^2 h/8
 * each [m]; their turns, and those of all nodes [rad]. */
typedef struct bends {
  double longer, sharp, all;
} bends;

static bends between(const sw_scene *s, const sw_body *b, size_t from, size_t to) {
  const double *x = sw_scene_system(s)->x;
  bends sum = {0};
  int beside = 0;
  double before = 0; /* the bend at the node before, if it is at a sharp edge [rad] */
  for (size_t i = from + 1; i < to; i++) {
    const double a = turn_at(b, x, i), h = 0.5 * (b->plan->rest[i - 1] + b->plan->rest[i]);
    const int on_round = a > BEND && is_on_round(s, b->first_node + i);
    const int sharp = a > (on_round ? ROUND : BEND);
    sum.all += a;
    if (sharp || beside || (i + 1 < to && turn_at(b, x, i + 1) > BEND)) sum.sharp += a;
    if (sharp) sum.longer += a * (a + NEXT * before) * h / 8.0;
    beside = sharp;
    before = sharp && !on_round ? a : 0;
  }
  return sum;
}

/* Returns the largest false part of a wire's tension T: bends within an edge make the wire's path
 * too long where it is taut between two holds. Else 0 [N]. */
static double false_tension(const sw_scene *s, const sw_body *b, double T) {
  const sw_plan *p = b->plan;
  double most = 0;
  for (size_t i = 0, from = p->nodes; i < p->nodes; i++) {
    if (p->held[i] == SW_FREE) continue;
    if (i > from + 1) {
      const bends sum = between(s, b, from, i);
      if (sum.all - sum.sharp < LITTLE * sum.sharp)
        most = fmax(most, b->EA * sum.longer / (p->s[i] - p->s[from]));
    }
    from = i;
  }
  return fmin(most, T);
}

/* 1 if the wire's node is in a feed that obeys a force: its tension is that force, on any path. */
static int obeys(const sw_scene *s, const sw_body *b, size_t node) {
  SW_EACH(hold, h, s) {
    if (&sw_scene_system(s)->bodies[h->wire] != b || h->node != node) continue;
    const sw_slip *slip = h->cls->hold->slips ? h->cls->hold->slips(h) : NULL;
    if (slip && isfinite(slip->push)) return 1;
  }
  return 0;
}

/* A wire is taut round something above this share of EI K^2, with its sharpest bend K [-]. */
static const double TAUT = 0.25;

/* The turn at a node that bends round facets, which press its edges from within; else 0. They press
 * its chords where a round side would press its arc [rad]. */
static double turn_on_facets(const sw_scene *s, const sw_body *b, size_t i) {
  const sw_contact *c = sw_scene_contact(s);
  const sw_system *system = sw_scene_system(s);
  const size_t node = b->first_node + i;
  size_t first = 0, end = 0;
  if (!c || i == 0 || i >= b->plan->edges || is_on_round(s, node)) return 0;
  const sw_vec in = sw_madd(sw_vec_at(system->x, node - 1), sw_vec_at(system->x, node), -2.0);
  const sw_vec bend = sw_add(in, sw_vec_at(system->x, node + 1));
  sw_contact_touches_of(c, node - 1, node + 1, &first, &end);
  for (size_t k = first; k < end; k++) {
    sw_contact_push push;
    if (!sw_contact_push_at(c, system, k, &push)) continue;
    if (sw_dot(push.normal, bend) < -0.5 * sw_norm(bend)) return turn_at(b, system->x, i);
  }
  return 0;
}

/* A taut wire that goes round something, between two holds: lengths that it lacks, since its edges
 * were drawn as chords of arcs that touches take them for (contact/arc.h), and since they lie on
 * facets as chords [m]; turns at nodes there, and elsewhere [rad]. */
typedef struct around {
  double drawn, facets, on, off;
} around;

static around go_round(const sw_scene *s, const sw_body *b, size_t from, size_t to) {
  const sw_plan *p = b->plan;
  const double *x = sw_scene_system(s)->x;
  around sum = {0};
  double two_back = 0, back = 0; /* such turns at the nodes before [rad] */
  for (size_t i = from + 1; i < to; i++) {
    const double turn = turn_on_facets(s, b, i);
    const int on = turn > 0 || is_on_round(s, b->first_node + i);
    const double least = fmin(fmin(two_back, back), turn);
    if (on && p->drawn_arc) sum.drawn += p->drawn_arc[i] * p->rest[i];
    sum.facets += least * least * p->rest[i] / 12.0;
    *(on ? &sum.on : &sum.off) += turn_at(b, x, i);
    two_back = back, back = turn;
  }
  return sum;
}

/* Returns the part of the tension that may be false for a wire that goes round something, and is
 * straight elsewhere; facets: 1 if most of it comes from facets [N]. */
static double round_tension(const sw_scene *s, const sw_body *b, int *facets) {
  const sw_plan *p = b->plan;
  double most = 0;
  int yields = 0; /* 1: this stretch begins in such a feed */
  for (size_t i = 0, from = p->nodes; i < p->nodes; i++) {
    if (p->held[i] == SW_FREE) continue;
    const int before = yields;
    yields = obeys(s, b, i);
    if (i > from + 1 && !before && !yields) {
      const around sum = go_round(s, b, from, i);
      const double more = b->EA * (sum.drawn + sum.facets) / (p->s[i] - p->s[from]);
      if (sum.off < LITTLE * sum.on && more > most) most = more, *facets = sum.facets > sum.drawn;
    }
    from = i;
  }
  return most;
}

/* A bend by a at one place of a wire under the tension T has the curvature a/2 sqrt(T/EI). Edges h
 * have less by the factor sqrt(1 + T h^2/4 EI): the turns of a chain of hinges decay by exp(-q)
 * from node to node, 2 sinh(q/2) = h sqrt(T/EI), and add up to a. At a clamp it is a sqrt(T/EI),
 * and the hinge of a clamp has 5/12 h (spec/link/taut_bend_spec) [-]. */
static const double BETWEEN = 0.5, CLAMPED = 5.0 / 12;
/* This factor on a radius is told [-]. */
static const double MISSED = 1.15;
/* Bends below BEND are told up to this radius, over the wire's: 1 % of strain. Wider ones matter
 * little [-]. */
static const double WIDEST = 100;
/* Such a bend is at one place if the wire beside it turns by less than this share of its turn: with
 * edges that miss it by MISSED the turns decay by 0.28 to 0.34 from node to node. A wire laid round
 * something turns by as much at each node [-]. */
static const double ALONE = 0.6;

/* 1 if a gentle bend of this curvature is at one place and sharp enough to be told: over this
 * factor sharper than the edges have it. */
static int is_small_layer(const sw_scene *s, const sw_body *b, size_t node, double curvature,
                          double over) {
  const sw_plan *p = b->plan;
  const double *x = sw_scene_system(s)->x;
  if (!(curvature * over * WIDEST * p->beam.radius > 1)) return 0;
  for (size_t i = node < 2 ? 1 : node - 1; i <= node + 1 && i + 1 < p->nodes; i++)
    if (i != node && turn_at(b, x, i) > ALONE * curvature * p->rest[i]) return 0;
  return 1;
}

/* Reports a taut wire whose sharpest bend is at one place, such as a clamp, a slider, a tie or an
 * edge, and sharper than edges can be. */
static void watch_layer(sw_scene *s, const sw_body *b, const sw_scene_wire *w,
                        const sw_extreme *bend, double edge) {
  const sw_plan *p = b->plan;
  const double *tension = sw_system_elastic(sw_scene_system(s), b);
  const size_t e = edge_at(p, bend->s), last = e > 0 ? e - 1 : e;
  const double T = fmax(tension[e], tension[last]);
  const size_t node = e + (bend->s > 0.5 * (p->s[e] + p->s[e + 1]));
  const double length = T > 0 ? sqrt(p->beam.EI / T) : HUGE_VAL;
  const double over = hypot(1.0, (p->held[node] == SW_FREE ? BETWEEN : CLAMPED) * edge / length);
  if (!(over > MISSED) || is_on_round(s, b->first_node + node)) return;
  if (edge * bend->value <= BEND && !is_small_layer(s, b, node, bend->value, over)) return;
  const double at = bend->s - w->mesh.s[0], segments = ceil(p->length / (RESOLVED * length));
  sw_events_go_on(sw_scene_events_of(s), "edges", w->name, sw_scene_time(s));
  sw_scene_tell(
      s, "edges", w->name, at, segments,
      "edges of %.4g mm are too long for the bend of taut wire '%s' at s = %.4g m (%.3g "
      "N): its radius there may be %.3g mm, not %.3g mm, and the moment of a hold there as much "
      "larger; try segments = %.0f",
      1e3 * edge, w->name, at, T, 1e3 / (bend->value * over), 1e3 / bend->value, segments);
}

/* Least true part of a tension that is taken for an advice, over its false part [-]. */
static const double LEAST_TRUE = 0.1;

/* Returns 1 if it has told that edges drawn along a round side are too short, or that facets press
 * chords too far out. The advice that stays is that for the largest tension: the fewest segments.
 */
static int watch_round(sw_scene *s, size_t wire, const sw_wire_extremes *now, double edge) {
  const sw_body *b = &sw_scene_system(s)->bodies[wire];
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double T = now->tension.value, bend = now->curvature.value;
  int facets = 0;
  if (!(T > TAUT * b->plan->beam.EI * bend * bend)) return 0;
  const double more = round_tension(s, b, &facets);
  if (!(more > FALSE_PART * T)) return 0;
  const double allowed = FALSE_PART * fmax(T - more, LEAST_TRUE * more);
  const double segments = ceil((double)b->plan->edges * sqrt(more / allowed));
  sw_event *e = sw_events_go_on(sw_scene_events_of(s), "edges", w->name, sw_scene_time(s));
  if (e && strstr(e->text, "chords") && e->value > segments) e->value = 0;
  sw_scene_tell(s, "edges", w->name, now->tension.s - w->mesh.s[0], segments,
                "edges of %.4g mm of taut wire '%s' %s: if only its stretch sets the tension, %.4g "
                "of its %.4g N may be too much; try segments = %.0f",
                1e3 * edge, w->name,
                facets ? "lie on a round of facets as chords, which is a longer way"
                       : "were drawn along an arc as its chords, and are shorter",
                fmin(more, T), T, segments);
  return 1;
}

static void watch_taut(sw_scene *s, size_t wire, const sw_wire_extremes *now, double edge) {
  const sw_body *b = &sw_scene_system(s)->bodies[wire];
  const double T = now->tension.value, EI = b->plan->beam.EI;
  if (!(T * edge * edge > RESOLVED * RESOLVED * EI)) return;
  const double more = edge * now->curvature.value > BEND ? false_tension(s, b, T) : 0.0;
  if (!(more > FALSE_PART * T)) {
    watch_layer(s, b, sw_scene_wire_in(s, wire), &now->curvature, edge);
    return;
  }
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double segments = ceil(b->plan->length / RESOLVED * sqrt(T / EI));
  const double at = now->curvature.s - w->mesh.s[0];
  sw_events_go_on(sw_scene_events_of(s), "edges", w->name, sw_scene_time(s));
  sw_scene_tell(s, "edges", w->name, at, segments,
                "taut wire '%s' bends within an edge of %.4g mm near s = %.4g m: if only "
                "its stretch sets the tension, %.4g of its %.4g N may be too much; try "
                "segments = %.0f",
                w->name, 1e3 * edge, at, more, T, segments);
}

void sw_scene_watch_edges(sw_scene *s, size_t wire, const sw_wire_extremes *now) {
  const sw_plan *plan = sw_scene_system(s)->bodies[wire].plan;
  const sw_extreme *bend = &now->curvature;
  if (plan->web || !(plan->beam.EI > 0) || !(bend->value > 0)) return;
  const double edge = plan->rest[edge_at(plan, bend->s)];
  if (edge * bend->value <= LONG && !watch_round(s, wire, now, edge))
    watch_taut(s, wire, now, edge);
  if (!(edge * bend->value > LONG)) return;
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double segments = ceil(plan->length * bend->value / FINE), at = bend->s - w->mesh.s[0];
  sw_events_go_on(sw_scene_events_of(s), "edges", w->name, sw_scene_time(s));
  sw_scene_tell(s, "edges", w->name, at, segments,
                "edges of %.4g mm of wire '%s' are too long for its bend of %.4g mm at s = %.4g m: "
                "bends and tensions are off by more than a tenth; try segments = %.0f",
                1e3 * edge, w->name, 1e3 / bend->value, at, segments);
}
