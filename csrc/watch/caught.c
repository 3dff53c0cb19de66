/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports pads that hold a mesh by more than their friction. Only particles and edges of a mesh
 * touch, so that a slice that is not squeezed yet may stand before a pad's end, and the corners of
 * a section resist a turn as those of a nut do. A smooth surface would do neither. */
#include <math.h>

#include "scene/drive.h"
#include "scene/events.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "strand/ring.h"
#include "watch/observe.h"

/* The least force along the pads, or moment about this direction, that is reported, over the
 * largest that friction gives. Slices that glide past the pads' rims add up to 0.15 [-]. */
static const double COUNTS = 1.25;
/* The same as a share of the pads' force, or of this times the radius, for pads with little
 * friction [-]. */
static const double LEAST = 0.05;

/* Forces of a tool's pads on one wire [N]. */
typedef struct grasp {
  sw_vec along;    /* along the pads' width */
  sw_vec turning;  /* moment about this direction, at the middles of sections [N m] */
  double friction; /* largest that the pads' squeeze allows */
  double squeeze;  /* sum of the forces along the way on which pads close */
  double place;    /* of the touch that holds hardest [m] */
  double hardest;
} grasp;

static sw_vec middle_of(const sw_system *system, const sw_body *b, size_t node) {
  const sw_web *web = b->plan->web;
  const size_t ring = sw_web_ring_of(web, node - b->first_node);
  return sw_web_centre(web, system->x + 3 * b->first_node, ring);
}

/* pad: its pose. */
static void add_touch(const sw_system *system, const sw_body *b, sw_pose pad,
                      const sw_contact_push *p, grasp *g) {
  const sw_vec force = sw_unrotate(pad.q, p->force);
  const double side = copysign(1.0, sw_pose_local(pad, p->point).y);
  const sw_vec arm = sw_sub(p->acts, middle_of(system, b, p->node));
  const sw_vec width = sw_rotate(pad.q, sw_v(1, 0, 0));
  g->along = sw_madd(g->along, width, force.x);
  g->turning = sw_madd(g->turning, width, sw_dot(width, sw_cross(arm, p->force)));
  g->squeeze += side * force.y, g->friction += p->friction * side * force.y;
  if (fabs(force.x) > g->hardest) g->hardest = fabs(force.x), g->place = p->place;
}

static void tell(sw_scene *s, size_t wire, const sw_tool *t, const grasp *g) {
  const char *name = sw_scene_wire_in(s, wire)->name;
  const double r = sw_scene_system(s)->bodies[wire].plan->beam.radius;
  const double along = sw_norm(g->along), turning = sw_norm(g->turning);
  const double counts = COUNTS * g->friction + LEAST * g->squeeze;
  if (along > counts)
    sw_scene_tell(s, "caught", t->name, g->place, along,
                  "the pads of '%s' hold wire '%s', a mesh, with %.3g N along them; friction gives "
                  "%.3g N at most. A slice that is not squeezed stands before a pad's end: this "
                  "force is too large. Take a rod, or less squeeze",
                  t->name, name, along, g->friction);
  if (turning > counts * r)
    sw_scene_tell(s, "caught", t->name, g->place, turning,
                  "the pads of '%s' turn wire '%s', a mesh, with %.3g N m about its axis; friction "
                  "gives %.3g N m at most. Corners of its section resist: this moment is too "
                  "large. Take more particles, or a rod with rolls = true",
                  t->name, name, turning, g->friction * r);
}

static sw_status look_at(sw_scene *s, size_t wire, const sw_tool *t, sw_error *err) {
  const sw_contact *contact = sw_scene_contact(s);
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  grasp g = {.hardest = 0};
  size_t first, end;
  sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &first, &end);
  for (size_t i = 0; i < t->pads; i++) {
    const size_t pad = t->pad[i].obstacle;
    sw_motion_state at;
    sw_contact_push p;
    SW_TRY(sw_drive_eval(s, &sw_scene_obstacle_in(s, pad)->drive, sw_scene_time(s), &at, err));
    for (size_t k = first; k < end; k++)
      if (sw_contact_pusher(contact, k) == (int)pad && sw_contact_push_at(contact, system, k, &p))
        add_touch(system, b, at.pose, &p, &g);
  }
  tell(s, wire, t, &g);
  return SW_OK;
}

sw_status sw_scene_watch_caught(sw_scene *s, size_t wire, sw_error *err) {
  const sw_web *web = sw_scene_system(s)->bodies[wire].plan->web;
  if (!sw_scene_contact(s) || !web || !web->per_ring) return SW_OK;
  SW_EACH(tool, t, s) {
    if (t->alive && t->pads && !t->frozen && t->jaw.status == SW_JAW_HOLDS)
      SW_TRY(look_at(s, wire, t, err));
  }
  return SW_OK;
}
