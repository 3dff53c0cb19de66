/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks whether a wire, its forces, its holds and the tools stay in a plane. */
#include "read/frames.h"

/* Largest deviation from a plane: over the wire's size, or as an angle [rad]. It is the error of
 * 32-bit floats and iterations. At four times the value a wire that leaves its plane by 0.1 mm is
 * still noticed; at a third, one that slides round a drum in poses leaves its plane; at a
 * thirtieth, wires rotated with their scene are barely flat (spec/model/flat_spec) [-]. */
static const double NONE = 3e-5;
/* The same for forces, over the largest one. Friction across the plane is only as small as the
 * iteration leaves it: up to 5e-4 where a wire slides round a drum in poses. With NONE half of such
 * runs were taken for rolling on their way. A force that matters moves the wire out of the plane
 * [-]. */
static const double NO_FORCE = 2e-3;

typedef struct plane {
  sw_vec at, normal; /* [m], [-] */
  double size;       /* largest distance of a node from `at` [m] */
} plane;

typedef struct look {
  const sw_scene *scene;
  size_t w;
  size_t first; /* frame [-] */
} look;

/* Returns the node farthest from a point, or from the line through it along a unit vector. */
static sw_vec farthest(const look *l, sw_vec from, sw_vec along) {
  sw_vec best = from;
  double most = 0;
  for (size_t f = l->first; f < sw_scene_frames(l->scene); f++) {
    size_t count;
    const float *x = sw_scene_frame_wire(l->scene, f, l->w, &count);
    for (size_t i = 0; x && i < count; i++) {
      const sw_vec to = sw_sub(sw_vec_of(x + 3 * i), from);
      const double far = sw_norm2(sw_madd(to, along, -sw_dot(to, along)));
      if (far > most) most = far, best = sw_vec_of(x + 3 * i);
    }
  }
  return best;
}

/* Returns the largest part of a force across a unit vector, over the largest force: 0 to 1 [-]. */
static sw_vec largest_across(const look *l, sw_vec along) {
  sw_vec best = sw_v(0, 0, 0);
  double most = 0, largest = 0;
  for (size_t f = l->first; f < sw_scene_frames(l->scene); f++) {
    size_t count;
    const float *v = sw_scene_frame_values(l->scene, f, l->w, &count);
    for (size_t i = 0; v && i < count; i++, v += SW_FRAME_VALUES) {
      const sw_vec push = sw_vec_of(v + SW_FRAME_FORCE);
      const sw_vec part = sw_madd(push, along, -sw_dot(push, along));
      largest = fmax(largest, sw_norm(push));
      if (sw_norm2(part) > most) most = sw_norm2(part), best = part;
    }
  }
  return largest > 0 ? sw_scale(best, 1 / largest) : best;
}

/* A wire that leaves its line by more than this share of its size shows its plane better than
 * forces do [-]. */
static const double CURVED = 0.01;

/* Finds the plane through a line along the wire and the point farthest from it: of a node, over the
 * wire's size, or of a force, over the largest. The nodes of a straight wire alone do not show its
 * plane. 0: there is none. */
static int find_plane(const look *l, plane *p) {
  size_t count;
  const float *x = sw_scene_frame_wire(l->scene, l->first, l->w, &count);
  if (!x || count == 0) return 0;
  p->at = sw_vec_of(x);
  const sw_vec way = sw_sub(farthest(l, p->at, sw_v(0, 0, 0)), p->at);
  const sw_vec along = sw_unit_or(way, sw_v(0, 0, 0));
  const sw_vec aside = sw_sub(farthest(l, p->at, along), p->at);
  const sw_vec push = sw_cross(along, largest_across(l, along));
  p->size = sw_norm(way);
  const sw_vec node = p->size > 0 ? sw_scale(sw_cross(along, aside), 1 / p->size) : aside;
  const sw_vec across = sw_norm(node) > CURVED            ? node
                        : sw_norm2(push) > sw_norm2(node) ? push
                                                          : node;
  p->normal = sw_unit_or(across, sw_v(0, 0, 0));
  return sw_norm(across) > NONE;
}

/* 1 if in this frame places and forces lie in the plane, and there is no twist. */
static int is_in(const look *l, const plane *p, size_t frame) {
  const double radius = sw_scene_frame_radius(l->scene, l->w);
  double force = 0, off = 0, twist = 0;
  size_t count, values;
  const float *x = sw_scene_frame_wire(l->scene, frame, l->w, &count);
  const float *v = sw_scene_frame_values(l->scene, frame, l->w, &values);
  if (!x || !v || values != count) return 0;
  for (size_t i = 0; i < count; i++, v += SW_FRAME_VALUES) {
    const sw_vec push = sw_vec_of(v + SW_FRAME_FORCE);
    const double away = sw_dot(p->normal, sw_sub(sw_vec_of(x + 3 * i), p->at));
    if (!(fabs(away) <= NONE * p->size)) return 0;
    force = fmax(force, sw_norm(push)), off = fmax(off, fabs(sw_dot(p->normal, push)));
    twist = fmax(twist, fabs((double)v[SW_FRAME_TWIST]));
  }
  return off <= NO_FORCE * force && twist <= NONE * force * radius;
}

/* 1 if something turned only about the normal since the first frame. */
static int turns_in(const plane *p, const float *pose, const float *first) {
  const sw_quat a = {(double)first[3], (double)first[4], (double)first[5], (double)first[6]};
  const sw_quat b = {(double)pose[3], (double)pose[4], (double)pose[5], (double)pose[6]};
  const sw_vec turn = sw_quat_log(sw_quat_mul(b, sw_quat_conj(a)));
  return sw_norm(sw_madd(turn, p->normal, -sw_dot(turn, p->normal))) <= NONE;
}

static int holds_turn_in(const look *l, const plane *p, size_t frame) {
  const float *pose, *first;
  int holds, held;
  for (sw_frame_kind of = SW_FRAME_HOLDS; of <= SW_FRAME_TOOLS; of++)
    for (size_t k = 0; (pose = sw_scene_frame_body(l->scene, frame, of, k, &holds)) != NULL; k++) {
      first = sw_scene_frame_body(l->scene, l->first, of, k, &held);
      if (holds && (!first || !held || !turns_in(p, pose, first))) return 0;
    }
  return 1;
}

int sw_scene_frames_flat(const sw_scene *s, double start, size_t w) {
  look l = {.scene = s, .w = w};
  plane p;
  while (l.first < sw_scene_frames(s) && sw_scene_frame_time(s, l.first) < start) l.first++;
  if (l.first == sw_scene_frames(s) || !find_plane(&l, &p)) return 0;
  for (size_t f = l.first; f < sw_scene_frames(s); f++)
    if (!is_in(&l, &p, f) || !holds_turn_in(&l, &p, f)) return 0;
  return 1;
}
