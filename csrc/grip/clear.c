/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Jaws that have squeezed a section and are about to open on a rod. The rod is as wide as the wire
 * was before, so the pads would be deep in it and throw it out. */
#include <math.h>

#include "grip/jaws.h"
#include "scene/drive.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "shape/shape.h"
#include "system/system.h"

/* 1 if the pad reaches into one of the body's edges. */
static int is_in(const sw_system *system, const sw_body *b, const sw_shape *shape, sw_pose pad) {
  sw_closest near[SW_CLOSEST_MAX];
  for (size_t i = 0; i + 1 < b->plan->nodes; i++) {
    const double skin = sw_plan_skin(b->plan, i);
    const sw_vec from = sw_pose_local(pad, sw_vec_at(system->x, b->first_node + i));
    const sw_vec to = sw_pose_local(pad, sw_vec_at(system->x, b->first_node + i + 1));
    const int n = sw_shape_segment(shape, from, to, skin, near);
    for (int k = 0; k < n; k++)
      if (near[k].gap < skin) return 1;
  }
  return 0;
}

/* *clear: 1 if no finger reaches into the wire at this opening. */
static sw_status look(sw_scene *s, sw_tool *t, size_t wire, double opening, int *clear,
                      sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  const double before = t->jaw.opening;
  sw_status status = SW_OK;
  *clear = 1;
  t->jaw.opening = opening;
  for (size_t k = 0; k < t->pads && *clear && status == SW_OK; k++) {
    const sw_scene_obstacle *o = sw_scene_obstacle_in(s, t->pad[k].obstacle);
    sw_motion_state at;
    if (t->pad[k].finger < 0) continue;
    status = sw_drive_eval(s, &o->drive, sw_scene_time(s), &at, err);
    if (status == SW_OK) *clear = !is_in(system, &system->bodies[wire], o->shape, at.pose);
  }
  t->jaw.opening = before;
  return status;
}

static const double FARTHEST = 4.0; /* longest way of the opening, over the wire's radius [-] */
static const double NEAR = 1e-6;    /* allowed gap at the pads, over the wire's radius [-] */

sw_status sw_jaws_clear(sw_scene *s, sw_tool *t, size_t wire, sw_error *err) {
  const double radius = sw_scene_system(s)->bodies[wire].plan->beam.radius;
  sw_jaw *j = &t->jaw;
  double deep = j->opening, free = deep + FARTHEST * radius;
  int clear;
  j->mode = SW_JAW_STILL, j->status = SW_JAW_RESTS;
  j->speed = j->now = j->stiffness = 0;
  j->since = sw_scene_time(s);
  SW_TRY(look(s, t, wire, deep, &clear, err));
  if (clear) return SW_OK;
  SW_TRY(look(s, t, wire, free, &clear, err));
  if (!clear) return SW_OK; /* something else is in the way */
  while (free - deep > NEAR * radius) {
    const double middle = 0.5 * (free + deep);
    SW_TRY(look(s, t, wire, middle, &clear, err));
    *(clear ? &free : &deep) = middle;
  }
  j->opening = free;
  return SW_OK;
}
