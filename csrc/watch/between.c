/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports a bent rod whose largest tension lies between two holds that are within three edges of
 * each other. So little wire cannot yield along itself: its tension is EA times the strain that is
 * left after its bends are shared out between nodes, and these are right to some part of EI/R^2. */
#include <math.h>

#include "link/hold.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "system/axial.h"
#include "system/system.h"
#include "watch/observe.h"

/* Holds are near up to this many edges [-]. */
static const double NEAR = 3.0;
/* The false part of the tension between holds of which one holds the place only, over EI/R^2
 * beside them [-]. Between two that hold the direction it is below 0.05 and made no peaks
 * (spec/link/between_holds_spec). */
static const double FALSE_PART = 0.4;
/* The part of a tension that is told [-]. */
static const double TOLD = 0.1;
/* Bends up to so many nodes beside them count [-]. */
enum { BESIDE = 4 };
/* Smaller tensions than this share of the run's largest are not looked at [-]. */
static const double LARGEST = 0.9;

/* Returns the next node from i on that a hold holds; the wire's end if there is none. */
static size_t held_node(const sw_plan *p, size_t i, int side) {
  const size_t end = side > 0 ? p->nodes - 1 : 0;
  while (p->held[i] == SW_FREE && i != end) i = side > 0 ? i + 1 : i - 1;
  return i;
}

/* Bend at an inner node [1/m]. */
static double bend_at(const sw_body *b, const double *x, size_t i) {
  const double *at = x + 3 * (b->first_node + i);
  const sw_vec zero = sw_v(0, 0, 0), here = sw_load(at);
  if (i == 0 || i + 1 >= b->plan->nodes) return 0;
  const sw_vec before = sw_unit_or(sw_sub(here, sw_load(at - 3)), zero);
  const sw_vec after = sw_unit_or(sw_sub(sw_load(at + 3), here), zero);
  return 2.0 * sw_dist(before, after) / (b->plan->rest[i - 1] + b->plan->rest[i]);
}

/* Returns the hold of a held node; NULL: none. */
static const sw_hold *hold_at(sw_scene *s, size_t wire, double place) {
  SW_EACH(hold, h, s)
    if (h->alive && h->wire == wire && h->s1 <= place && place <= h->s2) return h;
  return NULL;
}

/* Returns the larger tension of the edges before node i and after node j; at least 0 [N]. A false
 * tension is not passed on to them: pins bear it. */
static double beside_of(const double *T, const sw_plan *p, size_t i, size_t j) {
  return fmax(i > 0 ? fmax(0.0, T[i - 1]) : 0.0, j < p->edges ? T[j] : 0.0);
}

void sw_scene_watch_between(sw_scene *s, size_t wire, const sw_wire_extremes *now) {
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const sw_plan *p = b->plan;
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double T = now->tension.value;
  if (p->web || !(p->beam.EI > 0) || !(T > 0)) return;
  if (T < LARGEST * w->extremes.tension.value) return;
  double edge = 0;
  for (size_t k = 0; k < p->edges; k++) edge = fmax(edge, p->rest[k]);
  size_t e = 0;
  while (e + 1 < p->edges && p->s[e + 1] <= now->tension.s) e++;
  const size_t i = held_node(p, e, -1), j = held_node(p, e + 1, 1);
  if (!(p->s[j] - p->s[i] < NEAR * edge)) return;
  const sw_hold *one = hold_at(s, wire, p->s[i]), *two = hold_at(s, wire, p->s[j]);
  if (!one || !two || one == two) return;
  if (one->cls->hold->direction && two->cls->hold->direction) return;
  double bend = 0;
  for (size_t k = i > BESIDE ? i - BESIDE : 0; k <= j + BESIDE && k < p->nodes; k++)
    bend = fmax(bend, bend_at(b, system->x, k));
  const double beside = beside_of(sw_system_pull(system, b), p, i, j);
  const double error = fmin(FALSE_PART * p->beam.EI * bend * bend, T - beside);
  if (!(error > TOLD * T)) return;
  sw_events_go_on(sw_scene_events_of(s), "edges", w->name, sw_scene_time(s));
  sw_scene_tell(s, "edges", w->name, now->tension.s - w->mesh.s[0], error,
                "the largest tension of wire '%s', %.3g N, is between two holds %.3g mm "
                "(%.3g edges) apart: %.2g N of it may be false",
                w->name, T, 1e3 * (p->s[j] - p->s[i]), (p->s[j] - p->s[i]) / edge, error);
}
