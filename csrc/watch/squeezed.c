/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports a rod or string that two obstacles squeeze. Its section does not yield, except to pads,
 * so the force comes from the solver's own stiffness, which depends on the step. */
#include <math.h>

#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/observe.h"

/* A gap that is narrower than the wire by less than this squeezes nothing [m]. */
static const double NOTICED = 1e-6;

/* Returns the force below which no section counts as pressed: the larger of the wire's weight on
 * earth and the force that bends it [N]. */
static double usual_force(const sw_plan *p) {
  return fmax(9.81 * p->beam.mass * p->length, p->beam.EI / (p->length * p->length));
}

static int is_pad(const sw_scene *s, int obstacle) {
  return obstacle < 0 || (size_t)obstacle >= sw_scene_obstacle_slots(s) ||
         sw_scene_obstacle_in(s, obstacle)->drive.tool;
}

/* Returns how much narrower than the wire the gap between two obstacles is; 0 or less: it is not,
 * or the obstacles do not face each other [m]. */
static double narrower(const sw_contact_push *a, const sw_contact_push *b, double radius) {
  if (a->obstacle == b->obstacle || sw_dot(a->normal, b->normal) > SW_FACING) return 0;
  const sw_vec across = sw_sub(a->point, b->point);
  return 2 * radius - fmax(sw_dot(across, b->normal), -sw_dot(across, a->normal));
}

static void tell(sw_scene *s, size_t wire, const sw_contact_push *a, const sw_contact_push *b,
                 double by) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const sw_scene_obstacle *one = sw_scene_obstacle_in(s, a->obstacle),
                          *two = sw_scene_obstacle_in(s, b->obstacle);
  const double place = 0.5 * (a->place + b->place) - w->mesh.s[0];
  sw_scene_tell(
      s, "crash", w->name, place, by,
      "obstacles '%s' and '%s' squeeze wire '%s' by %.3g mm; its section is rigid, so the force "
      "depends on the time step: use a gripper's pads, or a mesh as the wire's model",
      one->name, two->name, w->name, 1e3 * by);
}

void sw_scene_watch_squeezed(sw_scene *s, size_t wire) {
  const sw_contact *contact = sw_scene_contact(s);
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  sw_contact_push one, two, most[2] = {{.place = 0}};
  double by = NOTICED;
  size_t first, end;
  if (!contact || b->plan->web) return;
  const double usual = usual_force(b->plan);
  if (!sw_contact_may_press(contact, wire, usual)) return;
  sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &first, &end);
  if (!(sw_contact_largest_push(contact, first, end) > usual)) return;
  for (size_t i = first; i < end; i++) {
    if (!sw_contact_push_at(contact, system, i, &one) || !(one.normal_force > usual) ||
        is_pad(s, one.obstacle))
      continue;
    for (size_t k = i + 1; k < end; k++) {
      const int pushes = sw_contact_push_at(contact, system, k, &two);
      if (two.node > one.other) break;
      if (!pushes || !(two.normal_force > usual) || is_pad(s, two.obstacle)) continue;
      const double less = narrower(&one, &two, b->plan->beam.radius);
      if (less > by) by = less, most[0] = one, most[1] = two;
    }
  }
  if (by > NOTICED) tell(s, wire, &most[0], &most[1], by);
}
