/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes on curves: places, stops at the ends, and motion from stage to stage. */
#include "system/rail.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "system/rail_inner.h"

/* An update is the last one if the curve leaves its tangent by less than this share of an edge;
 * this is the error of the edge's strain. With a hundred times this share, a stiff wire's tension
 * was off by 1e-3 [-]. */
static const double STRAIGHT = 1e-10;

size_t sw_rail_freedom(const sw_system *s, size_t k) { return 3 * s->nodes + s->rolls + k; }

sw_status sw_system_set_rails(sw_system *s, const sw_rail *rails, size_t count) {
  if (!count) return SW_OK;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(s->rails, count),
                      SW_ROOM(s->rail_room, count * (4 * s->nodes + count + 1) + 4 * s->nodes)));
  memcpy(s->rails, rails, count * sizeof *rails);
  for (size_t k = 0; k < count; k++) {
    const size_t at = sw_rail_freedom(s, k);
    s->x[at] = rails[k].p, s->v[at] = rails[k].v, s->a[at] = rails[k].a;
    s->held[rails[k].held].rail = k + 1;
  }
  return SW_OK;
}

/* --- places of nodes --------------------------------------------------------------- */

/* Computes place, velocity and acceleration (each may be NULL) of a rail's node from its arc
 * length, rate and acceleration p. */
static void place(const sw_system *s, const sw_rail *r, const double p[3], double *x, double *v,
                  double *a) {
  const sw_hold_state *h = &s->hold_states[sw_rail_node(s, r)->hold];
  sw_rail_point c;
  r->at(r->curve, p[0], &c);
  const sw_vec arm = sw_rotate(h->pose.q, c.x), along = sw_rotate(h->pose.q, c.along);
  const sw_vec spin = sw_cross(h->omega, arm), bend = sw_rotate(h->pose.q, c.bend);
  if (x) sw_store(x, sw_add(h->pose.p, arm));
  if (v) sw_store(v, sw_madd(sw_add(h->v, spin), along, p[1]));
  if (!a) return;
  sw_vec sum = sw_add(h->a, sw_add(sw_cross(h->alpha, arm), sw_cross(h->omega, spin)));
  sum = sw_madd(sw_madd(sum, along, p[2]), bend, p[1] * p[1]);
  sw_store(a, sw_madd(sum, sw_cross(h->omega, along), 2.0 * p[1]));
}

void sw_rails_place(const sw_system *s, const double *x, double *v, double *a, double *to) {
  for (size_t k = 0; k < s->rail_count; k++) {
    const size_t at = sw_rail_freedom(s, k), node = 3 * sw_rail_node(s, &s->rails[k])->node;
    const double p[3] = {x[at], v ? v[at] : 0.0, a ? a[at] : 0.0};
    place(s, &s->rails[k], p, to ? to + node : NULL, v ? v + node : NULL, a ? a + node : NULL);
  }
}

static int stops(const sw_rail *r, double p, double v) {
  return (p <= r->from && v < 0) || (p >= r->to && v > 0);
}

void sw_rails_launch(sw_system *s, size_t body, sw_vec v, sw_vec omega, sw_vec about) {
  for (size_t k = 0; k < s->rail_count; k++) {
    const sw_rail *r = &s->rails[k];
    const size_t at = sw_rail_freedom(s, k), node = 3 * sw_rail_node(s, r)->node;
    double p[3] = {s->x[at], 0, 0}, *rate = s->v + node;
    if (sw_rail_node(s, r)->body != body) continue;
    sw_rail_point c;
    r->at(r->curve, p[0], &c);
    place(s, r, p, NULL, rate, NULL);
    const sw_vec along = sw_rotate(s->hold_states[sw_rail_node(s, r)->hold].pose.q, c.along);
    const sw_vec given = sw_add(v, sw_cross(omega, sw_sub(sw_load(s->x + node), about)));
    p[1] = sw_dot(along, sw_sub(given, sw_load(rate)));
    s->v[at] = p[1] = stops(r, p[0], p[1]) ? 0 : p[1];
    place(s, r, p, NULL, rate, NULL);
  }
}

static double rate_of(const sw_stage *stage, int statics) {
  return statics || !isfinite(stage->hbar) ? 0.0 : 1.0 / stage->hbar;
}

/* p = arc length, speed and acceleration of the iterate. */
static void iterate_of(const sw_system *s, const sw_stage *stage, int statics, size_t k,
                       double p[3]) {
  const size_t at = sw_rail_freedom(s, k);
  const double rate = rate_of(stage, statics), inertia = stage->inertia > 0 ? stage->inertia : 1.0;
  p[0] = stage->y[at];
  p[1] = (stage->y[at] - stage->xhat[at]) * rate;
  p[2] = (stage->y[at] - s->yhat[at]) * rate * rate * inertia;
}

static void follow(sw_system *s, const sw_stage *stage, int statics, size_t k) {
  sw_rail *r = &s->rails[k];
  const size_t node = 3 * sw_rail_node(s, r)->node;
  const sw_quat q = s->hold_states[sw_rail_node(s, r)->hold].pose.q;
  const double rate = rate_of(stage, statics), inertia = stage->inertia > 0 ? stage->inertia : 1.0;
  double p[3], a[3];
  sw_rail_point c;
  iterate_of(s, stage, statics, k, p);
  place(s, r, p, stage->y + node, NULL, a);
  r->at(r->curve, p[0], &c);
  r->along = sw_rotate(q, c.along), r->bend = sw_rotate(q, c.bend);
  if (rate > 0) {
    for (size_t i = 0; i < 3; i++)
      s->yhat[node + i] = stage->y[node + i] - a[i] / (rate * rate * inertia);
    return;
  }
  const double start[3] = {stage->xhat[sw_rail_freedom(s, k)]};
  place(s, r, start, s->yhat + node, NULL, NULL);
}

void sw_rails_follow(sw_system *s, const sw_stage *stage, int statics) {
  for (size_t k = 0; k < s->rail_count; k++)
    if (sw_rail_is_part(s, &s->rails[k])) follow(s, stage, statics, k);
}

/* A free flight beyond an end stops there too. */
static void keep_between(const sw_rail *r, double *p) { *p = fmin(fmax(*p, r->from), r->to); }

void sw_rails_begin(sw_system *s, const sw_stage *stage, int statics) {
  for (size_t k = 0; k < s->rail_count; k++) {
    sw_rail *r = &s->rails[k];
    const size_t at = sw_rail_freedom(s, k);
    const double v = statics ? 0.0 : s->v[at];
    r->state = r->friction > 0 && v == 0 ? SW_RAIL_STICKS : SW_RAIL_GOES;
    r->way = v < 0 ? -1.0 : 1.0;
    r->step = 0, r->open = 0;
    if (r->state == SW_RAIL_STICKS) stage->y[at] = stage->xhat[at];
    keep_between(r, &stage->y[at]);
    if (stage->y[at] == r->from && r->friction == 0) r->state = SW_RAIL_AT_FROM;
    if (stage->y[at] == r->to && r->friction == 0) r->state = SW_RAIL_AT_TO;
    follow(s, stage, statics, k);
  }
}

void sw_rails_velocity(const sw_system *s, const sw_stage *stage, double *velocity) {
  for (size_t k = 0; k < s->rail_count; k++) {
    double p[3];
    iterate_of(s, stage, 0, k, p);
    if (sw_rail_is_part(s, &s->rails[k]))
      place(s, &s->rails[k], p, NULL, velocity + 3 * sw_rail_node(s, &s->rails[k])->node, NULL);
  }
}

void sw_rails_finish(sw_system *s, const sw_stage *stage) {
  for (size_t k = 0; k < s->rail_count; k++) {
    sw_rail *r = &s->rails[k];
    sw_held_node *h = &s->held[r->held];
    const size_t at = sw_rail_freedom(s, k);
    h->reaction = sw_add(h->reaction, sw_rail_times(r->own, sw_load(s->delta + 3 * h->node)));
    const double p[3] = {stage->y[at], stage->v[at], 0.0};
    place(s, r, p, NULL, stage->v + 3 * h->node, NULL);
    r->force = sw_dot(r->along, h->reaction);
    r->rubs = -r->way * r->friction * sw_norm(sw_rail_across(r, h->reaction));
  }
}

/* 1 if the curve leaves its tangent in the step by more than the accepted error of the edges beside
 * it. */
static int is_long(const sw_system *s, const sw_rail *r) {
  const sw_held_node *h = sw_rail_node(s, r);
  const sw_body *b = &s->bodies[h->body];
  const size_t i = h->node - b->first_node;
  const double edge = b->plan->rest[i < b->plan->edges ? i : i - 1];
  return 0.5 * sw_norm(r->bend) * r->step * r->step > STRAIGHT * edge;
}

void sw_rails_apply(sw_system *s, const sw_stage *stage, double share) {
  for (size_t k = 0; k < s->rail_count; k++) {
    sw_rail *r = &s->rails[k];
    const size_t at = sw_rail_freedom(s, k);
    if (!sw_rail_is_part(s, r)) continue;
    stage->y[at] += share * r->step;
    if (share == 1.0 && r->state == SW_RAIL_STICKS) stage->y[at] = stage->xhat[at];
    keep_between(r, &stage->y[at]);
  }
}

int sw_rails_settled(const sw_system *s) {
  for (size_t k = 0; k < s->rail_count; k++)
    if (sw_rail_is_part(s, &s->rails[k]) && (s->rails[k].open || is_long(s, &s->rails[k])))
      return 0;
  return 1;
}

int sw_rails_struck(const sw_system *s) {
  for (size_t k = 0; k < s->rail_count; k++) {
    const sw_rail *r = &s->rails[k];
    const size_t at = sw_rail_freedom(s, k);
    const int was_at_end = s->v[at] == 0 && (s->x[at] == r->from || s->x[at] == r->to);
    if (r->state == SW_RAIL_GOES ? was_at_end : s->v[at] != 0) return 1;
  }
  return 0;
}
