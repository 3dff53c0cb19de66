/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports pads that press a rod into an obstacle, such as the table on which they lay it. Pads,
 * obstacle and the rod's section do not yield, so micrometres of the gripper's height, or of the
 * wire's slide at the pads' edges, decide the force. Also reports pads that in poses squeeze a mesh
 * of springs on an obstacle: the touches there are only as stiff as its weight needs. */
#include <math.h>

#include "contact/contact.h"
#include "scene/events.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/axial.h"
#include "system/system.h"
#include "watch/observe.h"

/* The wire is pressed by the pads up to this many edges beside them [-]. */
static const double BESIDE = 2.0;
/* A taut wire that is drawn over an edge by up to 90 degrees presses it with 1.4 times its tension
 * at most: then the bend makes the force, not the pads [-]. */
static const double OF_TENSION = 2.0;

/* A force that counts, over the wire's weight, in addition to the weight of the part of the wire
 * that lies there [-]. */
static const double COUNTS = 0.25;

/* Returns the force on the part of a wire that counts as pressed; without gravity that of bending
 * [N]. */
static double usual_force(const sw_system *s, const sw_plan *p, double part) {
  const double weight = p->beam.mass * p->length * sw_norm(sw_load(s->gravity));
  if (!(weight > 0)) return p->beam.EI / (p->length * p->length);
  return weight * (COUNTS + fmin(1.0, part / p->length));
}

static int holds(const sw_tool *t) {
  return t->alive && t->pads && !t->frozen &&
         (t->jaw.status == SW_JAW_HOLDS || t->jaw.status == SW_JAW_STOPPED);
}

/* Touches of one wire. */
typedef struct touches {
  const sw_contact *contact;
  const sw_system *system;
  size_t first, end;
} touches;

/* Finds the part of the wire that the tool's pads press, and BESIDE it; 0: none [m]. */
static int between(const touches *of, const sw_tool *t, double edge, double *from, double *to) {
  sw_contact_push p;
  *from = HUGE_VAL, *to = -HUGE_VAL;
  for (size_t k = of->first; k < of->end; k++) {
    if (!sw_tool_is_pad(t, sw_contact_pusher(of->contact, k)) ||
        !sw_contact_push_at(of->contact, of->system, k, &p))
      continue;
    *from = fmin(*from, p.place), *to = fmax(*to, p.place);
  }
  *from -= BESIDE * edge, *to += BESIDE * edge;
  return *to > *from;
}

static double largest_tension(const sw_system *s, const sw_body *b, double from, double to) {
  const double *T = sw_system_pull(s, b), *at = b->plan->s;
  double most = 0;
  for (size_t e = 0; e < b->plan->edges; e++)
    if (at[e + 1] >= from && at[e] <= to) most = fmax(most, T[e]);
  return most;
}

/* Returns the force of obstacles there that are no pads, and the one that pushes hardest [N]. */
static double force_there(const sw_scene *s, const touches *of, double from, double to,
                          sw_contact_push *hardest) {
  sw_contact_push p;
  double sum = 0;
  hardest->normal_force = 0;
  for (size_t k = of->first; k < of->end; k++) {
    const int obstacle = sw_contact_pusher(of->contact, k);
    if (obstacle < 0 || (size_t)obstacle >= sw_scene_obstacle_slots(s) ||
        sw_scene_obstacle_in(s, obstacle)->drive.tool ||
        !sw_contact_push_at(of->contact, of->system, k, &p) || p.place < from || p.place > to)
      continue;
    sum += p.normal_force;
    if (p.normal_force > hardest->normal_force) *hardest = p;
  }
  return sum;
}

void sw_scene_watch_pads_press(sw_scene *s, size_t wire) {
  const sw_contact *contact = sw_scene_contact(s);
  const sw_body *b = &sw_scene_system(s)->bodies[wire];
  touches of = {.contact = contact, .system = sw_scene_system(s)};
  sw_contact_push most = {.normal_force = 0};
  double from, to;
  if (!contact || b->plan->web) return;
  SW_EACH(tool, t, s) {
    if (!holds(t)) continue;
    sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &of.first,
                          &of.end);
    if (!between(&of, t, b->plan->length / (double)b->plan->edges, &from, &to)) continue;
    const double force = force_there(s, &of, from, to, &most);
    if (!(force > usual_force(of.system, b->plan, to - from)) ||
        !(force > OF_TENSION * largest_tension(of.system, b, from, to)))
      continue;
    sw_scene_tell(s, "pressed", t->name, most.place - b->plan->s[0], force,
                  "the pads of '%s' press wire '%s' into '%s' with %.3g N. All three are "
                  "rigid: micrometres decide this force. End the move a little higher, or "
                  "use gripper:press",
                  t->name, sw_scene_wire_in(s, wire)->name,
                  sw_scene_obstacle_in(s, most.obstacle)->name, force);
  }
}

void sw_scene_watch_sinking(sw_scene *s, size_t wire) {
  const sw_contact *contact = sw_scene_contact(s);
  const sw_body *b = &sw_scene_system(s)->bodies[wire];
  const sw_web *web = b->plan->web;
  touches of = {.contact = contact, .system = sw_scene_system(s)};
  sw_contact_push most = {.normal_force = 0};
  double from, to;
  if (!contact || !web || !web->per_ring || web->solid_rate2 > 0) return;
  SW_EACH(tool, t, s) {
    if (!holds(t)) continue;
    sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &of.first,
                          &of.end);
    if (!between(&of, t, b->plan->length / (double)(web->rings - 1), &from, &to)) continue;
    const double force = force_there(s, &of, from, to, &most);
    if (!(force > 0)) continue;
    sw_scene_tell(s, "pressed", t->name, most.place, force,
                  "the pads of '%s' squeeze wire '%s', a mesh of springs, on '%s' (%.3g N). "
                  "In poses its touches there are too soft: forces may be wrong by a factor "
                  "of 20. Take solid elements, or a run of motion",
                  t->name, sw_scene_wire_in(s, wire)->name,
                  sw_scene_obstacle_in(s, most.obstacle)->name, force);
  }
}
