/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of an iterate, their forces and stiffness. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "contact/lean.h"
#include "contact/pairs_curve.h"

/* A tangential vector that went with normal from, taken along to normal to. */
static sw_vec carry(sw_vec v, sw_vec from, sw_vec to) {
  const double share = sw_dot(to, v) / fmax(1.0 + sw_dot(from, to), 1e-12);
  return sw_madd(v, sw_add(from, to), -share);
}

/* --- touches --------------------------------------------------------------------- */

/* How much of a place moves with nodes that nothing holds; *held: where it is held [-], [m]. */
static double free_share(const sw_system *s, uint32_t body, uint32_t e, double at, sw_vec *held) {
  const sw_body *b = &s->bodies[body];
  const int *is = b->plan->held + (e - b->first_node);
  const int one = is[0] != SW_FREE, two = is[1] != SW_FREE;
  const sw_vec start = sw_vec_at(s->x, e), end = sw_vec_at(s->x, e + 1u);
  *held = one && two ? sw_lerp(start, end, at) : one ? start : end;
  return (one ? 0.0 : 1.0 - at) + (two ? 0.0 : at);
}

/* Where wires are held side by side, their axes nearer than their radii, no force takes them
 * apart: what that leaves of depth beside the holds [m]. */
static double imposed(const sw_system *s, const sw_pair *k, const double at[2]) {
  sw_vec a, b;
  const double one = free_share(s, k->body[0], k->one, at[0], &a);
  const double share = fmax(one, free_share(s, k->body[1], k->two, at[1], &b));
  return share < 1.0 ? (1.0 - share) * fmax(0.0, k->reach - sw_dist(a, b)) : 0.0;
}

/* What was placed in each other is let out slowly: within one step its way would turn into speed.
 */
static void forgive(const sw_pairs *p, const sw_system *s, const sw_pair *k,
                    const sw_pair_memory *m, sw_pair_touch *t) {
  if (p->regime == SW_CONTACT_EXPLICIT || t->press.gap >= 0) return;
  const double always = imposed(s, k, t->at);
  t->forgiven = always;
  if (p->regime != SW_CONTACT_IMPLICIT) return;
  const sw_vec from = sw_pair_apart(s->x, t->bow);
  const double depth = k->reach - sw_dot(t->square, from) - always;
  const double explained = m ? m->depth : 0.0;
  t->emerges = m ? m->emerges : sw_press_was_put(depth, p->memory_count == 0);
  const double left = sw_press_forgiven(depth, explained, p->h, t->emerges);
  t->forgiven += left;
  if (t->emerges) t->let_out = sw_press_let_out(depth, explained, left);
}

/* Wherever it has slid to. */
static double stiffness_of(const sw_pairs *p, const sw_pair *k, const sw_pair_memory *m,
                           const sw_pair_touch *last) {
  if (p->regime == SW_CONTACT_EXPLICIT) return k->usual;
  if (last) return last->stiffer;
  return m && m->normal_force > 0 ? m->k : k->usual;
}

/* Where wires along each other pressed at the step's start they do so in the first iterate, unless
 * the prediction opens them by more: a depth far below what they move in a step says nothing of
 * whether they part. Crossings of a tight knot wander along both segments, and do not settle so. Of
 * the radii's sum [-]. */
static const double STILL_NEAR = 0.02;

/* A force that turns with its normal is a stiffness below zero. From a predicted place, as deep as
 * a wire has flown in the step, it would be thousands of weights, and throw wires about: it is left
 * out until the last update shifted the touch by no more than this share of the radii [-]. What was
 * placed in each other, or is held so, is as deep as it looks; crossings of a knot wander. */
static const double NEAR_SHIFT = 0.02;
static int is_far(const sw_pairs *p, const sw_pair *k, const sw_pair_touch *t,
                  const sw_pair_touch *last, int pressed) {
  if (p->regime != SW_CONTACT_IMPLICIT || t->kind == SW_CROSSING || t->forgiven > 0) return 0;
  if (!last) return !pressed;
  return last->stage == p->stage && sw_norm(last->press.shift) > NEAR_SHIFT * k->reach;
}

/* Of a touch that nothing is known of: by its depth, unless that is one of the prediction, which
 * would be thousands of weights. Friction then begins with nothing: with what would stop the
 * lighter wire there it pushes wires of a bundle about that only fall on each other [N]. */
static double first_force(const sw_pairs *p, const sw_pair_touch *t) {
  const int flown =
      p->regime == SW_CONTACT_IMPLICIT && !(t->forgiven > 0) && t->kind != SW_CROSSING;
  return flown ? 0.0 : fmax(0.0, -t->press.gap) * t->press.k;
}

static sw_status add_touch(sw_pairs *p, const sw_system *s, const sw_pair *k, const double *y,
                           sw_pair_touch *t, double gap, sw_vec normal, const sw_pair_memory *m,
                           const sw_pair_touch *last) {
  const double friction = sw_pair_rule_of(p, k->body)->friction;
  t->pair = (uint32_t)(k - p->pairs);
  t->stage = p->stage;
  sw_press *press = &t->press;
  press->gap = gap, press->normal = normal;
  if (!(sw_norm2(t->square) > 0)) t->square = normal;
  press->k = t->stiffer = stiffness_of(p, k, m, last);
  forgive(p, s, k, m, t);
  press->gap += t->forgiven;
  press->gap_after = press->gap;
  sw_press_activate(press, last && p->regime != SW_CONTACT_EXPLICIT ? &last->press : NULL);
  const int pressed = m && m->normal_force > 0;
  t->far = is_far(p, k, t, last, pressed);
  if (pressed && !last && p->regime == SW_CONTACT_IMPLICIT && t->kind != SW_CROSSING)
    press->active |= press->gap < STILL_NEAR * k->reach;
  sw_vec u = sw_sub(sw_pair_apart(y, t->bow), sw_pair_apart(s->x, t->bow));
  if (pressed)
    u = sw_add(u, carry(m->elastic, m->normal, normal));
  else if (!press->active)
    u = sw_v(0, 0, 0);
  sw_press_aim(press, u, last ? &last->press : NULL, last && last->stage == p->stage, p->first);
  press->lag = pressed ? m->normal_force : first_force(p, t);
  if (last) sw_press_take_lag(press, &last->press);
  const int known = (last && last->press.active) || pressed;
  if (known) press->sliding = last && last->press.active ? last->press.next_sliding : m->sliding;
  sw_press_begin(press, friction, known, HUGE_VAL);
  SW_TRY(sw_grow((void **)&p->touches, &p->touch_capacity, p->touch_count + 1, sizeof *p->touches));
  p->touches[p->touch_count++] = *t;
  return SW_OK;
}

/* Places nearer than this share of the radii's sum are in the list of touches, so that
 * what begins to touch finds its state of the iterate before [-]. */
static const double LISTED_GAP = 0.25;

/* Axes further apart than this have not just passed each other: in a knot, normals turn by
 * more than a right angle within two segments. Of the radii's sum [-]. */
static const double PASSED = 0.5;

/* The touch at given places, unless the wires are apart there. Axes that have got
 * through each other within the iteration are told by the remembered normal. */
static sw_status touch_at(sw_pairs *p, const sw_system *s, const sw_pair *k, const double *y,
                          sw_pair_kind kind, const double at[2], int slides_one, int slides_two) {
  sw_pair_touch t = {.kind = kind,
                     .at = {at[0], at[1]},
                     .bow = {sw_bow_chord(k->one, at[0]), sw_bow_chord(k->two, at[1])},
                     .slides = {slides_one, slides_two}};
  const sw_vec d = sw_pair_apart(y, t.bow);
  double distance = sw_norm(d);
  if (!(distance < (1.0 + LISTED_GAP) * k->reach)) return SW_OK;
  const sw_pair_memory *m = sw_pair_recall(p, k, at, kind);
  const sw_pair_touch *last = sw_pair_last(p, k, at, kind);
  sw_vec normal = sw_unit_or(d, m ? m->normal : sw_v(0, 0, 1));
  if (m && distance < PASSED * k->reach && sw_dot(normal, m->normal) < 0)
    normal = sw_neg(normal), distance = -distance;
  return add_touch(p, s, k, y, &t, distance - k->reach, normal, m, last);
}

static sw_status behind_barrier(sw_pairs *p, const sw_system *s, const sw_pair *k, const double *y,
                                int *found) {
  for (size_t i = 0; i < p->barrier_count; i++) {
    const sw_pair_barrier *b = &p->barriers[i];
    if (b->one != k->one || b->two != k->two) continue;
    sw_pair_touch t = {.at = {b->at[0], b->at[1]},
                       .bow = {sw_pair_bow(s, k, 0, b->at[0]), sw_pair_bow(s, k, 1, b->at[1])},
                       .barred = 1};
    const sw_vec d = sw_pair_apart(y, t.bow);
    const double gap = sw_dot(b->normal, d) - k->reach;
    *found = 1;
    t.aslant = sw_norm(d) - k->reach - gap;
    SW_TRY(add_touch(p, s, k, y, &t, gap, b->normal, sw_pair_recall(p, k, b->at, SW_CROSSING),
                     sw_pair_last(p, k, b->at, SW_CROSSING)));
  }
  return SW_OK;
}

/* A place at a joint is on two segments: the earlier one has it. Of an edge [-]. */
static const double ONE_PLACE = 1e-6;

static int is_had(const sw_pairs *p, const sw_pair *k, const double at[2]) {
  for (size_t i = p->touch_count; i-- > 0;) {
    const sw_pair *other = &p->pairs[p->touches[i].pair];
    if (other->one + 1 < k->one) return 0;
    if (other->smooth && sw_pair_between(k, at, other, p->touches[i].at) < ONE_PLACE) return 1;
  }
  return 0;
}

/* The touch of two smooth curves. */
static sw_status touch_curves(sw_pairs *p, const sw_system *s, const sw_pair *k, const double *y,
                              const double at[2], const int slides[2]) {
  sw_pair_touch t = {.kind = SW_CROSSING,
                     .at = {at[0], at[1]},
                     .bow = {sw_pair_bow(s, k, 0, at[0]), sw_pair_bow(s, k, 1, at[1])},
                     .slides = {slides[0], slides[1]}};
  sw_vec normal = sw_pair_normal(y, t.bow, slides);
  double distance = sw_dot(normal, sw_pair_apart(y, t.bow));
  if (!(distance < (1.0 + LISTED_GAP) * k->reach)) return SW_OK;
  const sw_pair_memory *m = sw_pair_recall(p, k, at, SW_CROSSING);
  const sw_pair_touch *last = sw_pair_last(p, k, at, SW_CROSSING);
  if (m && distance < PASSED * k->reach && sw_dot(normal, m->normal) < 0)
    normal = sw_neg(normal), distance = -distance;
  if (is_had(p, k, at)) return SW_OK;
  t.steady = m ? m->steady : 0;
  t.square = normal;
  normal = sw_pair_leaning(s, k, y, &t, normal, t.steady);
  return add_touch(p, s, k, y, &t, distance - k->reach, normal, m, last);
}

static sw_vec edge(const double *y, uint32_t e) {
  return sw_sub(sw_vec_at(y, e + 1u), sw_vec_at(y, e));
}

static int is_last(const sw_system *s, uint32_t body, uint32_t e) {
  return e + 2 == s->bodies[body].first_node + s->bodies[body].plan->nodes;
}

/* A nearest point at a segment's end counts once: for the segment that starts there, and
 * only when the one before it does not come nearer still. away: from the other wire to
 * here, along the outward normal. */
static const double ROUNDING = 1e-9; /* [-] */

static int owns_end(const sw_system *s, uint32_t body, uint32_t e, double at, sw_vec away,
                    const double *y) {
  if (at >= 1.0) return is_last(s, body, e);
  if (at > 0.0 || e == s->bodies[body].first_node) return 1;
  const sw_vec before = edge(y, e - 1); /* rounding must not make both leave it to the other */
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
    return touch_curves(p, s, k, y, at, slides);
  }
  const sw_bow bow[2] = {sw_bow_chord(k->one, at[0]), sw_bow_chord(k->two, at[1])};
  const sw_vec away = sw_pair_apart(y, bow);
  if (!owns_end(s, k->body[0], k->one, at[0], away, y) ||
      !owns_end(s, k->body[1], k->two, at[1], sw_neg(away), y))
    return SW_OK;
  return touch_at(p, s, k, y, SW_CROSSING, at, at[0] > 0 && at[0]<1, at[1]> 0 && at[1] < 1);
}

static double along(const double *y, uint32_t e, sw_vec q) {
  const sw_vec u = edge(y, e);
  return sw_dot(u, sw_sub(q, sw_vec_at(y, e))) / fmax(sw_norm2(u), 1e-300);
}

/* Beside a bend there are two places, one on each segment. So near the joint [-] they are one, and
 * that of the first segment; further off, as where the point is the middle of a circle that the
 * wire goes round, they are not. */
static const double AT_JOINT = 0.25;

/* The place along segment e of a wire that is nearest to point q, when it is this segment's: beside
 * it, or at its first node where the one before does not reach, or beyond the wire's end. */
static int beside(const sw_system *s, uint32_t body, uint32_t e, const double *y, sw_vec q,
                  double *at) {
  const double here = along(y, e, q);
  *at = fmin(1.0, fmax(0.0, here));
  if (here >= 1) return is_last(s, body, e);
  if (here >= AT_JOINT || e == s->bodies[body].first_node) return 1;
  const double before = along(y, e - 1, q);
  return before >= 1 || (here > 0 && before < 1 - AT_JOINT);
}

/* Each segment's first node against the other; at a wire's end its last node too. */
static sw_status touch_parallel(sw_pairs *p, const sw_system *s, const sw_pair *k,
                                const double *y) {
  const uint32_t ends[2] = {1u + (uint32_t)is_last(s, k->body[0], k->one),
                            1u + (uint32_t)is_last(s, k->body[1], k->two)};
  double at[2];
  for (uint32_t end = 0; end < ends[0]; end++)
    if (beside(s, k->body[1], k->two, y, sw_vec_at(y, k->one + end), &at[1])) {
      at[0] = end;
      SW_TRY(touch_at(p, s, k, y, SW_NODE_OF_ONE, at, 0, at[1] > 0 && at[1] < 1));
    }
  for (uint32_t end = 0; end < ends[1]; end++)
    if (beside(s, k->body[0], k->one, y, sw_vec_at(y, k->two + end), &at[0])) {
      at[1] = end;
      SW_TRY(touch_at(p, s, k, y, SW_NODE_OF_TWO, at, at[0] > 0 && at[0] < 1, 0));
    }
  return SW_OK;
}

/* Nearest places come and go where wires lie along each other, or are handed on from one
 * segment to the next. One that pushed in the iterate before stays where it was. first: of the
 * touches found in this iterate. */
static sw_status keep_pushing(sw_pairs *p, const sw_system *s, const sw_pair *k, const double *y,
                              size_t first) {
  for (size_t i = k->last; i < k->last_end; i++) {
    const sw_pair_touch *last = &p->last[i];
    int found = 0;
    if (!(last->press.normal_force > 0)) continue;
    for (size_t j = first; j < p->touch_count; j++)
      found |= sw_pair_is_same(k, last->at, k, p->touches[j].at);
    if (!found) SW_TRY(touch_at(p, s, k, y, last->kind, last->at, 0, 0));
  }
  return SW_OK;
}

static void swap_lists(sw_pairs *p) {
  sw_pair_touch *list = p->last;
  const size_t capacity = p->last_capacity;
  p->last = p->touches, p->last_capacity = p->touch_capacity, p->last_count = p->touch_count;
  p->touches = list, p->touch_capacity = capacity, p->touch_count = 0;
  size_t i = 0; /* both lists are in the pairs' order */
  for (size_t k = 0; k < p->pair_count; k++) {
    p->pairs[k].last = i;
    while (i < p->last_count && p->last[i].pair == k) i++;
    p->pairs[k].last_end = i;
  }
}

static sw_status find_touches(sw_pairs *p, const sw_system *s, const double *y) {
  swap_lists(p);
  for (size_t i = 0; i < p->pair_count; i++) {
    const sw_pair *k = &p->pairs[i];
    int found = 0;
    if (k->held) continue;
    if (sw_interrupted()) return SW_EINTR;
    if (p->barrier_count) SW_TRY(behind_barrier(p, s, k, y, &found));
    if (found) continue;
    const size_t first = p->touch_count;
    SW_TRY((k->parallel ? touch_parallel : touch_crossing)(p, s, k, y));
    if (!k->parallel && !k->smooth && p->regime != SW_CONTACT_EXPLICIT)
      SW_TRY(keep_pushing(p, s, k, y, first));
  }
  return SW_OK;
}

/* --- forces ---------------------------------------------------------------------- */

static sw_status apply(sw_pairs *p, sw_system *s, sw_pair_touch *t, const double *y,
                       unsigned want) {
  const sw_pair *k = &p->pairs[t->pair];
  const int stiff = (want & SW_WANT_STIFFNESS) != 0;
  double K[6];
  t->press.normal_force = 0;
  t->press.tangential = sw_v(0, 0, 0);
  if (!t->press.active) return SW_OK;
  const sw_vec f = sw_press_eval(&t->press, sw_pair_rule_of(p, k->body)->friction,
                                 p->regime != SW_CONTACT_EXPLICIT, K);
  return sw_pair_add(s, k, t, y, f, stiff ? K : NULL);
}

sw_status sw_pairs_eval(sw_pairs *p, sw_system *s, const double *y, unsigned want, sw_error *err) {
  sw_status status = find_touches(p, s, y);
  for (size_t i = 0; i < p->touch_count && status == SW_OK; i++)
    status = apply(p, s, &p->touches[i], y, want);
  return status == SW_OK ? SW_OK : sw_pairs_fail(status, err);
}
