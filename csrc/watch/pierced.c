/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports objects of particles into whose solid elements something reaches. Only the particles and
 * edges of their surface touch: what is smaller than a face passes through it. */
#include <math.h>

#include "scene/drive.h"
#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

/* Depth that is reported, over the contact radius and over the element's largest width, whichever
 * is more: a face between its edges may lie on a round obstacle a little deeper [-]. */
static const double OF_SKIN = 0.5, OF_SIZE = 0.02;
/* Most projections in turn onto an obstacle and an element [-]. */
enum { TURNS = 24 };

enum { MOST_FACES = 6 };

typedef struct element {
  sw_vec corner[SW_WEB_SOLID_NODES], middle;
  size_t corners, faces;
  sw_vec at[MOST_FACES], out[MOST_FACES]; /* planes of its faces */
  double reach;                           /* largest distance of a corner from the middle [m] */
  double told;                            /* depth that is reported [m] */
} element;

static void add_face(element *e, const int *of, int n) {
  const sw_vec a = e->corner[of[0]], b = e->corner[of[1]], c = e->corner[of[2]];
  const sw_vec d = e->corner[of[n - 1]];
  const sw_vec across =
      n == 3 ? sw_cross(sw_sub(b, a), sw_sub(c, a)) : sw_cross(sw_sub(c, a), sw_sub(d, b));
  sw_vec at = sw_v(0, 0, 0);
  for (int k = 0; k < n; k++) at = sw_madd(at, e->corner[of[k]], 1.0 / n);
  const sw_vec out = sw_unit_or(across, sw_v(0, 0, 0));
  e->at[e->faces] = at;
  e->out[e->faces++] = sw_dot(out, sw_sub(at, e->middle)) < 0 ? sw_neg(out) : out;
}

static element element_of(const sw_body *b, const double *x, const sw_web_solid *solid) {
  element e = {.middle = {0, 0, 0}, .corners = solid->count};
  const int n = (int)solid->count / 2;
  int low[4] = {0}, high[4] = {0};
  for (size_t k = 0; k < e.corners; k++) {
    e.corner[k] = sw_vec_at(x, b->first_node + solid->node[k]);
    e.middle = sw_madd(e.middle, e.corner[k], 1.0 / (double)e.corners);
  }
  for (size_t k = 0; k < e.corners; k++) e.reach = fmax(e.reach, sw_dist(e.middle, e.corner[k]));
  for (int k = 0; k < n; k++) {
    const int next = (k + 1) % n, side[4] = {k, next, n + next, n + k};
    low[k] = k, high[k] = n + k;
    add_face(&e, side, 4);
  }
  add_face(&e, low, n);
  add_face(&e, high, n);
  e.told = fmax(OF_SKIN * b->plan->web->skin, OF_SIZE * 2.0 * e.reach);
  return e;
}

/* Depth of a point below the nearest face [m]. */
static double depth_in(const element *e, sw_vec p) {
  double depth = HUGE_VAL;
  for (size_t k = 0; k < e->faces; k++)
    depth = fmin(depth, -sw_dot(e->out[k], sw_sub(p, e->at[k])));
  return depth;
}

static sw_vec project(const element *e, sw_vec p) {
  for (size_t k = 0; k < e->faces; k++)
    p = sw_madd(p, e->out[k], -fmax(0.0, sw_dot(e->out[k], sw_sub(p, e->at[k]))));
  return p;
}

/* Returns how deep a convex obstacle has the element in it, if that is to be reported; else 0 [m].
 * Projections in turn onto both find a common point, if there is one. */
static double reaches_into(const element *e, const sw_shape *shape, const sw_pose *pose) {
  sw_vec p = e->middle;
  for (int turn = 0; turn < TURNS; turn++) {
    sw_closest near;
    if (!sw_shape_point(shape, sw_pose_local(*pose, p), e->reach, &near)) return 0;
    if (near.gap < -e->told && depth_in(e, p) > -0.01 * e->reach) return -near.gap;
    const sw_vec n = sw_rotate(pose->q, near.normal);
    double nearer = 0;
    for (size_t k = 0; k < e->corners; k++)
      nearer = fmax(nearer, sw_dot(n, sw_sub(p, e->corner[k])));
    if (near.gap - nearer > -e->told) return 0; /* no point of the element is deep enough */
    p = project(e, sw_madd(p, n, -fmax(0.0, near.gap + 1.5 * e->told)));
  }
  return 0;
}

static int is_free(const sw_body *b, const sw_web_solid *solid) {
  for (size_t k = 0; k < solid->count; k++)
    if (b->plan->held[solid->node[k]] == SW_FREE) return 1;
  return 0;
}

static void tell(sw_scene *s, const char *object, const char *what, double depth) {
  sw_scene_tell(s, "pierced", object, NAN, depth,
                "'%s' is %.3g mm deep in an element of object '%s': only the particles and edges "
                "of an object touch, and smaller things pass through its faces. Use smaller "
                "elements",
                what, 1e3 * depth, object);
}

/* Obstacles whose surface is flat, like a plane's, touch the corners first. */
static int may_pierce(const sw_scene_obstacle *o) {
  const sw_shape_class *class = sw_shape_class_find(sw_shape_kind(o->shape));
  return o->alive && !o->off && sw_shape_class_convex(class) &&
         isfinite(sw_shape_bounds(o->shape).max.x);
}

static sw_bounds bounds_of(const sw_body *b, const double *x) {
  sw_bounds out = {sw_vec_at(x, b->first_node), sw_vec_at(x, b->first_node)};
  for (size_t i = 1; i < b->plan->nodes; i++) {
    const sw_vec p = sw_vec_at(x, b->first_node + i);
    out.min = sw_v(fmin(out.min.x, p.x), fmin(out.min.y, p.y), fmin(out.min.z, p.z));
    out.max = sw_v(fmax(out.max.x, p.x), fmax(out.max.y, p.y), fmax(out.max.z, p.z));
  }
  return out;
}

static int is_within(const sw_bounds *in, sw_vec p, double reach) {
  return p.x > in->min.x - reach && p.x < in->max.x + reach && p.y > in->min.y - reach &&
         p.y < in->max.y + reach && p.z > in->min.z - reach && p.z < in->max.z + reach;
}

static void watch_obstacles(sw_scene *s, const sw_scene_wire *w, const sw_body *b) {
  const double *x = sw_scene_system(s)->x;
  const sw_bounds bounds = bounds_of(b, x);
  const sw_vec middle = sw_lerp(bounds.min, bounds.max, 0.5);
  const double reach = sw_dist(bounds.min, middle);
  sw_error ignored;
  SW_EACH(obstacle, o, s) {
    sw_motion_state at;
    double most = 0;
    if (!may_pierce(o) || sw_drive_eval(s, &o->drive, sw_scene_time(s), &at, &ignored) != SW_OK)
      continue;
    const sw_bounds of = sw_shape_bounds(o->shape);
    if (!is_within(&of, sw_pose_local(at.pose, middle), reach)) continue;
    for (size_t k = 0; k < b->plan->web->solids; k++) {
      const sw_web_solid *solid = &b->plan->web->solid[k];
      const element e = element_of(b, x, solid);
      if (is_free(b, solid)) most = fmax(most, reaches_into(&e, o->shape, &at.pose));
    }
    if (most > 0) tell(s, w->name, o->name, most);
  }
}

/* Returns how deep a point is in an element of the body; 0: too little to report [m]. */
static double deep_in(const sw_body *b, const double *x, sw_vec p) {
  double most = 0;
  for (size_t k = 0; k < b->plan->web->solids; k++) {
    const element e = element_of(b, x, &b->plan->web->solid[k]);
    if (!(sw_dist(p, e.middle) < e.reach)) continue;
    const double depth = depth_in(&e, p);
    if (depth > e.told) most = fmax(most, depth);
  }
  return most;
}

static void watch_bodies(sw_scene *s, const sw_scene_wire *w, const sw_body *b) {
  const sw_system *system = sw_scene_system(s);
  const sw_bounds bounds = bounds_of(b, system->x);
  for (size_t k = 0; k < system->body_count; k++) {
    const sw_body *other = &system->bodies[k];
    double most = 0;
    for (size_t i = 0; other != b && i < other->plan->nodes; i++) {
      const sw_vec p = sw_vec_at(system->x, other->first_node + i);
      if (is_within(&bounds, p, 0)) most = fmax(most, deep_in(b, system->x, p));
    }
    if (most > 0) tell(s, w->name, sw_scene_wire_in(s, k)->name, most);
  }
}

void sw_scene_watch_pierced(sw_scene *s, size_t wire) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const sw_body *b = &sw_scene_system(s)->bodies[wire];
  if (!sw_scene_is_loose(w) || !b->plan->web->solids) return;
  if (sw_scene_contact(s)) watch_obstacles(s, w, b);
  if (sw_scene_grains(s)) watch_bodies(s, w, b);
}
