/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the touches of wires in an iterate. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/interrupt.h"
#include "mutual/pairs_curve.h"
#include "touch/lean.h"

/* Returns a new touch of a pair at these places of its segments, or NULL. */
static sw_meet *new_touch(sw_pairs *p, const sw_pair *k, sw_meet_kind kind, const double at[2],
                          const sw_bow bow[2], const int slides[2]) {
  sw_meet *t = sw_meet_new(&p->m);
  if (!t) return NULL;
  t->of = sw_segments(k->one, k->two, k->body);
  t->pair = (uint32_t)(k - p->pairs), t->kind = kind;
  t->reach = k->reach, t->usual = k->usual;
  for (int n = 0; n < 2; n++)
    t->at[n] = at[n], t->bow[n] = bow[n], t->slides[n] = slides[n], t->firm[n] = k->firm[n];
  return t;
}

static sw_status behind_barrier(sw_pairs *p, const sw_system *s, const sw_pair *k, const double *y,
                                int *found) {
  SW_ITEMS(const sw_pair_barrier, b, p->barriers, p->m.barrier_count) {
    if (b->one != k->one || b->two != k->two) continue;
    const sw_bow bow[2] = {sw_pair_bow(s, k, 0, b->at[0]), sw_pair_bow(s, k, 1, b->at[1])};
    const sw_vec d = sw_bows_apart(y, bow);
    const double gap = sw_dot(b->normal, d) - k->reach;
    sw_meet *t = new_touch(p, k, SW_CROSSING, b->at, bow, (int[2]){0, 0});
    if (!t) return SW_ENOMEM;
    *found = t->barred = 1;
    t->aslant = sw_norm(d) - k->reach - gap;
    sw_meet_add(&p->m, s, y, t, gap, b->normal, sw_pair_recall(p, k, b->at, SW_CROSSING),
                sw_pair_last(p, k, b->at, SW_CROSSING));
  }
  return SW_OK;
}

/* Places nearer than this share of an edge are one place. A place at a joint of two segments
 * belongs to the first [-]. */
static const double ONE_PLACE = 1e-6;

static int is_had(const sw_pairs *p, const sw_pair *k, const double at[2]) {
  for (size_t i = p->m.touch_count; i-- > 0;) {
    const sw_pair *other = &p->pairs[p->m.touches[i].pair];
    if (other->one + 1 < k->one) return 0;
    if (other->smooth && sw_pair_between(k, at, other, p->m.touches[i].at) < ONE_PLACE) return 1;
  }
  return 0;
}

/* Returns the bow of a chord's place. At a node between two edges its derivatives are those of
 * both: the wire turns there as much as both do, and with swapped ends as much. */
static sw_bow chord_bow(const sw_system *s, uint32_t body, uint32_t e, double at, int is_node) {
  const sw_body *b = &s->bodies[body];
  const uint32_t node = at > 0.5 ? e + 1 : e;
  const int ends = node == b->first_node || node + 1 == b->first_node + b->plan->nodes;
  if (!is_node || ends) return sw_bow_chord(e, at);
  return (sw_bow){{3, {node - 1, node, node + 1}, {0, 1, 0}}, {-0.5, 0, 0.5}};
}

/* Right after an edit touches are of the kind that they were. A node that lies open beside a
 * pressed one of the other wire must not take that one's force as well: the step would make energy.
 * Its own depth is due to the edges (spec/contact/edges_pair_spec). */
static const sw_met *open_beside(const sw_met *met, sw_meet_kind kind, sw_met *out) {
  if (!met || !met->kept.edited || met->kind == kind) return met;
  *out = *met;
  out->kind = kind, out->emerges = 0;
  out->kept = (sw_kept){.edited = 1};
  return out;
}

/* Adds the touch at given places, unless the wires are apart there. A crossing of smooth wires is
 * on their curves, and a place at a joint counts once. */
static sw_status touch_at(sw_pairs *p, const sw_system *s, const sw_pair *k, const double *y,
                          sw_meet_kind kind, const double at[2], const int slides[2]) {
  const int curved = k->smooth && kind == SW_CROSSING;
  const sw_bow bow[2] = {curved ? sw_pair_bow(s, k, 0, at[0])
                                : chord_bow(s, k->body[0], k->one, at[0], kind == SW_NODE_OF_ONE),
                         curved ? sw_pair_bow(s, k, 1, at[1])
                                : chord_bow(s, k->body[1], k->two, at[1], kind == SW_NODE_OF_TWO)};
  const sw_vec d = sw_bows_apart(y, bow);
  sw_vec normal = curved ? sw_pair_normal(y, bow, slides) : d;
  double distance = curved ? sw_dot(normal, d) : sw_norm(d);
  if (!(distance < (1.0 + SW_LISTED_GAP) * k->reach)) return SW_OK;
  sw_met beside;
  const sw_met *met = open_beside(sw_pair_recall(p, k, at, kind), kind, &beside);
  const sw_meet *last = sw_pair_last(p, k, at, kind);
  if (!curved) normal = sw_unit_or(d, met ? met->normal : sw_v(0, 0, 1));
  sw_meet_side(met, k->reach, &normal, &distance);
  if (curved && is_had(p, k, at)) return SW_OK;
  sw_meet *t = new_touch(p, k, kind, at, bow, slides);
  if (!t) return SW_ENOMEM;
  if (curved) {
    t->steady = met ? met->kept.steady : 0;
    t->square = normal;
    normal = sw_pair_leaning(s, k, y, t, normal, t->steady);
  }
  sw_meet_add(&p->m, s, y, t, distance - k->reach, normal, met, last);
  return SW_OK;
}

static int is_within(double at) { return at > 0 && at < 1; }

static int is_last(const sw_system *s, uint32_t body, uint32_t e) {
  return e + 2 == s->bodies[body].first_node + s->bodies[body].plan->nodes;
}

/* 1 if the nearest point at the segment's end counts for this segment: if the segment starts there,
 * and the previous segment does not come nearer. away: from the other wire to here, along the
 * outward normal. */
static const double ROUNDING = 1e-9; /* [-] */

static int owns_end(const sw_system *s, uint32_t body, uint32_t e, double at, sw_vec away,
                    const double *y) {
  if (at >= 1.0) return is_last(s, body, e);
  if (at > 0.0 || e == s->bodies[body].first_node) return 1;
  const sw_vec before =
      sw_edge_at(y, e - 1); /* rounding must not make both segments leave the point to the other */
  return sw_dot(away, before) <= ROUNDING * sw_norm(away) * sw_norm(before);
}

static sw_status touch_crossing(sw_pairs *p, const sw_system *s, const sw_pair *k,
                                const double *y) {
  double at[2];
  sw_segments_nearest(sw_vec_at(y, k->one), sw_vec_at(y, k->one + 1u), sw_vec_at(y, k->two),
                      sw_vec_at(y, k->two + 1u), at);
  if (k->smooth) {
    int slides[2];
    if (!sw_pair_crossing(s, k, y, at, slides)) return SW_OK;
    return touch_at(p, s, k, y, SW_CROSSING, at, slides);
  }
  const sw_bow bow[2] = {sw_bow_chord(k->one, at[0]), sw_bow_chord(k->two, at[1])};
  const sw_vec away = sw_bows_apart(y, bow);
  if (!owns_end(s, k->body[0], k->one, at[0], away, y) ||
      !owns_end(s, k->body[1], k->two, at[1], sw_neg(away), y))
    return SW_OK;
  return touch_at(p, s, k, y, SW_CROSSING, at, (int[2]){is_within(at[0]), is_within(at[1])});
}

static double along(const double *y, uint32_t e, sw_vec q) {
  const sw_vec u = sw_edge_at(y, e);
  return sw_dot(u, sw_sub(q, sw_vec_at(y, e))) / sw_larger(sw_norm2(u), 1e-300);
}

/* Beside a bend each segment has a nearest place. Within this distance of the joint [-] both are
 * one place, which belongs to the first segment. Further away they are two, for example if the
 * point is the centre of a circle along which the wire runs. */
static const double AT_JOINT = 0.25;

/* 1 if the place along segment e nearest to point q belongs to this segment: inside it, at its
 * first node if the previous segment does not reach that, or beyond the wire's end. */
static int belongs(const sw_system *s, uint32_t body, uint32_t e, const double *y, sw_vec q,
                   double here) {
  if (here >= 1) return is_last(s, body, e);
  if (here >= AT_JOINT || e == s->bodies[body].first_node) return 1;
  const double before = along(y, e - 1, q);
  return before >= 1 || (here > 0 && before < 1 - AT_JOINT);
}

/* A place this near to a joint stays on the segment where it began if its node moves by less than
 * SLOW along the wire in the step. If it changed from iterate to iterate, its depth would jump.
 * Shares of an edge [-]. */
static const double STAYS = 0.1, SLOW = 0.02;

/* 1 if the place of node i, at `here` of segment e, stays on its segment. */
static int stays(const sw_system *s, uint32_t body, uint32_t e, const double *y, uint32_t i,
                 double here) {
  const uint32_t joint = here > 0.5 ? e + 1 : e;
  if (fabs(here - (double)(joint - e)) >= STAYS) return 0;
  const sw_vec now = sw_sub(sw_vec_at(y, i), sw_vec_at(y, joint));
  const sw_vec before = sw_sub(sw_vec_at(s->x, i), sw_vec_at(s->x, joint));
  const sw_body *b = &s->bodies[body];
  return sw_dist(now, before) < SLOW * b->plan->length / (double)b->plan->edges;
}

/* Finds the place along segment e of a wire nearest to node i. Returns 1 if it belongs to this
 * segment. */
static int beside(const sw_system *s, uint32_t body, uint32_t e, const double *y, uint32_t i,
                  double *at) {
  const sw_vec q = sw_vec_at(y, i), q0 = sw_vec_at(s->x, i);
  const double here = along(y, e, q);
  *at = sw_smaller(1.0, sw_larger(0.0, here));
  if (!stays(s, body, e, y, i, here)) return belongs(s, body, e, y, q, here);
  return belongs(s, body, e, s->x, q0, along(s->x, e, q0));
}

/* Adds the touches of parallel segments: each segment's first node against the other one, and at a
 * wire's end its last node too. */
static sw_status touch_parallel(sw_pairs *p, const sw_system *s, const sw_pair *k,
                                const double *y) {
  const uint32_t ends[2] = {1u + (uint32_t)is_last(s, k->body[0], k->one),
                            1u + (uint32_t)is_last(s, k->body[1], k->two)};
  double at[2];
  for (uint32_t end = 0; end < ends[0]; end++)
    if (beside(s, k->body[1], k->two, y, k->one + end, &at[1])) {
      at[0] = end;
      SW_TRY(touch_at(p, s, k, y, SW_NODE_OF_ONE, at, (int[2]){0, is_within(at[1])}));
    }
  for (uint32_t end = 0; end < ends[1]; end++)
    if (beside(s, k->body[0], k->one, y, k->two + end, &at[0])) {
      at[1] = end;
      SW_TRY(touch_at(p, s, k, y, SW_NODE_OF_TWO, at, (int[2]){is_within(at[0]), 0}));
    }
  return SW_OK;
}

/* Keeps the place of touches that pushed in the previous iterate: nearest places come and go where
 * wires lie along each other, or pass to the next segment. first: the first touch found in this
 * iterate. */
static sw_status keep_pushing(sw_pairs *p, const sw_system *s, const sw_pair *k, const double *y,
                              size_t first) {
  for (size_t i = k->last; i < k->last_end; i++) {
    const sw_meet *last = &p->m.last[i];
    int found = 0;
    if (!(last->press.normal_force > 0)) continue;
    for (size_t j = first; j < p->m.touch_count; j++)
      found |= sw_pair_is_same(k, last->at, k, p->m.touches[j].at);
    if (!found) SW_TRY(touch_at(p, s, k, y, last->kind, last->at, (int[2]){0, 0}));
  }
  return SW_OK;
}

/* Gives each pair its touches of the previous iterate. Both are in the same order. */
static void match_last(sw_pairs *p) {
  size_t i = 0;
  for (size_t k = 0; k < p->m.pair_count; k++) {
    p->pairs[k].last = i;
    while (i < p->m.last_count && p->m.last[i].pair == k) i++;
    p->pairs[k].last_end = i;
  }
}

sw_status sw_pairs_find(sw_mutual *m, const sw_system *s, const double *y) {
  sw_pairs *p = sw_pairs_of(m);
  match_last(p);
  SW_ITEMS(const sw_pair, k, p->pairs, m->pair_count) {
    int found = 0;
    if (k->held) continue;
    if (sw_interrupted()) return SW_EINTR;
    if (m->barrier_count) SW_TRY(behind_barrier(p, s, k, y, &found));
    if (found) continue;
    const size_t first = m->touch_count;
    SW_TRY((k->parallel ? touch_parallel : touch_crossing)(p, s, k, y));
    if (!k->parallel && !k->smooth && m->regime != SW_CONTACT_EXPLICIT)
      SW_TRY(keep_pushing(p, s, k, y, first));
  }
  return SW_OK;
}
