/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports a line that lies inside an obstacle with edges at the end of a run. Where a path is drawn
 * round a corner with edges longer than the obstacle lets them be, the wire between two nodes
 * begins inside. Touches usually push it out, but it may stay there, and then nothing presses on
 * it. */
#include <math.h>

#include "body/body.h"
#include "contact/contact.h"
#include "scene/drive.h"
#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/observe.h"

/* An axis deeper than this share of the radius is inside: touches keep it outside [-]. */
static const double DEEP = 0.5;
/* Places looked at per edge [-]. */
enum { PLACES = 8 };

/* The deepest place found [m]. */
typedef struct deepest {
  double depth, s;
  const sw_scene_obstacle *obstacle;
} deepest;

static double gap_at(const sw_scene_obstacle *o, const sw_pose *pose, sw_vec x, double reach) {
  sw_closest near;
  return sw_shape_point(o->shape, sw_pose_local(*pose, x), reach, &near) ? near.gap : reach;
}

static void look(const sw_scene *s, const sw_scene_wire *w, const sw_body *b, size_t edge,
                 const sw_scene_obstacle *o, const sw_pose *pose, deepest *most) {
  const sw_plan *p = b->plan;
  for (int k = 1; k < PLACES; k++) {
    const double at = p->s[edge] + (p->s[edge + 1] - p->s[edge]) * k / PLACES;
    sw_point_state here;
    sw_line_at(s, w, b, at, &here);
    const double depth = -gap_at(o, pose, here.position, p->beam.radius);
    if (depth > most->depth) *most = (deepest){depth, at - w->mesh.s[0], o};
  }
}

static void look_at(const sw_scene *s, const sw_scene_wire *w, const sw_body *b,
                    const sw_scene_obstacle *o, const sw_pose *pose, deepest *most) {
  const sw_plan *p = b->plan;
  const double *x = sw_scene_system((sw_scene *)s)->x + 3 * b->first_node;
  for (size_t e = 0; e < p->edges; e++) {
    const double reach = 0.5 * sw_dist(sw_vec_at(x, e), sw_vec_at(x, e + 1));
    if (p->held[e] != SW_FREE && p->held[e + 1] != SW_FREE) continue;
    const sw_vec middle = sw_scale(sw_add(sw_vec_at(x, e), sw_vec_at(x, e + 1)), 0.5);
    if (gap_at(o, pose, middle, reach) < reach) look(s, w, b, e, o, pose, most);
  }
}

static void watch(sw_scene *s, const sw_scene_wire *w, const sw_body *b) {
  size_t count;
  const int *busy = sw_contact_busy(sw_scene_contact(s), &count);
  deepest most = {DEEP * b->plan->beam.radius, 0, NULL};
  for (size_t k = 0; k < count; k++) {
    const sw_scene_obstacle *o = sw_scene_obstacle_in(s, (size_t)busy[k]);
    sw_motion_state at;
    sw_error ignored;
    if (!o->alive || o->off || o->drive.tool || !sw_shape_has_edges(o->shape) ||
        sw_shape_class_convex(sw_shape_class_find(sw_shape_kind(o->shape))) == 0)
      continue;
    if (sw_drive_eval(s, &o->drive, sw_scene_time(s), &at, &ignored) != SW_OK) continue;
    look_at(s, w, b, o, &at.pose, &most);
  }
  if (!most.obstacle) return;
  sw_scene_tell(s, "inside", w->name, most.s, most.depth,
                "the axis of wire '%s' lies %.3g mm inside '%s' at s = %.4g m: touches do not hold "
                "it out, and its forces and way may be wrong. Use more segments, or draw the path "
                "farther from the obstacle",
                w->name, 1e3 * most.depth, most.obstacle->name, most.s);
}

void sw_scene_end_inside(sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  if (!sw_scene_contact(s) || !sw_scene_is_built(s)) return;
  for (size_t k = 0; k < system->body_count; k++) {
    const sw_scene_wire *w = sw_scene_wire_in(s, k);
    if (!sw_scene_is_loose(w) && !system->bodies[k].plan->web) watch(s, w, &system->bodies[k]);
  }
}
