/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the touches of an iterate: where wires are near obstacles. */
#include <math.h>

#include "base/interrupt.h"
#include "contact/curve.h"
#include "touch/same.h"

/* 1 if a mesh's particle was in the obstacle at the step's start already. If it has no memory, a
 * script put it, or the obstacle, there. The swept test finds particles that get in within a
 * step. */
static int was_put_in(const sw_contact *c, const sw_system *s, const sw_candidate *k) {
  sw_closest near;
  if (k->segment || !s->bodies[k->body].plan->web) return 0;
  const sw_vec x = sw_contact_where(c, s->x, k->node, k->node, 0);
  return sw_shape_point(c->obstacles[k->obstacle].shape,
                        sw_pose_local(c->start[k->obstacle].pose, x), 0, &near);
}

/* Keeps the side of a place. If the wire's axis is inside the obstacle, the nearest face may be the
 * wrong one, so the side of the last accepted step is used. Without such a memory the axis got in
 * within this step: returns 0, the touch is left out, and the swept test finds its side. A wire
 * that starts inside is pushed out by the shortest path. */
static int keep_side(sw_contact *c, const sw_system *s, const sw_candidate *k, sw_vec local,
                     sw_closest *near) {
  if (near->gap >= 0 || c->flat[k->obstacle]) return 1; /* a half space has one side */
  const sw_memory *m = sw_contact_remembered(c, k, near);
  if (!m) {
    sw_contact_note_inside(c, s, k, near);
    return c->fresh == SW_CONTACT_FRESH || was_put_in(c, s, k);
  }
  if (sw_dot(m->normal, near->normal) > 0.7) return 1; /* within 45 degrees: the same face */
  const double gap = sw_dot(m->normal, sw_sub(local, m->point));
  near->gap = gap;
  near->normal = m->normal;
  near->point = sw_madd(local, m->normal, -gap);
  near->feature = m->feature;
  return 1;
}

/* Fills the place that a barrier of this step keeps on its side. Returns 1 if there is a
 * barrier. */
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
                          sw_place *place) {
  return keep_side(c, s, k, place->wire, &place->near) ? sw_contact_add_touch(c, s, k, y, place)
                                                       : SW_OK;
}

/* Keeps the place of touches that pushed in the previous iterate: the nearest place of a segment
 * along an obstacle changes with the last nanometre. first: the first touch found in this
 * iterate. */
static sw_status keep_pushing(sw_contact *c, const sw_system *s, const sw_candidate *k,
                              const double *y, size_t first) {
  const int chords = k->segment && !k->samples && (!k->smooth || k->round);
  if (!chords || c->regime == SW_CONTACT_EXPLICIT) return SW_OK;
  for (size_t i = k->last; i < k->last_end; i++) {
    const sw_touch *last = &c->last[i];
    if (last->sharp || !(last->press.normal_force > 0)) continue;
    int found = 0;
    for (size_t j = first; j < c->touch_count; j++)
      found |= fabs(c->touches[j].at - last->at) < SW_SAME_TOUCH;
    const sw_vec p = sw_contact_where(c, y, k->node, k->other, last->at);
    sw_place place = {.wire = sw_pose_local(c->now[k->obstacle].pose, p)};
    const sw_shape *shape = c->obstacles[k->obstacle].shape;
    if (found || !sw_shape_point(shape, place.wire, k->radius, &place.near)) continue;
    place.near.at = last->at;
    SW_TRY(add_near(c, s, k, y, &place));
  }
  return SW_OK;
}

/* Touches on edges or corners of one obstacle that are nearer to each other than this share of the
 * radius are one touch. On a round side every touch counts, with its share of the stiffness [-]. */
static const double ONE_POINT = 0.02;

static int is_known(const sw_contact *c, const sw_candidate *k, const sw_place *place) {
  const double near = ONE_POINT * k->radius;
  if (place->sharp == SW_SHARP_ROUND) return 0;
  for (size_t i = c->touch_count; i-- > c->parts.touch;) {
    const sw_touch *t = &c->touches[i];
    if (t->body != k->body || t->node + 1 < k->node) break;
    if (t->obstacle == k->obstacle && t->sharp &&
        sw_norm2(sw_sub(t->local, place->near.point)) < near * near)
      return 1;
  }
  return 0;
}

/* Returns the same obstacle's candidate of the segment before (by -1) or after (by 1), or NULL. */
static const sw_candidate *beside(const sw_contact *c, const sw_candidate *k, int by) {
  const size_t node = k->node + (size_t)by, from = (size_t)(k - c->candidates);
  for (size_t i = from + (size_t)by; i < c->candidate_count; i += (size_t)by) {
    const sw_candidate *n = &c->candidates[i];
    if (n->body != k->body || (by < 0 ? n->node < node : n->node > node)) break;
    if (n->node == node && n->obstacle == k->obstacle && n->segment && n->smooth) return n;
  }
  return NULL;
}

/* Returns the candidate of the segment that contains the place, even if the neighbouring segment
 * found it. Memory and impacts must not depend on the end from which nodes are counted. */
static const sw_candidate *owner(const sw_contact *c, const sw_candidate *k, sw_place *place) {
  const int by = place->near.at < 0 ? -1 : place->near.at > 1 ? 1 : 0;
  const sw_candidate *own = by ? beside(c, k, by) : NULL;
  if (!own) return k;
  place->near.at -= by;
  return own;
}

static sw_status add_sharp(sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const double *y, sw_place *place) {
  if (is_known(c, k, place)) return SW_OK;
  k = owner(c, k, place);
  const sw_mean spot = sw_contact_spot(s, k, place->near.at);
  const sw_vec p = sw_pose_local(c->now[k->obstacle].pose, sw_mean_place(c, y, &spot));
  if (!keep_side(c, s, k, p, &place->near)) return SW_OK;
  return sw_contact_add_touch(c, s, k, y, place);
}

static sw_status query(sw_contact *c, const sw_system *s, const sw_candidate *k, const double *y) {
  const double reach = 2.0 * k->radius; /* also lists places that may soon touch */
  size_t first = c->touch_count;
  sw_places list;
  if (c->barrier_count && behind_barrier(c, s, k, y, list.place))
    return sw_contact_add_touch(c, s, k, y, list.place);
  sw_contact_near(c, s, k, c->now, y, reach, &list);
  for (size_t i = 0; i < list.count; i++) {
    sw_place *place = &list.place[i];
    SW_TRY(place->sharp ? add_sharp(c, s, k, y, place) : add_near(c, s, k, y, place));
    if (place->sharp) first = c->touch_count;
  }
  return keep_pushing(c, s, k, y, first);
}

/* Number of candidates checked together, so that their touches are still in the cache when their
 * forces are added [-]. */
enum { SOME = 64 };

/* Number of touches with a final position in the list: a later candidate may find a touch that
 * belongs to the segment before it. */
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
