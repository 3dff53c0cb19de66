/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds crashes of a tool's parts with obstacles. Both are rigid and follow their prescribed
 * motion, so nothing stops them; a crash is only reported. Overlap is searched at the bones
 * (corners, edges, axes) of the parts and at the ends of the obstacles' bones. */
#include <math.h>

#include "grip/jaws.h"
#include "link/hold.h"
#include "scene/drive.h"
#include "scene/events.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"

static const double NOTICED = 1e-5; /* a smaller overlap is no crash [m] */

typedef struct overlap {
  const sw_shape *other;
  sw_pose pose; /* of the part, in the obstacle's coordinates */
  double depth; /* largest so far [m] */
} overlap;

static void look_at_point(overlap *o, sw_vec local, double skin) {
  sw_closest near;
  if (sw_shape_point(o->other, sw_pose_point(o->pose, local), skin, &near))
    o->depth = fmax(o->depth, skin - near.gap);
}

static void look_at_bone(void *user, sw_vec a, sw_vec b, double skin) {
  overlap *o = user;
  sw_closest near[SW_CLOSEST_MAX];
  if (a.x == b.x && a.y == b.y && a.z == b.z) {
    look_at_point(o, a, skin);
    return;
  }
  const int n =
      sw_shape_segment(o->other, sw_pose_point(o->pose, a), sw_pose_point(o->pose, b), skin, near);
  for (int i = 0; i < n; i++) o->depth = fmax(o->depth, skin - near[i].gap);
}

/* Checks the points only; they find parts that stick out into the middle of a face. */
static void look_at_end(void *user, sw_vec a, sw_vec b, double skin) {
  if (a.x == b.x && a.y == b.y && a.z == b.z) look_at_point(user, a, skin);
}

/* Returns the depth of the overlap of a part and an obstacle [m]. */
static double overlap_of(const sw_shape *part, sw_pose at, const sw_shape *other, sw_pose there) {
  overlap o = {.other = other, .pose = sw_pose_from(there, at)};
  sw_shape_bones(part, look_at_bone, &o);
  if (sw_shape_is(other, SW_SHAPE_LISTED)) return o.depth; /* too many to check one by one */
  overlap back = {.other = part, .pose = sw_pose_from(at, there)};
  sw_shape_bones(other, look_at_end, &back);
  return fmax(o.depth, back.depth);
}

/* 1 if the balls around both are apart. Half spaces have no bounds and never are. */
static int far_apart(const sw_shape *part, sw_pose at, const sw_shape *other, sw_pose there) {
  const sw_bounds b = sw_shape_bounds(part), c = sw_shape_bounds(other);
  const sw_vec p = sw_pose_point(at, sw_lerp(b.min, b.max, 0.5));
  const sw_vec q = sw_pose_point(there, sw_lerp(c.min, c.max, 0.5));
  return sw_dist(p, q) > 0.5 * (sw_dist(b.min, b.max) + sw_dist(c.min, c.max));
}

/* Finds the obstacle that a part of the tool is deepest in; depth 0: none. */
static sw_status find_crash(sw_scene *s, size_t slot, sw_crash *out, sw_error *err) {
  const sw_tool *t = sw_scene_tool_in(s, slot);
  sw_motion_state at[SW_TOOL_PADS], there;
  out->depth = 0;
  for (size_t k = 0; k < t->pads; k++)
    SW_TRY(sw_drive_eval(s, &sw_scene_obstacle_in(s, t->pad[k].obstacle)->drive, sw_scene_time(s),
                         &at[k], err));
  for (size_t i = 0; i < sw_scene_obstacle_slots(s); i++) {
    const sw_scene_obstacle *o = sw_scene_obstacle_in(s, i);
    if (!t->pads || !o->alive || o->drive.tool == 1 + slot) continue;
    SW_TRY(sw_drive_eval(s, &o->drive, sw_scene_time(s), &there, err));
    for (size_t k = 0; k < t->pads; k++) {
      const sw_shape *part = sw_scene_obstacle_in(s, t->pad[k].obstacle)->shape;
      if (far_apart(part, at[k].pose, o->shape, there.pose)) continue;
      const double depth = overlap_of(part, at[k].pose, o->shape, there.pose);
      if (depth <= NOTICED || depth <= out->depth) continue;
      *out = (sw_crash){sw_scene_time(s), depth, t->pad[k].obstacle, i};
    }
  }
  return SW_OK;
}

sw_status sw_tool_look_out(sw_scene *s, size_t slot, sw_error *err) {
  sw_tool *t = sw_scene_tool_in(s, slot);
  sw_crash now = {0};
  SW_TRY(find_crash(s, slot, &now, err));
  if (now.depth > 0 && !t->crashing) t->crash = now; /* a new one */
  t->crashing = now.depth > 0;
  if (t->crashing)
    sw_scene_tell(s, "crash", t->name, NAN, now.depth, "'%s' runs %.3g mm deep into '%s'",
                  sw_scene_obstacle_in(s, now.part)->name, 1e3 * now.depth,
                  sw_scene_obstacle_in(s, now.obstacle)->name);
  return SW_OK;
}
