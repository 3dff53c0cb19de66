/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Do the parts of a tool run into obstacles? Both are rigid and go where they are told, so nothing
 * stops them; it is noticed and told. Parts are looked at by corners and edges: those of boxes,
 * the axis of round ones, the triangles of meshes; and by corners of boxes that they meet. */
#include <math.h>

#include "scene/events.h"
#include "scene/world.h"

static const double NOTICED = 1e-5; /* overlap of less than this is none [m] */

typedef struct overlap {
  const sw_shape *other;
  sw_pose pose; /* of the part, in the other's coordinates */
  double skin;  /* of the part around its points and edges [m] */
  double depth; /* so far [m] */
} overlap;

static void look_at_point(overlap *o, sw_vec local) {
  sw_closest near;
  if (sw_shape_point(o->other, sw_pose_point(o->pose, local), o->skin, &near))
    o->depth = fmax(o->depth, o->skin - near.gap);
}

static void look_at_edge(overlap *o, sw_vec a, sw_vec b) {
  sw_closest near[SW_CLOSEST_MAX];
  const int n = sw_shape_segment(o->other, sw_pose_point(o->pose, a), sw_pose_point(o->pose, b),
                                 o->skin, near);
  for (int i = 0; i < n; i++) o->depth = fmax(o->depth, o->skin - near[i].gap);
}

static sw_vec corner(const sw_bounds *b, int k) {
  return sw_v(k & 1 ? b->max.x : b->min.x, k & 2 ? b->max.y : b->min.y,
              k & 4 ? b->max.z : b->min.z);
}

static void look_at_box(overlap *o, const sw_bounds *b) {
  for (int k = 0; k < 8; k++) {
    look_at_point(o, corner(b, k));
    for (int axis = 1; axis < 8; axis *= 2)
      if (!(k & axis)) look_at_edge(o, corner(b, k), corner(b, k | axis));
  }
}

static int is_kind(const sw_shape *shape, const char *kind) {
  const char *own = sw_shape_kind(shape);
  while (*own && *own == *kind) own++, kind++;
  return *own == *kind;
}

/* The axis of a cylinder or capsule along z, its flat ends left out. */
static void look_at_axis(overlap *o, const sw_bounds *b) {
  const double radius = b->max.x, half = b->max.z;
  o->skin = radius;
  const sw_vec low = sw_v(0, 0, -fmax(0, half - radius)), high = sw_neg(low);
  look_at_point(o, low);
  look_at_point(o, high);
  look_at_edge(o, low, high);
}

static void look_at_triangles(overlap *o, const sw_shape *part) {
  const double *vertices;
  const int *indices;
  size_t n, triangles;
  sw_shape_triangles(part, &vertices, &n, &indices, &triangles);
  for (size_t i = 0; i < n; i++) look_at_point(o, sw_vec_at(vertices, i));
  for (size_t k = 0; k < 3 * triangles; k++) {
    const size_t next = k % 3 == 2 ? k - 2 : k + 1;
    look_at_edge(o, sw_vec_at(vertices, (size_t)indices[k]),
                 sw_vec_at(vertices, (size_t)indices[next]));
  }
}

static sw_pose pose_in(sw_pose part, sw_pose other) {
  return (sw_pose){sw_pose_local(other, part.p), sw_quat_mul(sw_quat_conj(other.q), part.q)};
}

/* How far a part and an obstacle overlap [m]. */
static double overlap_of(const sw_shape *part, sw_pose at, const sw_shape *other, sw_pose there) {
  const sw_bounds b = sw_shape_bounds(part), c = sw_shape_bounds(other);
  overlap o = {.other = other, .pose = pose_in(at, there)};
  if (is_kind(part, "box"))
    look_at_box(&o, &b);
  else if (is_kind(part, "cylinder") || is_kind(part, "capsule"))
    look_at_axis(&o, &b);
  else
    look_at_triangles(&o, part);
  if (!is_kind(other, "box")) return o.depth;
  overlap back = {.other = part, .pose = pose_in(there, at)};
  for (int k = 0; k < 8; k++) look_at_point(&back, corner(&c, k));
  return fmax(o.depth, back.depth);
}

/* Are balls around both apart? Half spaces have none. */
static int far_apart(const sw_shape *part, sw_pose at, const sw_shape *other, sw_pose there) {
  const sw_bounds b = sw_shape_bounds(part), c = sw_shape_bounds(other);
  const sw_vec p = sw_pose_point(at, sw_lerp(b.min, b.max, 0.5));
  const sw_vec q = sw_pose_point(there, sw_lerp(c.min, c.max, 0.5));
  return sw_dist(p, q) > 0.5 * (sw_dist(b.min, b.max) + sw_dist(c.min, c.max));
}

/* The obstacle that a part of the tool is deepest in; depth 0: none. */
static sw_status find_crash(sw_scene *s, size_t slot, sw_crash *out, sw_error *err) {
  const sw_tool *t = &s->tools[slot];
  sw_motion_state at[SW_TOOL_PADS], there;
  out->depth = 0;
  for (size_t k = 0; k < t->pads; k++)
    SW_TRY(sw_drive_eval(s, &s->obstacles[t->pad[k].obstacle].drive, s->time, &at[k], err));
  for (size_t i = 0; i < s->obstacle_count; i++) {
    const sw_scene_obstacle *o = &s->obstacles[i];
    if (!t->pads || !o->alive || o->drive.tool == 1 + slot) continue;
    SW_TRY(sw_drive_eval(s, &o->drive, s->time, &there, err));
    for (size_t k = 0; k < t->pads; k++) {
      const sw_shape *part = s->obstacles[t->pad[k].obstacle].shape;
      if (far_apart(part, at[k].pose, o->shape, there.pose)) continue;
      const double depth = overlap_of(part, at[k].pose, o->shape, there.pose);
      if (depth <= NOTICED || depth <= out->depth) continue;
      *out = (sw_crash){s->time, depth, t->pad[k].obstacle, i};
    }
  }
  return SW_OK;
}

sw_status sw_tool_look_out(sw_scene *s, size_t slot, sw_error *err) {
  sw_tool *t = &s->tools[slot];
  sw_crash now;
  SW_TRY(find_crash(s, slot, &now, err));
  if (now.depth > 0 && !t->crashing) t->crash = now; /* a new one */
  t->crashing = now.depth > 0;
  if (t->crashing)
    sw_scene_tell(s, "crash", t->name, NAN, now.depth, "'%s' runs %.3g mm deep into '%s'",
                  s->obstacles[now.part].name, 1e3 * now.depth, s->obstacles[now.obstacle].name);
  return SW_OK;
}
