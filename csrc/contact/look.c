/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of an iterate: where wires are near obstacles. */
#include <math.h>

#include "base/interrupt.h"
#include "contact/round.h"
#include "contact/same.h"

/* When the wire's axis is inside the obstacle the nearest face may be the wrong
 * one: stay with the side that is remembered from the last accepted step.
 * Without a memory the axis got there unseen within this step; the swept test
 * will tell from which side, so the touch is left out: 0. A wire that starts
 * inside (nothing accepted yet) is pushed out the nearest way. */
static int keep_side(const sw_contact *c, const sw_candidate *k, sw_vec local, sw_closest *near) {
  if (near->gap >= 0 || c->flat[k->obstacle]) return 1; /* a half space has one side */
  const sw_memory *m = sw_contact_remembered(c, k, near->at);
  if (!m) return c->fresh == SW_CONTACT_FRESH;
  if (sw_dot(m->normal, near->normal) > 0.7) return 1; /* within 45 degrees: the same face */
  const double gap = sw_dot(m->normal, sw_sub(local, m->point));
  near->gap = gap;
  near->normal = m->normal;
  near->point = sw_madd(local, m->normal, -gap);
  near->feature = m->feature;
  return 1;
}

/* The place kept on its side by a barrier of this step, if the candidate has
 * one: 1 and the touch, else 0. */
static int behind_barrier(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                          const double *y, sw_place *place) {
  const sw_barrier *b = sw_contact_barrier(c, k->obstacle, k->node, k->segment);
  if (!b) return 0;
  const sw_mean spot = sw_contact_spot(s, k, b->at);
  const sw_vec local = sw_pose_local(c->now[b->obstacle].pose, sw_mean_place(c, y, &spot));
  const double gap = sw_dot(b->normal, sw_sub(local, b->point));
  *place = (sw_place){.near = {.gap = gap,
                               .at = b->at,
                               .normal = b->normal,
                               .point = sw_madd(local, b->normal, -gap),
                               .feature = SW_BEHIND_BARRIER},
                      .edge = {0, 0, 0}};
  return 1;
}

static sw_status add_near(sw_contact *c, const sw_system *s, const sw_candidate *k, const double *y,
                          sw_closest *near, sw_vec local) {
  if (!keep_side(c, k, local, near)) return SW_OK;
  return sw_contact_add_touch(c, s, k, y, &(sw_place){.near = *near, .edge = {0, 0, 0}});
}

/* The nearest place of a segment that lies along an obstacle comes and goes with the last
 * nanometre. One that pushed in the iterate before stays where it was. first: of the touches
 * found in this iterate. */
static sw_status keep_pushing(sw_contact *c, const sw_system *s, const sw_candidate *k,
                              const double *y, size_t first) {
  const sw_pose *pose = &c->now[k->obstacle].pose;
  for (size_t i = k->last; i < k->last_end; i++) {
    const sw_touch *last = &c->last[i];
    if (last->sharp || !(last->press.normal_force > 0)) continue;
    int found = 0;
    for (size_t j = first; j < c->touch_count; j++)
      found |= fabs(c->touches[j].at - last->at) < SW_SAME_TOUCH;
    const sw_vec p = sw_pose_local(*pose, sw_contact_where(c, y, k->node, k->other, last->at));
    sw_closest near;
    if (found || !sw_shape_point(c->obstacles[k->obstacle].shape, p, k->radius, &near)) continue;
    near.at = last->at;
    SW_TRY(add_near(c, s, k, y, &near, p));
  }
  return SW_OK;
}

/* Touches at a candidate's samples. */
static sw_status query_samples(sw_contact *c, const sw_system *s, const sw_candidate *k,
                               const double *y, double reach) {
  const sw_pose *pose = &c->now[k->obstacle].pose;
  const sw_vec a = sw_pose_local(*pose, sw_contact_where(c, y, k->node, k->node, 0));
  const sw_vec b = sw_pose_local(*pose, sw_contact_where(c, y, k->other, k->other, 0));
  for (int i = 0; i < k->samples; i++) {
    const double at = sw_sample_at(k, i);
    const sw_vec p = sw_lerp(a, b, at);
    sw_closest near;
    if (!sw_shape_point(c->obstacles[k->obstacle].shape, p, reach, &near)) continue;
    near.at = at;
    SW_TRY(add_near(c, s, k, y, &near, p));
  }
  return SW_OK;
}

/* Along chords. */
static sw_status query_segment(sw_contact *c, const sw_system *s, const sw_candidate *k,
                               const double *y, double reach) {
  const sw_pose *pose = &c->now[k->obstacle].pose;
  const sw_vec a = sw_pose_local(*pose, sw_contact_where(c, y, k->node, k->node, 0));
  const sw_vec b = sw_pose_local(*pose, sw_contact_where(c, y, k->other, k->other, 0));
  const size_t first = c->touch_count;
  sw_closest near[SW_CLOSEST_MAX];
  const int n = sw_shape_segment(c->obstacles[k->obstacle].shape, a, b, reach, near);
  for (int i = 0; i < n; i++) {
    if (k->round && sw_contact_is_rounds(c, k, a, b, near[i].at)) continue;
    SW_TRY(add_near(c, s, k, y, &near[i], sw_lerp(a, b, near[i].at)));
  }
  return c->regime == SW_CONTACT_EXPLICIT ? SW_OK : keep_pushing(c, s, k, y, first);
}

static sw_status query_node(sw_contact *c, const sw_system *s, const sw_candidate *k,
                            const double *y, double reach) {
  const sw_pose *pose = &c->now[k->obstacle].pose;
  const sw_vec a = sw_pose_local(*pose, sw_contact_where(c, y, k->node, k->node, 0));
  sw_closest near;
  if (!sw_shape_point(c->obstacles[k->obstacle].shape, a, reach, &near)) return SW_OK;
  if (k->smooth && sw_contact_is_segments(c, s, k, c->now, y, &near)) return SW_OK;
  near.at = 0;
  return add_near(c, s, k, y, &near, a);
}

/* Touches of one obstacle nearer to each other than this share of the radius, on edges or corners,
 * are one [-]. */
static const double ONE_POINT = 0.02;

static int is_known(const sw_contact *c, const sw_candidate *k, const sw_place *place) {
  const double near = ONE_POINT * k->radius;
  for (size_t i = c->touch_count; i-- > c->parts.touch;) {
    const sw_touch *t = &c->touches[i];
    if (t->body != k->body || t->node + 1 < k->node) break;
    if (t->obstacle == k->obstacle && t->sharp &&
        sw_norm2(sw_sub(t->local, place->near.point)) < near * near)
      return 1;
  }
  return 0;
}

/* The same obstacle's candidate of the segment before (by -1) or after (by 1), or NULL. */
static const sw_candidate *beside(const sw_contact *c, const sw_candidate *k, int by) {
  const size_t node = k->node + (size_t)by, from = (size_t)(k - c->candidates);
  for (size_t i = from + (size_t)by; i < c->candidate_count; i += (size_t)by) {
    const sw_candidate *n = &c->candidates[i];
    if (n->body != k->body || (by < 0 ? n->node < node : n->node > node)) break;
    if (n->node == node && n->obstacle == k->obstacle && n->segment && n->smooth) return n;
  }
  return NULL;
}

/* A place is the segment's that it lies in, whichever one beside has found it: what it remembers
 * and what struck it must not depend on the end that nodes are counted from. */
static const sw_candidate *owner(const sw_contact *c, const sw_candidate *k, sw_place *place) {
  const int by = place->near.at < 0 ? -1 : place->near.at > 1 ? 1 : 0;
  const sw_candidate *own = by ? beside(c, k, by) : NULL;
  if (!own) return k;
  place->near.at -= by;
  return own;
}

static sw_status add_place(sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const double *y, sw_place *place) {
  if (is_known(c, k, place)) return SW_OK;
  k = owner(c, k, place);
  const sw_mean spot = sw_contact_spot(s, k, place->near.at);
  const sw_vec p = sw_pose_local(c->now[k->obstacle].pose, sw_mean_place(c, y, &spot));
  if (!keep_side(c, k, p, &place->near)) return SW_OK;
  return sw_contact_add_touch(c, s, k, y, place);
}

/* Along the smooth curve. */
static sw_status query_curve(sw_contact *c, const sw_system *s, const sw_candidate *k,
                             const double *y, double reach) {
  sw_piece piece;
  sw_places list;
  if (!sw_contact_piece(c, s, k, c->now, y, reach, &piece)) return SW_OK;
  sw_contact_places(c, k, &piece, reach, &list);
  for (size_t i = 0; i < list.count; i++) SW_TRY(add_place(c, s, k, y, &list.place[i]));
  return SW_OK;
}

static sw_status query(sw_contact *c, const sw_system *s, const sw_candidate *k, const double *y) {
  const double reach = 2.0 * k->radius; /* keeps what may begin to touch in the list */
  sw_place place;
  if (c->barrier_count && behind_barrier(c, s, k, y, &place))
    return sw_contact_add_touch(c, s, k, y, &place);
  if (k->samples) return query_samples(c, s, k, y, reach);
  if (!k->segment) return query_node(c, s, k, y, reach);
  if (k->smooth) SW_TRY(query_curve(c, s, k, y, reach));
  return k->smooth && !k->round ? SW_OK : query_segment(c, s, k, y, reach);
}

/* So many candidates at once: the touches that they find are still at hand when their forces are
 * added [-]. */
enum { SOME = 64 };

/* What a later candidate finds may belong to the segment before it. */
static size_t found_for_good(const sw_contact *c, const sw_glance *at) {
  size_t i = c->touch_count;
  if (at->next == at->end) return i;
  const size_t node = c->candidates[at->next].node;
  while (i > c->parts.touch && c->touches[i - 1].node + 1 >= node) i--;
  return i;
}

sw_status sw_contact_look_on(sw_contact *c, const sw_system *s, const double *y, sw_glance *at,
                             size_t *found, sw_error *err) {
  const size_t first = at->next;
  sw_status status = SW_OK;
  at->next = at->end - first > SOME ? first + SOME : at->end;
  sw_contact_match(c, at);
  for (size_t i = first; i < at->next && status == SW_OK; i++)
    status = sw_interrupted() ? SW_EINTR : query(c, s, &c->candidates[i], y);
  *found = found_for_good(c, at);
  return status == SW_OK ? SW_OK : sw_fail(err, status, "contact: %s", sw_status_text(status));
}
