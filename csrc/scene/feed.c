/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Feeding: wire slides through a held node. The node stays in the guide and its arc
 * length changes with time, in every stage of every integrator, so that the first edge
 * grows or shrinks smoothly while all other nodes keep to their material. The wire's
 * velocity at the guide is that of the guide and the feeding speed along it. Nodes
 * are inserted and removed between steps (guide.c). */
#include <math.h>

#include "scene/world.h"
#include "state/hinge.h"

static const double AT_END = 1e-9; /* of the wire's length: rounding [-] */

int sw_feed_outward(const sw_mesh *m, double s) {
  const double end = m->s[m->n - 1];
  return s >= end - AT_END * (end - m->s[0]) ? -1 : 1;
}

sw_status sw_feed_begin(sw_scene *s, sw_scene_hold *h, const sw_hold_args *a) {
  const sw_mesh *m = &s->wires[h->wire].mesh;
  h->feed = (sw_feed){.outward = sw_feed_outward(m, h->s1),
                      .label = h->s1,
                      .since = s->time,
                      .speed = isnan(a->speed) ? 0 : a->speed,
                      .slip_since = s->time,
                      .push = a->force,
                      .limit = a->force_limit,
                      .size = (m->s[m->n - 1] - m->s[0]) / (double)(m->n - 1)};
  return m->rest ? sw_mesh_copy(m, &h->feed.shape) : SW_OK;
}

sw_feed_now sw_feed_at(const sw_scene_hold *h, double t) {
  const sw_feed *f = &h->feed;
  const double u = t - f->slip_since;
  sw_feed_now now = {.fed = f->fed + f->slip,
                     .speed = f->speed + f->slip_speed + f->slip_growth * u,
                     .acceleration = f->slip_growth};
  now.fed += f->speed * (t - f->since) + (f->slip_speed + 0.5 * f->slip_growth * u) * u;
  if (f->motion) {
    sw_motion_state m;
    sw_error ignored; /* a motion between two points calls no function */
    if (sw_motion_eval(f->motion, t - f->start, &m, &ignored) != SW_OK) return now;
    now.fed += m.pose.p.x;
    now.speed += m.v.x;
    now.acceleration += m.a.x;
  }
  return now;
}

static double arc_at(const sw_feed *f, double fed) { return f->label - f->outward * fed; }

void sw_feed_spare(const sw_feed *f, double fed, double spare[2]) {
  for (int k = 0; k < 2; k++)
    spare[k] = f->spare[k] * fmax(0, 1 - fabs(fed - f->spare_fed[k]) / f->size);
}

/* The plan for a length fed. */
static void slide(sw_scene *s, sw_scene_hold *h, double arc, double fed) {
  sw_plan *p = s->system.bodies[h->wire].plan;
  const size_t node = h->feed.node;
  double spare[2];
  sw_feed_spare(&h->feed, fed, spare);
  const int same = p->s[node] == arc;
  if (same && (node == 0 || p->rest[node - 1] == arc - p->s[node - 1] + spare[0]) &&
      (node == p->edges || p->rest[node] == p->s[node + 1] - arc + spare[1]))
    return;
  sw_plan_slide(p, node, arc, spare);
  if (!same) sw_feed_shape(s, h);
}

void sw_feed_place(sw_scene *s, sw_scene_hold *h, double t, sw_hold_state *state) {
  const sw_feed *f = &h->feed;
  const sw_feed_now now = sw_feed_at(h, t);
  slide(s, h, arc_at(f, now.fed), now.fed);
  const sw_vec along = sw_scale(sw_rotate(state->pose.q, h->director[1]), f->outward);
  state->v = sw_madd(state->v, along, now.speed);
  state->a = sw_madd(state->a, along, now.acceleration);
  state->a = sw_madd(state->a, sw_cross(state->omega, along), 2.0 * now.speed);
}

static void put_arc(sw_scene *s, sw_scene_hold *h, double arc) {
  s->wires[h->wire].mesh.s[h->feed.node] = arc;
  h->s1 = h->s2 = h->s[0] = arc;
}

void sw_feed_follow(sw_scene *s) {
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_scene_hold *h = &s->holds[k];
    if (!h->alive || !h->cls->feeds) continue;
    sw_feed *f = &h->feed;
    const double u = s->time - f->slip_since;
    f->slip += (f->slip_speed + 0.5 * f->slip_growth * u) * u;
    f->slip_speed += f->slip_growth * u;
    f->slip_since = s->time;
    put_arc(s, h, arc_at(f, sw_feed_at(h, s->time).fed));
  }
}

void sw_feed_undo(sw_scene *s) {
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_scene_hold *h = &s->holds[k];
    if (!h->alive || !h->cls->feeds) continue;
    slide(s, h, h->s1, (h->feed.label - h->s1) * h->feed.outward);
  }
}

/* --- forces ------------------------------------------------------------------- */

/* Curvature where the wire leaves the guide on the clamp's side, squared and times EI. Of a
 * wire with frames it is that at rest and what bends it besides. */
static double bent(const sw_system *s, const sw_body *b, size_t clamp, const double *x) {
  const sw_plan *p = b->plan;
  const sw_clamp_hinge *c = &p->clamps[clamp];
  const size_t at = 2 * (size_t)c->hold + (c->side > 0 ? 1 : 0), number = p->nodes + clamp;
  const double *edge = x + 3 * (b->first_node + c->edge);
  const sw_vec d = sw_vec_at(s->directors_now, at);
  const sw_vec t = sw_unit_or(sw_sub(sw_load(edge + 3), sw_load(edge)), d);
  if (!b->spin_block) {
    const double curvature = 2.0 * asin(fmin(1.0, 0.5 * sw_dist(d, t))) / c->length;
    return p->beam.EI * curvature * curvature;
  }
  const sw_edge_frame held = {d, sw_vec_at(s->normals_now, at)};
  const double *const *n = b->field.normals;
  const sw_edge_frame own = {t, sw_v(n[0][c->edge], n[1][c->edge], n[2][c->edge])};
  double bend[2], sum = 0;
  sw_hinge_bend(c->side > 0 ? &held : &own, c->side > 0 ? &own : &held,
                b->field.hinge_twist[number], bend);
  for (int k = 0; k < 2; k++) {
    const double rest = p->rest_bend[2 * number + k];
    const double curvature = (bend[k] - rest) / c->length + 2.0 * rest / p->rest[c->edge];
    sum += p->beam.EI_axis[k] * curvature * curvature;
  }
  return sum;
}

/* The same of its twist, times GJ. */
static double twisted(const sw_system *s, const sw_body *b, size_t clamp) {
  const sw_plan *p = b->plan;
  if (b->spin_block) {
    const double rest = p->rest_twist[p->nodes + clamp];
    const double strain = (b->field.hinge_twist[p->nodes + clamp] - rest) / p->clamps[clamp].length;
    const double twist = strain + 2.0 * rest / p->rest[p->clamps[clamp].edge];
    return p->beam.GJ * twist * twist;
  }
  for (size_t k = 0; b->has_twist && k < p->span_count; k++) {
    if (p->spans[k].left != clamp && p->spans[k].right != clamp) continue;
    const double twist = s->twist[b->first_span + k] / p->spans[k].length;
    return p->beam.GJ * twist * twist;
  }
  return 0;
}

/* The guide's walls bear a force along the wire too: where it leaves them bent, each length
 * that is paid out takes up the energy of the bend at the drive's cost, and the walls push the
 * wire out with EI curvature^2 / 2 (Bigoni et al. 2015). The drive bears the rest. */
double sw_feed_drive(const sw_scene *s, const sw_scene_hold *h, const double *x) {
  const sw_system *y = &s->system;
  const sw_body *b = &y->bodies[h->wire];
  const int number = (int)h->feed.number;
  double sum = 0;
  for (size_t i = 0; i < y->held_count; i++)
    if (y->held[i].hold == number)
      sum += sw_dot(y->held[i].reaction, sw_load(y->directors_now + 3 * (2 * h->feed.number + 1)));
  sum *= h->feed.outward;
  for (size_t c = 0; c < b->plan->clamp_count; c++) {
    if (b->plan->clamps[c].hold != number) continue;
    const int grows = b->plan->clamps[c].side * h->feed.outward;
    sum -= 0.5 * grows * (bent(y, b, c, x) + twisted(y, b, c));
  }
  return sum;
}

/* --- what the user asks --------------------------------------------------------- */

static sw_scene_hold *feeding(sw_scene *s, sw_handle hold, sw_error *err) {
  sw_scene_hold *h = sw_scene_living_hold(s, hold, err);
  if (!h || h->cls->feeds) return h;
  sw_fail(err, SW_EINVAL, "%s '%s' feeds nothing: the wire slides through those of scene:feed only",
          h->cls->name, h->name);
  return NULL;
}

/* Stop where it is; what follows starts from now. */
static sw_status open_feed(sw_scene *s, sw_handle hold, sw_scene_hold **h, sw_error *err) {
  *h = feeding(s, hold, err);
  if (!*h) return SW_EDEAD;
  return sw_scene_editable(s, err);
}

static void stop(sw_scene *s, sw_feed *f, const sw_feed_now *now) {
  f->fed = now->fed - f->slip;
  f->since = s->time;
  f->speed = f->slip_speed = f->slip_growth = f->slip_way = 0;
  f->push = NAN;
  sw_motion_release(f->motion);
  f->motion = NULL;
  s->discontinuous = 1;
}

sw_status sw_scene_feed_speed(sw_scene *s, sw_handle hold, double speed, sw_error *err) {
  sw_scene_hold *h;
  SW_TRY(open_feed(s, hold, &h, err));
  const sw_feed_now now = sw_feed_at(h, s->time);
  stop(s, &h->feed, &now);
  h->feed.speed = speed;
  return SW_OK;
}

sw_status sw_scene_feed_push(sw_scene *s, sw_handle hold, double force, sw_error *err) {
  sw_scene_hold *h;
  SW_TRY(open_feed(s, hold, &h, err));
  const sw_feed_now now = sw_feed_at(h, s->time);
  stop(s, &h->feed, &now);
  h->feed.push = force;
  h->feed.slip_speed = now.speed;
  return SW_OK;
}

sw_status sw_scene_feed_limit(sw_scene *s, sw_handle hold, double force, sw_error *err) {
  sw_scene_hold *h;
  SW_TRY(open_feed(s, hold, &h, err));
  h->feed.limit = force;
  if (isnan(force) && isnan(h->feed.push))
    h->feed.slip_speed = h->feed.slip_growth = h->feed.slip_way = 0;
  return SW_OK;
}

/* Wire on the side of the guide from which this length would come [m]. */
static double reserve(const sw_scene *s, const sw_scene_hold *h, double length) {
  const sw_mesh *m = &s->wires[h->wire].mesh;
  const int from_far = length * h->feed.outward < 0;
  const int is_end = from_far ? h->s1 >= m->s[m->n - 1] : h->s1 <= m->s[0];
  if (is_end) return HUGE_VAL; /* a spool */
  return from_far ? m->s[m->n - 1] - h->s1 : h->s1 - m->s[0];
}

sw_status sw_scene_feed_length(sw_scene *s, sw_handle hold, sw_motion *motion, double length,
                               sw_error *err) {
  sw_scene_hold *h;
  SW_TRY(open_feed(s, hold, &h, err));
  const double there = reserve(s, h, length);
  if (!(fabs(length) < there))
    return sw_fail(err, SW_EINVAL,
                   "feed '%s': length = %g m is not allowed; %.6g m of wire '%s' are there",
                   h->name, length, there, s->wires[h->wire].name);
  const sw_feed_now now = sw_feed_at(h, s->time);
  stop(s, &h->feed, &now);
  h->feed.motion = sw_motion_retain(motion);
  h->feed.start = s->time;
  return SW_OK;
}

sw_status sw_scene_feed_state(sw_scene *s, sw_handle hold, sw_feed_state *out, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  const sw_scene_hold *h = feeding(s, hold, err);
  if (!h) return SW_EDEAD;
  const sw_feed_now now = sw_feed_at(h, s->time);
  *out = (sw_feed_state){now.fed, now.speed, h->feed.drive, h->feed.limit};
  return SW_OK;
}
