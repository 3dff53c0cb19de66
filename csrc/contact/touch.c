/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of an iterate: where wires are near obstacles, and what the touches there remember. */
#include "contact/touch.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"

/* A touch goes on into the next iterate up to this gap, of the radius, and while its normal
 * turns by an angle with a cosine above this [-]. */
static const double STILL_NEAR = 0.5, SAME_SIDE = 0.7;

/* Friction's springs in an object of many particles are softer than its touches, by their number
 * and up to this: hundreds of touches at once whose springs are as stiff as they themselves go to
 * and fro between sticking and sliding. What sticks gives way by some tens of micrometres under
 * its weight, and comes back [-]. */
static const double SOFTEST = 1000.0;

/* What has pressed a mesh up to now is not let go of by the first static solve in which it pulls:
 * that one may only have met too many touches at once, and then nothing holds the mesh. */
enum { SPARE_PULLS = 1 };

static sw_status push(sw_contact *c, const sw_touch *t) {
  SW_TRY(sw_grow((void **)&c->touches, &c->touch_capacity, c->touch_count + 1, sizeof *c->touches));
  c->touches[c->touch_count++] = *t;
  return SW_OK;
}

/* How far along the segment a touch may have moved and still be the same one, at most the given
 * share: a sample has its place [-]. */
static double within(const sw_candidate *k, double share) {
  return k->samples ? fmin(share, 0.5 / k->samples) : share;
}

static const sw_memory *memory_for(const sw_contact *c, const sw_candidate *k, double at) {
  const sw_memory *best = NULL;
  double nearest = within(k, HUGE_VAL);
  for (size_t i = k->memory; c->memory && i < k->memory_end; i++) {
    const double d = fabs(c->memory[i].at - at);
    if (d < nearest) best = &c->memory[i], nearest = d;
  }
  return best;
}

/* A touch that slid off one segment onto its neighbour, or onto the node
 * between them, keeps its friction spring: look at the entries around. */
static const sw_memory *inherited(const sw_contact *c, const sw_candidate *k, double at) {
  const int id = c->obstacles[k->obstacle].id;
  const double place = (double)k->node + at;
  const sw_memory *best = NULL;
  double nearest = 1.0; /* at most one segment away */
  for (size_t i = k->memory; i-- > 0 && c->memory[i].node + 2 >= k->node;) {
    const double d = fabs((double)c->memory[i].node + c->memory[i].at - place);
    if (c->memory[i].obstacle == id && c->memory[i].normal_force > 0 && d < nearest)
      best = &c->memory[i], nearest = d;
  }
  for (size_t i = k->memory_end; i < c->memory_count && c->memory[i].node <= k->node + 1; i++) {
    const double d = fabs((double)c->memory[i].node + c->memory[i].at - place);
    if (c->memory[i].obstacle == id && c->memory[i].normal_force > 0 && d < nearest)
      best = &c->memory[i], nearest = d;
  }
  return best;
}

/* A touch of the iterate before is the same one up to this far along the segment [-]. */
static const double SAME_PLACE = 0.25;

static const sw_touch *last_for(const sw_contact *c, const sw_candidate *k, double at) {
  const sw_touch *best = NULL;
  double nearest = within(k, SAME_PLACE);
  for (size_t i = k->last; i < k->last_end; i++) {
    const double d = fabs(c->last[i].at - at);
    if (d < nearest) best = &c->last[i], nearest = d;
  }
  return best;
}

/* Displacement of the wire's material at the touch since the step's start,
 * relative to the obstacle's. Of a wire that rolls: of its surface, relative to the
 * obstacle's material there. */
static sw_vec relative_shift(const sw_contact *c, const sw_system *s, const sw_touch *t,
                             const double *y) {
  const sw_vec from = sw_contact_where(c, s->x, t->node, t->other, t->at);
  const sw_vec to = sw_contact_where(c, y, t->node, t->other, t->at);
  const sw_vec carried =
      sw_pose_point(c->now[t->obstacle].pose, sw_pose_local(c->start[t->obstacle].pose, from));
  const sw_body *b = &s->bodies[t->body];
  if (!b->roll_block) return sw_sub(to, carried);
  const sw_levers levers = sw_touch_levers(s, t);
  const sw_vec before = sw_rotate(c->start[t->obstacle].pose.q,
                                  sw_unrotate(c->now[t->obstacle].pose.q, t->press.normal));
  const sw_vec arm = sw_scale(sw_sub(t->press.normal, before), b->plan->beam.radius);
  const sw_vec rolled = sw_levers_shift(&levers, b->roll_turn, 1);
  return sw_add(sw_add(sw_sub(to, carried), arm), rolled);
}

/* The same since the wire was last seen there: what explicit methods do after their last evaluation
 * in a step is not in that, and is found at the next one. */
static sw_vec shift_since(const sw_contact *c, const sw_system *s, const sw_touch *t,
                          const double *y) {
  const sw_candidate *k = &c->candidates[t->candidate];
  const sw_memory *m = c->regime == SW_CONTACT_EXPLICIT ? memory_for(c, k, t->at) : NULL;
  if (!m) return relative_shift(c, s, t, y);
  const sw_vec now = sw_contact_where(c, y, t->node, t->other, m->at);
  return sw_sub(now, sw_pose_point(c->now[t->obstacle].pose, m->seen));
}

/* The memory of a touch that pressed, on whatever part of the wire it was. */
static const sw_memory *pressed_memory(const sw_contact *c, const sw_system *s,
                                       const sw_candidate *k, double at) {
  const sw_memory *own = memory_for(c, k, at);
  if (own && own->normal_force > 0) return own;
  return s->bodies[k->body].plan->web || k->samples ? NULL : inherited(c, k, at);
}

/* A particle of a mesh that sticks is predicted off its place by far more than what its touch's
 * spring gives way, while nothing but its inertia needs that: a prediction says that it slides when
 * so many times its inertia would [-]. */
static const double NEIGHBOURS = 30.0;

/* How stiff friction's spring counts where a prediction is to say that it surely slides [N/m]. */
static double felt_stiffness(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_web *web = s->bodies[t->body].plan->web;
  if (!web || !web->per_ring || c->regime != SW_CONTACT_IMPLICIT) return HUGE_VAL;
  return NEIGHBOURS * c->candidates[t->candidate].mass / (c->h * c->h);
}

/* What only now begins to touch has been moving freely: it slides first. A wire that has been
 * rolling is not called a slide for a long spring: on a curved surface both its shift and its
 * turn are predicted less exactly than that. */
static void begin_friction(const sw_contact *c, const sw_system *s, const sw_memory *m,
                           const sw_touch *last, const double *y, sw_touch *t) {
  sw_press *press = &t->press;
  sw_vec u = shift_since(c, s, t, y);
  if (m)
    u = sw_add(u, sw_rotate(c->now[t->obstacle].pose.q, m->elastic));
  else if (press->gap >= 0 && press->active)
    u = sw_v(0, 0, 0);
  sw_press_aim(press, u, last ? &last->press : NULL, last && last->stage == c->stage, c->first);
  press->lag = m ? m->normal_force : press->k * fmax(0.0, -press->gap);
  if (last) sw_press_take_lag(press, &last->press);
  const int turned = last && last->press.reversals > 0, moving = c->regime == SW_CONTACT_IMPLICIT;
  if (turned && (moving ? c->updates > 0 : sw_contact_moves(c)))
    press->reversals = last->press.reversals;
  const sw_contact_obstacle *o = &c->obstacles[t->obstacle];
  const int went_on = last && last->press.active, searches = last && c->ahead_count;
  t->friction = m && m->sliding ? o->kinetic : o->friction;
  t->slid = m ? m->slid : 0.0;
  if (searches) press->ahead = last->press.ahead;
  if (went_on || searches)
    press->sliding = last->press.next_sliding;
  else if (m)
    press->sliding = m->sliding;
  const int held = m && !m->sliding &&
                   (s->bodies[t->body].roll_block || (!last && c->regime == SW_CONTACT_STATIC));
  if (!held && !searches) sw_press_begin(press, t->friction, went_on || m, felt_stiffness(c, s, t));
}

int sw_contact_is_held(const sw_system *s, const sw_candidate *k) {
  const sw_body *b = &s->bodies[k->body];
  const int *held = b->plan->held;
  return held[k->node - b->first_node] != SW_FREE && held[k->other - b->first_node] != SW_FREE;
}

double sw_contact_depth_before(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_vec plane = sw_pose_point(c->start[t->obstacle].pose, t->local);
  const sw_vec from = sw_contact_where(c, s->x, t->node, t->other, t->at);
  const double aslant = sw_contact_aslant(c, t->node, t->other, t->at, t->press.normal);
  return c->candidates[t->candidate].skin - aslant - sw_dot(t->press.normal, sw_sub(from, plane));
}

/* A wire that is pushed on with its end bears far more than its weight, and a touch that is made
 * stiffer once that has driven it in would throw the end back. As stiff as the wire is there, it
 * is stiff enough from the beginning [N/m]. */
static double end_stiffness(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                            const double *y, sw_vec normal) {
  const sw_body *b = &s->bodies[k->body];
  const size_t i = k->node - b->first_node, last = b->plan->nodes - 1;
  if (c->regime != SW_CONTACT_IMPLICIT || b->plan->web || k->segment || (i > 0 && i < last))
    return k->usual;
  const size_t e = i ? last - 1 : 0, at = b->first_node + e;
  const sw_vec edge = sw_sub(sw_vec_at(y, at + 1), sw_vec_at(y, at));
  const double along = sw_dot(sw_unit_or(edge, sw_v(0, 0, 0)), normal);
  return fmax(k->usual, along * along * b->EA / b->plan->rest[e]);
}

/* usual: of a new touch [N/m]. */
static double stiffness_of(const sw_contact *c, const sw_candidate *k, const sw_memory *m,
                           const sw_touch *last, double usual) {
  if (c->regime == SW_CONTACT_EXPLICIT) return k->usual;
  if (last) return last->stiffer;
  return m ? m->k : usual;
}

/* Is a touch the one of the iterate before, moved a little? */
static int goes_on(const sw_contact *c, const sw_candidate *k, const sw_press *press,
                   const sw_touch *last) {
  return last && c->regime != SW_CONTACT_EXPLICIT && press->gap < STILL_NEAR * k->radius &&
         sw_dot(press->normal, last->press.normal) > SAME_SIDE;
}

static sw_status add_touch(sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const double *y, const sw_closest *near) {
  const sw_pose *pose = &c->now[k->obstacle].pose;
  const double at = k->segment ? near->at : 0.0;
  const sw_memory *m = pressed_memory(c, s, k, at);
  const sw_touch *last = last_for(c, k, at);
  const double usual = end_stiffness(c, s, k, y, sw_rotate(pose->q, near->normal));
  const double stiffness = stiffness_of(c, k, m, last, usual);
  const sw_web *web = s->bodies[k->body].plan->web;
  sw_touch t = {.obstacle = k->obstacle,
                .segment = k->segment,
                .node = k->node,
                .other = k->other,
                .body = k->body,
                .feature = near->feature,
                .at = at,
                .point = sw_pose_point(*pose, near->point),
                .local = near->point,
                .known = m != NULL,
                .stiffer = stiffness,
                .usual = usual,
                .held = sw_contact_is_held(s, k),
                .candidate = (size_t)(k - c->candidates),
                .stage = c->stage,
                .press = {.normal = sw_rotate(pose->q, near->normal),
                          .gap = near->gap - k->skin,
                          .k = stiffness,
                          .by_place = 1}};
  if (c->softer) t.press.k = sw_contact_softer(c, s, k, stiffness);
  t.press.gap += sw_contact_aslant(c, k->node, k->other, at, t.press.normal);
  if (web && !web->per_ring) t.press.soft = fmin(SOFTEST, (double)web->particles);
  sw_press *press = &t.press;
  const int slowly = (web && web->per_ring) || c->fresh;
  if (c->regime == SW_CONTACT_IMPLICIT &&
      press->gap < 0) { /* in explicit steps force follows depth */
    const double depth = sw_contact_depth_before(c, s, &t), explained = m ? m->depth : 0.0;
    t.forgiven =
        sw_press_forgiven(depth, explained, slowly ? c->stage_time - c->time : c->h, slowly);
    t.let_out = sw_press_let_out(depth, explained, t.forgiven);
  }
  if (m && web) t.hardened = 0.5 * m->depth * fmax(0.0, stiffness * m->depth - m->normal_force);
  press->gap += t.forgiven;
  press->gap_after = press->gap;
  if (c->regime == SW_CONTACT_STATIC && m && web && web->per_ring) press->spare = SPARE_PULLS;
  sw_press_activate(press, goes_on(c, k, press, last) ? &last->press : NULL);
  if (c->regime == SW_CONTACT_STATIC && !last && !web && !press->active) {
    press->active = 1; /* what just touches may be all that bears the wire */
    press->active = sw_press_apart(press);
  }
  t.seen = sw_pose_local(*pose, sw_contact_where(c, y, t.node, t.other, t.at));
  begin_friction(c, s, m, last, y, &t);
  if (t.held) press->active = 0;
  return push(c, &t);
}

/* When the wire's axis is inside the obstacle the nearest face may be the wrong
 * one: stay with the side that is remembered from the last accepted step.
 * Without a memory the axis got there unseen within this step; the swept test
 * will tell from which side, so the touch is left out: 0. A wire that starts
 * inside (nothing accepted yet) is pushed out the nearest way. */
static int keep_side(const sw_contact *c, const sw_candidate *k, sw_vec local, sw_closest *near) {
  if (near->gap >= 0 || c->flat[k->obstacle]) return 1; /* a half space has one side */
  const sw_memory *m = memory_for(c, k, near->at);
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
static int behind_barrier(const sw_contact *c, const sw_candidate *k, const double *y,
                          sw_closest *near) {
  const sw_barrier *b = sw_contact_barrier(c, k->obstacle, k->node, k->segment);
  if (!b) return 0;
  const sw_vec local =
      sw_pose_local(c->now[b->obstacle].pose, sw_contact_where(c, y, b->node, b->other, b->at));
  const double gap = sw_dot(b->normal, sw_sub(local, b->point));
  *near = (sw_closest){.gap = gap,
                       .at = b->at,
                       .normal = b->normal,
                       .point = sw_madd(local, b->normal, -gap),
                       .feature = SW_BEHIND_BARRIER};
  return 1;
}

/* The nearest place of a segment that lies along an obstacle comes and goes with the last
 * nanometre. One that pushed in the iterate before stays where it was. first: of the touches
 * found in this iterate. */
static sw_status keep_pushing(sw_contact *c, const sw_system *s, const sw_candidate *k,
                              const double *y, size_t first) {
  const sw_pose *pose = &c->now[k->obstacle].pose;
  for (size_t i = k->last; i < k->last_end; i++) {
    const sw_touch *last = &c->last[i];
    if (!(last->press.normal_force > 0)) continue;
    int found = 0;
    for (size_t j = first; j < c->touch_count; j++)
      found |= fabs(c->touches[j].at - last->at) < SAME_PLACE;
    const sw_vec p = sw_pose_local(*pose, sw_contact_where(c, y, k->node, k->other, last->at));
    sw_closest near;
    if (found || !sw_shape_point(c->obstacles[k->obstacle].shape, p, k->radius, &near)) continue;
    near.at = last->at;
    if (keep_side(c, k, p, &near)) SW_TRY(add_touch(c, s, k, y, &near));
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
    if (keep_side(c, k, p, &near)) SW_TRY(add_touch(c, s, k, y, &near));
  }
  return SW_OK;
}

static sw_status query(sw_contact *c, const sw_system *s, const sw_candidate *k, const double *y) {
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  const sw_pose *pose = &c->now[k->obstacle].pose;
  const sw_vec a = sw_pose_local(*pose, sw_contact_where(c, y, k->node, k->node, 0));
  const double reach = 2.0 * k->radius; /* keeps what may begin to touch in the list */
  sw_closest near[SW_CLOSEST_MAX];
  if (c->barrier_count && behind_barrier(c, k, y, &near[0])) return add_touch(c, s, k, y, &near[0]);
  if (k->samples) return query_samples(c, s, k, y, reach);
  if (!k->segment) {
    if (!sw_shape_point(shape, a, reach, &near[0])) return SW_OK;
    near[0].at = 0;
    return keep_side(c, k, a, &near[0]) ? add_touch(c, s, k, y, &near[0]) : SW_OK;
  }
  const sw_vec b = sw_pose_local(*pose, sw_contact_where(c, y, k->other, k->other, 0));
  const size_t first = c->touch_count;
  const int n = sw_shape_segment(shape, a, b, reach, near);
  for (int i = 0; i < n; i++) {
    if (keep_side(c, k, sw_lerp(a, b, near[i].at), &near[i]))
      SW_TRY(add_touch(c, s, k, y, &near[i]));
  }
  return c->regime == SW_CONTACT_EXPLICIT ? SW_OK : keep_pushing(c, s, k, y, first);
}

sw_status sw_contact_look(sw_contact *c, const sw_system *s, const double *y, sw_error *err) {
  size_t first, end;
  sw_status status = sw_contact_turn_over(c, &first, &end);
  for (size_t i = first; i < end && status == SW_OK; i++)
    status = sw_interrupted() ? SW_EINTR : query(c, s, &c->candidates[i], y);
  return status == SW_OK ? SW_OK : sw_fail(err, status, "contact: %s", sw_status_text(status));
}
