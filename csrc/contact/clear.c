/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moves meshes of elements out of obstacles into which they were drawn a little. The section of
 * such a mesh is a polygon; over its corners it is 2.7 % wider than the radius. If it is drawn with
 * its axis one radius above a table, it is that deep in it. It came out at SW_LET_OUT, in 10 ms.
 * Pads that closed meanwhile kept it there, and the remaining depth became force: 2.9 instead of
 * 0.62 N (spec/contact/drawn_wide_spec). Therefore such a wire starts its motion where it only
 * touches. In poses it comes out in one step anyway. */
#include <math.h>

#include "contact/touch.h"

/* Largest shift of a wire, over its radius. Deeper wires come out slowly. In a groove of 90 degrees
 * the shift is sqrt(2) times as large as on a plane [-]. */
static const double FARTHEST = 0.05;
/* A wire is free up to this depth, far below the depth of a resting wire [m]. */
static const double FREE = 1e-10;
/* Each round moves the wire out where it is deepest. In a groove of 90 degrees two rounds are
 * enough; in a narrower one each round leaves cos^2 of its angle of the depth [-]. */
enum { ROUNDS = 40 };

/* Depth of a body, and the direction out [m]. */
typedef struct depth {
  double most;
  sw_vec out; /* [-] */
} depth;

static void deepen(depth *d, const sw_closest *near, double skin, sw_quat q) {
  if (!(skin - near->gap > d->most)) return;
  d->most = skin - near->gap;
  d->out = sw_rotate(q, near->normal);
}

static void look_at_sides(const sw_contact *c, const sw_system *s, const sw_body *b, size_t i,
                          size_t o, depth *d) {
  const sw_web *w = b->plan->web;
  const sw_pose pose = c->start[o].pose;
  const double skin = sw_plan_skin(b->plan, i);
  const sw_vec from = sw_contact_where(c, s->x, b->first_node + i, b->first_node + i, 0);
  sw_closest near[SW_CLOSEST_MAX];
  for (size_t k = w->side_first[i]; k < w->side_first[i + 1]; k++) {
    const size_t other = b->first_node + w->side[k];
    const sw_vec to = sw_contact_where(c, s->x, other, other, 0);
    const int n = sw_shape_segment(c->obstacles[o].shape, sw_pose_local(pose, from),
                                   sw_pose_local(pose, to), skin, near);
    for (int j = 0; j < n; j++) deepen(d, &near[j], skin, pose.q);
  }
}

/* A ball around a body [m]. */
typedef struct ball {
  sw_vec centre;
  double radius;
} ball;

static ball around(const sw_contact *c, const sw_system *s, const sw_body *b) {
  ball out = {.centre = sw_contact_where(c, s->x, b->first_node, b->first_node, 0)};
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const sw_vec x = sw_contact_where(c, s->x, b->first_node + i, b->first_node + i, 0);
    out.radius = fmax(out.radius, sw_dist(x, out.centre) + sw_plan_skin(b->plan, i));
  }
  return out;
}

/* 1 if the ball is outside the box around the shape; a fast check for up to ten thousand shapes. */
static int is_far(const sw_shape *shape, sw_pose pose, ball around_it) {
  const sw_bounds box = sw_shape_bounds(shape);
  const sw_vec p = sw_pose_local(pose, around_it.centre);
  const sw_vec beside = sw_v(fmax(0.0, fmax(box.min.x - p.x, p.x - box.max.x)),
                             fmax(0.0, fmax(box.min.y - p.y, p.y - box.max.y)),
                             fmax(0.0, fmax(box.min.z - p.z, p.z - box.max.z)));
  return sw_norm(beside) > around_it.radius;
}

static depth find_depth(const sw_contact *c, const sw_system *s, const sw_body *b) {
  const ball all = around(c, s, b);
  depth d = {.most = FREE};
  for (size_t o = 0; o < c->count; o++) {
    const sw_pose pose = c->start[o].pose;
    if (c->obstacles[o].off || is_far(c->obstacles[o].shape, pose, all)) continue;
    for (size_t i = 0; i < b->plan->nodes; i++) {
      if (!b->plan->web->outer[i]) continue;
      const double skin = sw_plan_skin(b->plan, i);
      const sw_vec x = sw_contact_where(c, s->x, b->first_node + i, b->first_node + i, 0);
      sw_closest near;
      if (sw_shape_point(c->obstacles[o].shape, sw_pose_local(pose, x), skin, &near))
        deepen(&d, &near, skin, pose.q);
      if (!c->flat[o]) look_at_sides(c, s, b, i, o, &d);
    }
  }
  return d;
}

/* 1 if the body may be moved: it has no hold and has not touched anything yet. */
static int is_loose(const sw_contact *c, const sw_body *b) {
  const sw_plan *p = b->plan;
  if (!p->web || !p->web->per_ring || !(p->web->solid_rate2 > 0)) return 0;
  for (size_t i = 0; i < p->nodes; i++)
    if (p->held[i] != SW_FREE) return 0;
  for (size_t m = 0; m < c->memory_count; m++)
    if (c->memory[m].node >= b->first_node && c->memory[m].node < b->first_node + p->nodes)
      return 0;
  return 1;
}

static void shift(sw_system *s, const sw_body *b, sw_vec by) {
  for (size_t i = b->first_node; i < b->first_node + b->plan->nodes; i++)
    sw_store(s->x + 3 * i, sw_add(sw_vec_at(s->x, i), by));
}

static void clear(const sw_contact *c, sw_system *s, const sw_body *b) {
  sw_vec way = sw_v(0, 0, 0);
  depth d = find_depth(c, s, b);
  for (int k = 0; k < ROUNDS && d.most > FREE; k++) {
    const sw_vec by = sw_scale(d.out, d.most);
    way = sw_add(way, by);
    shift(s, b, by);
    if (sw_norm(way) > FARTHEST * b->plan->beam.radius) break;
    d = find_depth(c, s, b);
  }
  if (d.most > FREE) shift(s, b, sw_neg(way));
}

sw_status sw_contact_clear(sw_contact *c, sw_system *s, double t, int (*is_new)(void *, size_t),
                           void *user, sw_error *err) {
  int any = c->fresh;
  for (size_t b = 0; b < s->body_count && !any; b++) any = is_new(user, b);
  if (!any) return SW_OK;
  SW_TRY(sw_contact_open(c, t, 0, err));
  if (sw_contact_sink(c, s) != SW_OK) return sw_fail(err, SW_ENOMEM, "contact: out of memory");
  for (size_t b = 0; b < s->body_count; b++)
    if ((c->fresh || is_new(user, b)) && is_loose(c, &s->bodies[b])) clear(c, s, &s->bodies[b]);
  return SW_OK;
}
