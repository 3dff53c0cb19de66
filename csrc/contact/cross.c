/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crossings: a swept test finds parts of wires that passed through an obstacle within the step. A
 * barrier then keeps them on their old side for the rest of the step. */
#include "contact/cross.h"

#include <math.h>

#include "base/alloc.h"
#include "base/halving.h"

/* A segment that moves by less than this share of its skin cannot pass anything [-]. */
static const double SAFE_SHIFT = 0.5;

static int has_barrier(const sw_contact *c, const sw_barrier *new, size_t *looks) {
  for (uint32_t i = c->barrier_at[new->node]; i; i = c->barriers[i - 1].before) {
    const sw_barrier *b = &c->barriers[i - 1];
    ++*looks;
    if (b->obstacle == new->obstacle &&
        b->segment == new->segment &&sw_dot(b->normal, new->normal) > 0.99)
      return 1;
  }
  return 0;
}

const sw_barrier *sw_contact_barrier(const sw_contact *c, int obstacle, size_t node, int segment) {
  const sw_barrier *first = NULL;
  for (uint32_t i = c->barrier_at[node]; i; i = c->barriers[i - 1].before) {
    const sw_barrier *b = &c->barriers[i - 1];
    if (b->obstacle == obstacle && b->segment == segment) first = b;
  }
  return first;
}

static void add_barrier(sw_contact *c, sw_barrier *b) {
  b->before = c->barrier_at[b->node];
  c->barriers[c->barrier_count++] = *b;
  c->barrier_at[b->node] = (uint32_t)c->barrier_count;
}

/* 1 if the node is a candidate with this obstacle. Candidates are sorted by node. */
static int is_candidate(const sw_contact *c, int obstacle, size_t node, size_t *looks) {
  size_t i;
  SW_FIRST_NOT((++*looks, c->candidates[i].node < node), i, 0, c->candidate_count);
  for (; i < c->candidate_count && c->candidates[i].node == node; i++)
    if (c->candidates[i].obstacle == obstacle && !c->candidates[i].segment) return 1;
  return 0;
}

/* A hit this near to a segment's end belongs to the node [-]. */
static const double END_SHARE = 1e-6;

/* Keeps a segment on its old side for the rest of the step. Returns 1 if the barrier is new. */
static int raise_barrier(sw_contact *c, sw_system *s, const sw_candidate *k, const sw_closest *hit,
                         double h) {
  sw_contact_note_crossing(c, s, k, hit);
  sw_barrier b = {.obstacle = k->obstacle,
                  .segment = k->segment,
                  .node = k->node,
                  .other = k->other,
                  .at = hit->at,
                  .normal = hit->normal,
                  .point = hit->point};
  const size_t end = hit->at > 0.5 ? k->other : k->node;
  if ((hit->at < END_SHARE || hit->at > 1.0 - END_SHARE) &&
      is_candidate(c, k->obstacle, end, &s->counters.looks)) {
    b.node = b.other = end;
    b.segment = 0;
    b.at = 0;
  }
  if (has_barrier(c, &b, &s->counters.looks)) return 0;
  if (SW_GROW(c->barriers, c->barrier_capacity, c->barrier_count + 1) != SW_OK) return 0;
  add_barrier(c, &b);
  const sw_candidate at = {
      .segment = b.segment, .node = b.node, .other = b.other, .body = k->body, .smooth = k->smooth};
  const sw_pose *pose = &c->now[k->obstacle].pose;
  const sw_touch t = {.obstacle = k->obstacle,
                      .segment = b.segment,
                      .node = b.node,
                      .other = b.other,
                      .body = k->body,
                      .at = b.at,
                      .spot = sw_contact_spot(s, &at, b.at),
                      .local = hit->point,
                      .press = {.normal = sw_rotate(pose->q, hit->normal)}};
  if (h > 0) sw_contact_strike(c, s, &t, h);
  return 1;
}

/* A crossing of an obstacle by a piece of a candidate, taken as straight. */
typedef struct crossing {
  sw_closest hit;
  double when; /* share of the step [-] */
} crossing;

static int cross_part(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                      const double *x1, double from, double to, crossing *out) {
  const sw_pose *p0 = &c->start[k->obstacle].pose, *p1 = &c->now[k->obstacle].pose;
  const sw_mean a = sw_contact_spot(s, k, from), b = sw_contact_spot(s, k, to);
  const sw_vec a0 = sw_pose_local(*p0, sw_mean_place(c, s->x, &a));
  const sw_vec b0 = sw_pose_local(*p0, sw_mean_place(c, s->x, &b));
  const sw_vec a1 = sw_pose_local(*p1, sw_mean_place(c, x1, &a));
  const sw_vec b1 = sw_pose_local(*p1, sw_mean_place(c, x1, &b));
  const double shift2 = fmax(sw_norm2(sw_sub(a1, a0)), sw_norm2(sw_sub(b1, b0)));
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  if (shift2 < SAFE_SHIFT * SAFE_SHIFT * k->skin * k->skin) return 0;
  if (!sw_shape_sweep(shape, a0, b0, a1, b1, 0.0, &out->hit, &out->when)) return 0;
  out->hit.at = from + out->hit.at * (to - from);
  return 1;
}

/* Bounds of the obstacle over the step, in world axes. The swept test assumes straight paths, so
 * the box of a moving obstacle is wide enough for any turn. */
static sw_bounds passed(const sw_contact *c, size_t o) {
  if (!c->broad.moves[o]) return c->bounds[o];
  const sw_bounds own = sw_shape_bounds(c->obstacles[o].shape);
  const sw_vec corner =
      sw_v(fmax(-own.min.x, own.max.x), fmax(-own.min.y, own.max.y), fmax(-own.min.z, own.max.z));
  const sw_contact_at *from = &c->start[o], *to = &c->now[o];
  const double way = fmax(sw_dist(from->pose.p, to->pose.p), sw_norm(from->v) * c->h);
  const double most = sw_norm(corner) + 2.0 * way;
  const sw_vec wide = sw_v(most, most, most);
  return (sw_bounds){sw_sub(from->pose.p, wide), sw_add(from->pose.p, wide)};
}

static void widen(sw_bounds *b, sw_vec p) {
  b->min = sw_v(p.x < b->min.x ? p.x : b->min.x, p.y < b->min.y ? p.y : b->min.y,
                p.z < b->min.z ? p.z : b->min.z);
  b->max = sw_v(p.x > b->max.x ? p.x : b->max.x, p.y > b->max.y ? p.y : b->max.y,
                p.z > b->max.z ? p.z : b->max.z);
}

int sw_contact_stays_away(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                          const double *x1) {
  const sw_body *b = &s->bodies[k->body];
  const sw_bounds box = passed(c, (size_t)k->obstacle);
  const size_t last = b->first_node + b->plan->nodes - 1;
  const size_t list[4] = {k->node, k->other, k->node > b->first_node ? k->node - 1 : k->node,
                          k->other < last ? k->other + 1 : k->other};
  const sw_vec first = sw_contact_where(c, x1, k->node, k->node, 0);
  sw_bounds way = {first, first};
  for (size_t i = 0; i < (k->smooth ? 4 : 2); i++) {
    widen(&way, sw_contact_where(c, x1, list[i], list[i], 0));
    widen(&way, sw_contact_where(c, s->x, list[i], list[i], 0));
  }
  return way.min.x > box.max.x || way.max.x < box.min.x || way.min.y > box.max.y ||
         way.max.y < box.min.y || way.min.z > box.max.z || way.max.z < box.min.z;
}

/* Raises a barrier at the earlier crossing of the two halves of the curve's piece. For a wire round
 * a peg the edges are tested instead: the halves cut the peg, the edges do not. */
static int cross(sw_contact *c, sw_system *s, const sw_candidate *k, const double *x1, double h) {
  crossing one, two;
  if ((k->smooth || c->broad.moves[k->obstacle]) && sw_contact_stays_away(c, s, k, x1)) return 0;
  if (!k->smooth || k->round) {
    sw_candidate edge = *k;
    edge.smooth = 0;
    return cross_part(c, s, &edge, x1, 0.0, 1.0, &one) && raise_barrier(c, s, &edge, &one.hit, h);
  }
  const int first = cross_part(c, s, k, x1, 0.0, 0.5, &one);
  const int second = cross_part(c, s, k, x1, 0.5, 1.0, &two);
  if (!first && !second) return 0;
  const int earlier = first && (!second || one.when <= two.when);
  return raise_barrier(c, s, k, earlier ? &one.hit : &two.hit, h);
}

/* 1 if the candidate is a particle that may touch its obstacle without its edges: pads touch meshes
 * by particles only (contact/pads.c). A particle without a skin would pass into a pad that closes
 * within the step, and remain there unnoticed: pads touched the next corners, or missed the wire
 * (spec/contact/pads_sweep_spec). */
static int is_lone(const sw_contact *c, const sw_system *s, const sw_candidate *k) {
  return !k->segment && c->obstacles[k->obstacle].grips > 0 && s->bodies[k->body].plan->web;
}

int sw_contact_cross(sw_contact *c, sw_system *s, const double *x1, double h) {
  int changed = 0;
  for (size_t i = 0; i < c->candidate_count; i++) {
    const sw_candidate *k = &c->candidates[i];
    if (!k->segment && !is_lone(c, s, k)) continue;
    changed |= cross(c, s, k, x1, h);
  }
  return changed;
}
