/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the turn of holds and joints against one another when a wire gets other edges. A curve
 * through the nodes turns a carried vector a little more or less than the chords did; the twist
 * makes up for that. */
#include "body/other_edges.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "body/join.h"
#include "link/hold.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/hinge.h"
#include "state/mesh.h"

/* Carries a vector across `from`, the direction held at node a, along the edges to `to`, the
 * direction held at node b. */
static sw_vec carry(const sw_mesh *m, size_t a, size_t b, sw_vec u, sw_vec from, sw_vec to) {
  sw_vec before = from;
  for (size_t i = a; i < b; i++) {
    const sw_vec t = sw_unit_or(sw_sub(sw_vec_at(m->x, i + 1), sw_vec_at(m->x, i)), sw_v(1, 0, 0));
    u = sw_carry_unit(u, before, t);
    before = t;
  }
  return sw_carry_unit(u, before, to);
}

static sw_vec carry_along(const sw_mesh *m, size_t a, size_t b, sw_vec from, sw_vec to) {
  return carry(m, a, b, sw_perpendicular(from), from, to);
}

/* Returns the wire's direction at a living hold's end s, where the wire leaves or arrives, or at a
 * joint that ends its twist; 0: none. */
static sw_vec held_direction(const sw_scene *s, size_t wire, double at, int leaves) {
  const sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh;
  SW_EACH(hold, h, s) {
    if (h->alive && h->wire == wire && h->cls->hold->direction && (leaves ? h->s2 : h->s1) == at)
      return sw_rotate(h->turn, h->director[leaves]);
  }
  if (sw_scene_stop_at(s, wire, at)) return sw_mesh_tangent(m, sw_mesh_node(m, at));
  return sw_v(0, 0, 0);
}

void sw_scene_correct_twist(sw_scene *s, size_t wire, const sw_mesh *old) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const sw_mesh *fresh = &w->mesh;
  SW_ITEMS(sw_twisted, span, w->twisted, w->twisted_count) {
    const sw_vec from = held_direction(s, wire, span->s1, 1);
    const sw_vec to = held_direction(s, wire, span->s2, 0);
    if (!(sw_norm(from) > 0) || !(sw_norm(to) > 0)) continue; /* it has just gone */
    const sw_vec u =
        carry_along(old, sw_mesh_node(old, span->s1), sw_mesh_node(old, span->s2), from, to);
    const sw_vec v =
        carry_along(fresh, sw_mesh_node(fresh, span->s1), sw_mesh_node(fresh, span->s2), from, to);
    span->twist -= atan2(sw_dot(sw_cross(u, v), to), sw_dot(u, v));
  }
}

/* Carries a vector from s1 to s2; across the ends of a hold in between, if there is one. */
static sw_vec carry_past(const sw_mesh *m, const sw_hold *h, double s1, double s2, sw_vec u,
                         sw_vec from, sw_vec to) {
  if (!h) return carry(m, sw_mesh_node(m, s1), sw_mesh_node(m, s2), u, from, to);
  const sw_vec in = sw_rotate(h->turn, h->director[0]), out = sw_rotate(h->turn, h->director[1]);
  u = carry(m, sw_mesh_node(m, s1), sw_mesh_node(m, h->s1), u, from, in);
  u = sw_carry_unit(u, in, out);
  return carry(m, sw_mesh_node(m, h->s2), sw_mesh_node(m, s2), u, out, to);
}

void sw_scene_correct_hold(const sw_scene *s, const sw_hold *h, const sw_mesh *old, int comes) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
  sw_twisted *first = NULL, *last = NULL;
  SW_ITEMS(sw_twisted, t, w->twisted, w->twisted_count) {
    if (comes ? t->s1 <= h->s1 && h->s2 <= t->s2 : t->s2 == h->s1 && t->s1 < t->s2) first = t;
    if (comes ? t == first : t->s1 == h->s2 && t->s1 < t->s2) last = t;
  }
  if (!first || !last) return;
  const sw_vec from = held_direction(s, h->wire, first->s1, 1);
  const sw_vec to = held_direction(s, h->wire, last->s2, 0), start = sw_perpendicular(from);
  if (!(sw_norm(from) > 0) || !(sw_norm(to) > 0)) return;
  const sw_vec u = carry_past(old, comes ? NULL : h, first->s1, last->s2, start, from, to);
  const sw_vec v = carry_past(&w->mesh, comes ? h : NULL, first->s1, last->s2, start, from, to);
  last->twist -= atan2(sw_dot(sw_cross(u, v), to), sw_dot(u, v));
}

/* --- a scene that is built ------------------------------------------------------------ */

/* Returns the director of a span's end, a clamp or a joint, at the last places. */
static sw_vec director_of(const sw_system *s, const sw_plan *p, size_t end) {
  return sw_load(s->directors_now + 3 * sw_clamp_place(&p->clamps[end]));
}

/* Returns a direction across the director that turns with the joint there; zero for a clamp, and
 * for a joint in line, which has no turn of its own. */
static sw_vec mark_of(const sw_system *s, const sw_plan *p, size_t end) {
  const sw_join_hub *hub;
  if (end < p->clamp_count) return sw_v(0, 0, 0);
  const struct sw_join_arm *arm = sw_join_arm_at(s, &p->clamps[end], &hub);
  return hub->line ? sw_v(0, 0, 0) : sw_rotate(hub->now, sw_perpendicular(arm->rest));
}

/* Returns the turn about the director `to` from a mark to another, carried along from `from`. */
static double own_turn(sw_vec mark, sw_vec from, sw_vec now, sw_vec to) {
  const sw_vec u = sw_carry_unit(mark, from, to);
  return sw_norm(mark) > 0 ? atan2(sw_dot(sw_cross(u, now), to), sw_dot(u, now)) : 0.0;
}

static struct sw_span_end end_of(const sw_system *s, const sw_plan *p, const sw_span *span) {
  return (struct sw_span_end){p->s[span->first],
                              p->s[span->last + 1],
                              director_of(s, p, span->left),
                              director_of(s, p, span->right),
                              {mark_of(s, p, span->left), mark_of(s, p, span->right)}};
}

sw_status sw_scene_read_spans(sw_scene *s, size_t wire, sw_span_ends *out) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const size_t n = b->plan->nodes;
  *out = (sw_span_ends){.mesh.n = n};
  if (!b->has_twist) return SW_OK;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(out->mesh.s, n), SW_ROOM(out->mesh.x, 3 * n),
                      SW_ROOM(out->span, b->plan->span_count)));
  memcpy(out->mesh.s, b->plan->s, n * sizeof *out->mesh.s);
  memcpy(out->mesh.x, system->x + 3 * b->first_node, 3 * n * sizeof *out->mesh.x);
  sw_system_follow(system, system->x); /* places the joints' directors */
  SW_ITEMS(const sw_span, span, b->plan->spans, b->plan->span_count) {
    out->span[out->count++] = end_of(system, b->plan, span);
  }
  return SW_OK;
}

static const double SAME_PLACE = 1e-9; /* of the wire's length [-] */

/* Returns the change of a span's twist with the edges, from `was` to `is`. */
static double change_of(const sw_mesh *old, const struct sw_span_end *was, const sw_mesh *now,
                        const struct sw_span_end *is) {
  const sw_vec start = sw_perpendicular(was->from),
               begin = sw_carry_unit(start, was->from, is->from);
  const sw_vec u =
      carry(old, sw_mesh_node(old, was->s1), sw_mesh_node(old, was->s2), start, was->from, was->to);
  const sw_vec v =
      carry(now, sw_mesh_node(now, is->s1), sw_mesh_node(now, is->s2), begin, is->from, is->to);
  return own_turn(was->mark[1], was->to, is->mark[1], is->to) -
         own_turn(was->mark[0], was->from, is->mark[0], is->from) - own_turn(u, was->to, v, is->to);
}

void sw_scene_turn_spans(sw_scene *s, size_t wire, const sw_span_ends *old) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const sw_plan *p = b->plan;
  const sw_mesh now = {.n = p->nodes, .s = p->s, .x = system->x + 3 * b->first_node};
  if (b->has_twist) sw_system_follow(system, system->x);
  for (size_t k = 0; b->has_twist && k < p->span_count; k++) {
    const struct sw_span_end is = end_of(system, p, &p->spans[k]);
    SW_ITEMS(const struct sw_span_end, was, old->span, old->count) {
      const double off = fmax(fabs(was->s1 - is.s1), fabs(was->s2 - is.s2));
      if (off <= SAME_PLACE * p->length)
        system->twist[b->first_span + k] += change_of(&old->mesh, was, &now, &is);
    }
  }
}

void sw_span_ends_free(sw_span_ends *ends) {
  SW_FREE_ALL(ends->mesh.s, ends->mesh.x, ends->span);
  *ends = (sw_span_ends){0};
}
