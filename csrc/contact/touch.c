/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact law. Normal: N = k max(0, -gap). Friction: an anchored spring
 * with return mapping, f = -k u while k |u| <= mu N, else mu N against u and
 * the anchor follows; u is the elastic displacement kept from the last step
 * plus the material displacement since. Within an iteration friction takes the
 * normal force of the iterate before, which keeps the matrix symmetric and the
 * sub-problem convex. */
#include "contact/touch.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* Changes of the gap below this do not keep an iteration going [m]. */
static const double GAP_TOLERANCE = 2e-8;
/* Nor do errors of a friction spring's length below this: far below its length
 * at the onset of sliding, however stiff it is [m]. */
static const double SPRING_TOLERANCE = 1e-11;
/* Nor turns of the sliding direction with a cosine above this [-]. */
static const double TURN_TOLERANCE = 0.98;
/* Nor do changes of a sliding touch's normal force below this share of it, or
 * below this share of the whole wire's weight [-]. */
static const double FORCE_TOLERANCE = 0.01;
static const double WEIGHT_TOLERANCE = 1e-3;

/* Shorter updates leave place and normal of a touch on a curved or edged shape
 * as they are; of the radius [-]. */
static const double SMALL_SHIFT = 0.05;

/* A touch that sinks in deeper is made stiffer until it does not [m]. */
static const double DEEPEST = 50e-6;
static const double MOST_BOOST = 1e5; /* [-] */

/* A spring stretched this many times over what friction can hold does not stick,
 * whatever the prediction is worth [-]. Not so where a wire has been rolling: on a curved
 * surface both its shift and its turn are predicted less exactly than that. */
static const double SURELY_SLIDING = 20.0;

enum { OWN = 0, NEXT = 6, ROW = 24 }; /* layout of the system's block rows */

static sw_status push(sw_contact *c, const sw_touch *t) {
  SW_TRY(sw_grow((void **)&c->touches, &c->touch_capacity, c->touch_count + 1, sizeof *c->touches));
  c->touches[c->touch_count++] = *t;
  return SW_OK;
}

static const sw_memory *memory_for(const sw_contact *c, const sw_candidate *k, double at) {
  const sw_memory *best = NULL;
  for (size_t i = k->memory; i < k->memory_end; i++)
    if (c->memory && (!best || fabs(c->memory[i].at - at) < fabs(best->at - at)))
      best = &c->memory[i];
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

static const sw_touch *last_for(const sw_contact *c, const sw_candidate *k, double at) {
  const sw_touch *best = NULL;
  for (size_t i = k->last; i < k->last_end; i++)
    if (!best || fabs(c->last[i].at - at) < fabs(best->at - at)) best = &c->last[i];
  return best;
}

/* Displacement of the wire's material at the touch since the step's start,
 * relative to the obstacle's. Of a wire that rolls: of its surface, relative to the
 * obstacle's material there. */
static sw_vec relative_shift(const sw_contact *c, const sw_system *s, const sw_touch *t,
                             const double *y) {
  const sw_vec from = sw_touch_place(s->x, t->node, t->segment, t->at);
  const sw_vec to = sw_touch_place(y, t->node, t->segment, t->at);
  const sw_vec carried =
      sw_pose_point(c->now[t->obstacle].pose, sw_pose_local(c->start[t->obstacle].pose, from));
  const sw_body *b = &s->bodies[t->body];
  if (!b->roll_block) return sw_sub(to, carried);
  const sw_levers levers = sw_touch_levers(s, t);
  const sw_vec before =
      sw_rotate(c->start[t->obstacle].pose.q, sw_unrotate(c->now[t->obstacle].pose.q, t->normal));
  const sw_vec arm = sw_scale(sw_sub(t->normal, before), b->plan->beam.radius);
  const sw_vec rolled = sw_levers_shift(&levers, b->roll_turn, 1);
  return sw_add(sw_add(sw_sub(to, carried), arm), rolled);
}

static void set_friction_state(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                               const double *y, sw_touch *t) {
  const sw_memory *own = memory_for(c, k, t->at);
  const sw_memory *m = own && own->normal_force > 0 ? own : inherited(c, k, t->at);
  const sw_touch *last = last_for(c, k, t->at);
  sw_vec u = relative_shift(c, s, t, y);
  t->known = m != NULL;
  if (m)
    u = sw_add(u, sw_rotate(c->now[t->obstacle].pose.q, m->elastic));
  else
    u = sw_scale(u, t->gap < 0 ? 1.0 : 0.0);
  t->trial = sw_madd(u, t->normal, -sw_dot(u, t->normal));
  t->lag = last ? last->normal_force : m ? m->normal_force : t->k * fmax(0.0, -t->gap);
  const double most = c->obstacles[t->obstacle].friction * t->lag;
  /* The predicted place says little about sticking: a spring this stiff calls
   * every prediction a slide. Go on from the state that was found last. What
   * only now begins to touch has been moving freely: it slides first. */
  if (last && last->gap < 0)
    t->sliding = last->next_sliding;
  else if (m)
    t->sliding = m->sliding;
  else
    t->sliding = t->k * sw_norm(t->trial) > most;

  const int held = m && !m->sliding &&
                   (s->bodies[t->body].roll_block || (!last && c->regime == SW_CONTACT_STATIC));
  if (!held && t->k * sw_norm(t->trial) > SURELY_SLIDING * most) t->sliding = 1;
}

int sw_contact_is_held(const sw_system *s, const sw_candidate *k) {
  const sw_body *b = &s->bodies[k->body];
  const size_t i = k->node - b->first_node;
  return b->plan->held[i] != SW_FREE && (!k->segment || b->plan->held[i + 1] != SW_FREE);
}

/* A wire that is deeper inside at the step's start than its force explains
 * (after a barrier, or placed there) is let out slowly: without this the whole
 * depth would turn into speed within one step. Returns the part of the depth
 * that the step leaves alone [m]. In explicit steps force follows depth, so none
 * is. */
static const double RECOVERY_SPEED = 0.2; /* [m/s] */

static double forgiven(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                       const sw_touch *t) {
  if (c->regime != SW_CONTACT_IMPLICIT || t->gap >= 0) return 0;
  const sw_memory *m = memory_for(c, k, t->at);
  const sw_vec local = sw_pose_local(c->now[t->obstacle].pose, t->point);
  const sw_vec plane = sw_pose_point(c->start[t->obstacle].pose, local);
  const sw_vec from = sw_touch_place(s->x, t->node, t->segment, t->at);
  const double depth = k->radius - sw_dot(t->normal, sw_sub(from, plane));
  const double explained = m ? m->depth : 0.0;
  return fmax(0.0, depth - explained - RECOVERY_SPEED * c->h - GAP_TOLERANCE);
}

static sw_status add_touch(sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const double *y, const sw_closest *near) {
  const sw_pose *pose = &c->now[k->obstacle].pose;
  sw_touch t = {.obstacle = k->obstacle,
                .segment = k->segment,
                .node = k->node,
                .body = k->body,
                .feature = near->feature,
                .at = k->segment ? near->at : 0.0,
                .normal = sw_rotate(pose->q, near->normal),
                .point = sw_pose_point(*pose, near->point),
                .gap = near->gap - k->radius,
                .k = k->k,
                .held = sw_contact_is_held(s, k),
                .candidate = (size_t)(k - c->candidates)};
  t.forgiven = forgiven(c, s, k, &t);
  t.gap += t.forgiven;
  t.gap_after = t.gap;
  set_friction_state(c, s, k, y, &t);
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
  if (!m) return c->fresh;
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
  for (size_t i = 0; i < c->barrier_count; i++) {
    const sw_barrier *b = &c->barriers[i];
    if (b->obstacle != k->obstacle || b->node != k->node || b->segment != k->segment) continue;
    const sw_vec local =
        sw_pose_local(c->now[b->obstacle].pose, sw_touch_place(y, b->node, b->segment, b->at));
    const double gap = sw_dot(b->normal, sw_sub(local, b->point));
    *near = (sw_closest){.gap = gap,
                         .at = b->at,
                         .normal = b->normal,
                         .point = sw_madd(local, b->normal, -gap),
                         .feature = -1};
    return 1;
  }
  return 0;
}

static sw_status query(sw_contact *c, const sw_system *s, const sw_candidate *k, const double *y) {
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  const sw_pose *pose = &c->now[k->obstacle].pose;
  const sw_vec a = sw_pose_local(*pose, sw_load(y + 3 * k->node));
  const double reach = 2.0 * k->radius; /* keeps what may begin to touch in the list */
  sw_closest near[SW_CLOSEST_MAX];
  if (c->barrier_count && behind_barrier(c, k, y, &near[0])) return add_touch(c, s, k, y, &near[0]);
  if (!k->segment) {
    if (!sw_shape_point(shape, a, reach, &near[0])) return SW_OK;
    near[0].at = 0;
    return keep_side(c, k, a, &near[0]) ? add_touch(c, s, k, y, &near[0]) : SW_OK;
  }
  const sw_vec b = sw_pose_local(*pose, sw_load(y + 3 * k->node + 3));
  const int n = sw_shape_segment(shape, a, b, reach, near);
  for (int i = 0; i < n; i++) {
    if (keep_side(c, k, sw_lerp(a, b, near[i].at), &near[i]))
      SW_TRY(add_touch(c, s, k, y, &near[i]));
  }
  return SW_OK;
}

static void swap_lists(sw_contact *c) {
  sw_touch *list = c->last;
  const size_t capacity = c->last_capacity;
  c->last = c->touches, c->last_capacity = c->touch_capacity, c->last_count = c->touch_count;
  c->touches = list, c->touch_capacity = capacity, c->touch_count = 0;
  size_t i = 0; /* both lists are in the candidates' order */
  for (size_t n = 0; n < c->candidate_count; n++) {
    sw_candidate *k = &c->candidates[n];
    k->last = i;
    while (i < c->last_count && c->last[i].node == k->node && c->last[i].obstacle == k->obstacle &&
           c->last[i].segment == k->segment)
      i++;
    k->last_end = i;
  }
}

/* Add force f and symmetric stiffness K (upper half) at a touch. */
static void add_to_field(sw_system *s, const sw_touch *t, sw_vec f, const double K[6],
                         unsigned want) {
  sw_body *b = &s->bodies[t->body];
  const size_t i = t->node - b->first_node;
  const double w[2] = {1.0 - t->at, t->at};
  for (size_t e = 0; e < (t->segment ? 2u : 1u); e++) {
    sw_accumulate(b->field.force + 3 * (i + e), sw_scale(f, w[e]));
    if (want & SW_WANT_STIFFNESS)
      for (size_t k = 0; k < 6; k++) b->field.rows[ROW * (i + e) + OWN + k] += w[e] * w[e] * K[k];
  }
  if (!t->segment || !(want & SW_WANT_STIFFNESS)) return;
  static const size_t full[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (size_t k = 0; k < 9; k++) b->field.rows[ROW * i + NEXT + k] += w[0] * w[1] * K[full[k]];
}

/* K = kn n n' + kt (I - n n') - ks d d' */
static void stiffness_matrix(double kn, double kt, double ks, sw_vec n, sw_vec d, double K[6]) {
  const double v[3] = {n.x, n.y, n.z}, u[3] = {d.x, d.y, d.z};
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++)
      K[at] = (kn - kt) * v[i] * v[j] + (i == j ? kt : 0.0) - ks * u[i] * u[j];
}

static void apply(sw_contact *c, sw_system *s, sw_touch *t, unsigned want) {
  const double mu = c->obstacles[t->obstacle].friction;
  double K[6];
  t->normal_force = 0;
  t->tangential = sw_v(0, 0, 0);
  if (!(t->gap < 0) || t->held) return;
  t->normal_force = -t->k * t->gap;
  if (c->regime == SW_CONTACT_EXPLICIT) t->lag = t->normal_force;
  const double most = mu * t->lag, length = sw_norm(t->trial);
  if (c->regime == SW_CONTACT_EXPLICIT) t->sliding = t->k * length > most;
  const sw_vec d = length > 0 ? sw_scale(t->trial, 1.0 / length) : sw_v(0, 0, 0);
  t->tangential = sw_scale(d, t->sliding ? -most : -t->k * length);
  if (t->sliding) {
    const double kt = length > 0 ? fmin(most / length, t->k) : 0.0;
    stiffness_matrix(t->k, kt, kt, t->normal, d, K);
  } else {
    stiffness_matrix(t->k, mu > 0 ? t->k : 0.0, 0, t->normal, d, K);
    if (!(mu > 0)) t->tangential = sw_v(0, 0, 0);
  }
  add_to_field(s, t, sw_madd(t->tangential, t->normal, t->normal_force), K, want);
  if (s->rolls) sw_levers_push(s, t, K, want);
}

sw_status sw_contact_eval(void *contact, sw_system *s, double time, double hbar, const double *y,
                          unsigned want, sw_error *err) {
  sw_contact *c = contact;
  (void)hbar;
  sw_status status = SW_OK;
  if (c->regime == SW_CONTACT_EXPLICIT) status = sw_contact_begin_stage(c, s, time, hbar, y, err);
  if (status != SW_OK) return status;
  swap_lists(c);
  for (size_t i = 0; i < c->candidate_count && status == SW_OK; i++)
    status = query(c, s, &c->candidates[i], y);
  if (status != SW_OK) return sw_fail(err, status, "contact: out of memory");
  for (size_t i = 0; i < c->touch_count; i++) apply(c, s, &c->touches[i], want);
  return SW_OK;
}

/* Friction after the solved update; 1 = it agrees with what was assumed. */
static int update_friction(const sw_contact *c, sw_touch *t, sw_vec shift) {
  const double mu = c->obstacles[t->obstacle].friction;
  const sw_vec u = sw_madd(sw_add(t->trial, shift), t->normal, -sw_dot(shift, t->normal));
  const double length = sw_norm(u), most = mu * t->normal_force;
  const double small = t->k * SPRING_TOLERANCE;
  const double along = sw_dot(u, t->trial);
  const int beyond = t->k * length > most;
  const int reversed = t->sliding && along < 0;
  t->next_sliding = beyond && !reversed;
  t->tangential = sw_scale(u, -(beyond && length > 0 ? most / length : t->k));
  if (reversed) return most <= small;
  if (t->sliding && beyond && along < TURN_TOLERANCE * length * sw_norm(t->trial)) return 0;
  if (t->sliding != beyond) /* a change of state matters when the force does */
    return fabs(t->k * length - most) <= small + FORCE_TOLERANCE * most;
  return !beyond || fabs(t->normal_force - t->lag) <=
                        FORCE_TOLERANCE * t->normal_force + WEIGHT_TOLERANCE * c->force_scale;
}

/* A touch's shift by the solved update, with that of the surface. */
static sw_vec surface_shift(const sw_system *s, const sw_touch *t, sw_vec shift) {
  const sw_levers levers = sw_touch_levers(s, t);
  if (!levers.count) return shift;
  return sw_add(shift, sw_levers_shift(&levers, s->bodies[t->body].spin_delta + 3, 4));
}

/* Bring a touch's forces up to the solved update; 1 = it agrees with what the
 * solve assumed. */
static int update(sw_contact *c, const sw_system *s, sw_touch *t, const double *delta) {
  const sw_vec shift =
      t->segment ? sw_lerp(sw_load(delta + 3 * t->node), sw_load(delta + 3 * t->node + 3), t->at)
                 : sw_load(delta + 3 * t->node);
  const int active = t->gap < 0;
  t->gap_after = t->gap + sw_dot(t->normal, shift);
  if (t->held) return 1;
  t->normal_force = active ? fmax(0.0, -t->k * t->gap_after) : 0.0;
  t->next_sliding = 1; /* what does not touch moves freely */
  const sw_vec surface = s->rolls ? surface_shift(s, t, shift) : shift;
  const int agrees =
      active && c->obstacles[t->obstacle].friction > 0 ? update_friction(c, t, surface) : 1;
  if (active ? t->gap_after > GAP_TOLERANCE : t->gap_after < -GAP_TOLERANCE) return 0;
  const double radius = c->candidates[t->candidate].radius;
  if (!c->flat[t->obstacle] && t->gap_after < radius && sw_norm(shift) > SMALL_SHIFT * radius)
    return 0; /* place and normal of the touch may have changed */
  sw_candidate *k = &c->candidates[t->candidate];
  if (!s->rough && t->gap_after < -DEEPEST && k->k < MOST_BOOST * k->usual &&
      c->regime != SW_CONTACT_EXPLICIT) {
    k->k *= fmin(100.0, 2.0 * t->gap_after / -DEEPEST);
    return 0;
  }
  return agrees;
}

int sw_contact_settled(void *contact, sw_system *s, const double *y, const double *delta) {
  sw_contact *c = contact;
  int fine = 1;
  (void)y;
  c->pressed_count = c->pressed_before;
  for (size_t i = 0; i < c->touch_count; i++) fine &= update(c, s, &c->touches[i], delta);
  for (size_t i = 0; fine && i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    if (t->held || !(t->normal_force > 0 || t->gap_after < 0)) continue;
    if (sw_grow((void **)&c->pressed, &c->pressed_capacity, c->pressed_count + 1,
                sizeof *c->pressed) != SW_OK)
      break; /* an impact is then dealt with in the next step */
    c->pressed[c->pressed_count++] = *t;
  }
  return fine;
}
