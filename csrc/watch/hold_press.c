/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports holds that press a wire into an obstacle by less than a crash: they are in it, from the
 * start on or later, or point the wire into it. The section of a rod does not yield, so the wire
 * beside the hold must bend out of the obstacle within its first edge: with the force 3 EI d/h^3
 * for the depth d and the edge h. A tenth of a millimetre gives 0.2 to 20 N, as the edges have it.
 * A direction that tilts by a into the obstacle has d = a h. The held sections of a mesh do not
 * yield either, and those beside them hardly; so 0.1 mm there gives 10 to 100 weights. */
#include <math.h>
#include <stdio.h>

#include "contact/contact.h"
#include "link/hold.h"
#include "scene/drive.h"
#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

/* The wire is pressed by the hold up to this many edges beside it [-]. */
static const double BESIDE = 2.0;
static const size_t ANY = SIZE_MAX; /* of the obstacles */
/* A touch is at most this many nodes away from the node that it is listed at [-]. */
static const size_t BEYOND = 2;
/* Forces on a mesh that are told, over usual ones: it is soft beside the hold [-]. */
static const double ON_MESH = 2.0;
/* Forces on a rod that are told exceed the weight that rests there by this share of usual ones:
 * then the table bears more than 1.15 weights. At a wire of 0.3 m with 10 to 77 edges they do so if
 * the hold is 0.3 to 3 % of the radius deep (spec/scene/hold_press_spec) [-]. */
static const double EXCESS = 0.3;
/* A hold that is less deep touches [m]. */
static const double TOUCHES = 1e-7;

/* Returns the wire's edge, or the distance between a mesh's sections [m]. */
static double edge_of(const sw_plan *p) {
  return p->length / (double)(p->web ? p->web->rings - 1 : p->edges);
}

/* Returns the force of an obstacle on the wire at the hold and beside it [N]. */
static double force_beside(const sw_scene *s, const sw_hold *h, size_t obstacle) {
  const sw_contact *contact = sw_scene_contact(s);
  const sw_system *system = sw_scene_system((sw_scene *)s);
  const sw_body *b = &system->bodies[h->wire];
  const double reach = BESIDE * edge_of(b->plan);
  double force = 0;
  size_t k, end;
  sw_contact_push p;
  size_t from = 0, to = b->plan->nodes;
  if (!b->plan->web) {
    from = sw_plan_first(b->plan, h->s1 - reach), to = sw_plan_first(b->plan, h->s2 + reach);
    from -= from < BEYOND ? from : BEYOND;
    to = to + BEYOND < b->plan->nodes ? to + BEYOND : b->plan->nodes;
  }
  sw_contact_touches_of(contact, b->first_node + from, b->first_node + to, &k, &end);
  for (; k < end; k++)
    if (sw_contact_push_at(contact, system, k, &p) &&
        (obstacle == ANY || p.obstacle == (int)obstacle) && p.place >= h->s1 - reach &&
        p.place <= h->s2 + reach)
      force += p.normal_force;
  return force;
}

static void tell(sw_scene *s, const sw_hold *h, size_t obstacle, double force, const char *how,
                 const char *mend) {
  const sw_plan *plan = sw_scene_system(s)->bodies[h->wire].plan;
  sw_scene_tell(s, "pressed", h->name, 0.5 * (h->s1 + h->s2) - plan->s[0], force,
                "%s '%s' presses wire '%s' %s '%s' with %.3g N. A rod's section is rigid: "
                "its edges decide this force; %s the hold, or take pads or a mesh",
                h->cls->name, h->name, sw_scene_wire_in(s, h->wire)->name, how,
                sw_scene_obstacle_in(s, obstacle)->name, force, mend);
}

static void tell_mesh(sw_scene *s, const sw_hold *h, size_t obstacle, double force, double depth) {
  const sw_plan *plan = sw_scene_system(s)->bodies[h->wire].plan;
  sw_scene_tell(s, "pressed", h->name, 0.5 * (h->s1 + h->s2) - plan->s[0], force,
                "%s '%s' presses wire '%s' %.3g mm into '%s' with %.3g N. Held sections are "
                "rigid: the depth decides this force; lift the hold. Meshes may be wider "
                "than 2 radius: see wire:width",
                h->cls->name, h->name, sw_scene_wire_in(s, h->wire)->name, 1e3 * depth,
                sw_scene_obstacle_in(s, obstacle)->name, force);
}

/* Returns the largest force beside the hold that is not told [N]. */
static double harmless(const sw_system *s, const sw_hold *h) {
  const sw_plan *p = s->bodies[h->wire].plan;
  const double usual = sw_contact_usual_force(s, p), reach = BESIDE * edge_of(p);
  if (p->web) return ON_MESH * usual;
  const double from = fmax(p->s[0], h->s1 - reach), to = fmin(p->s[p->edges], h->s2 + reach);
  return ((to - from) / p->length + EXCESS) * usual;
}

int sw_hold_watch_press(sw_scene *s, const sw_hold *h, size_t obstacle, double depth) {
  const sw_system *system = sw_scene_system(s);
  const sw_plan *plan = system->bodies[h->wire].plan;
  char how[64];
  if (!sw_scene_contact(s) || (plan->web && plan->web->rings < 2)) return 0; /* no wire */
  if (!(depth > TOUCHES)) return 0;
  const double force = force_beside(s, h, obstacle);
  if (!(force > harmless(system, h))) return 0;
  if (plan->web) {
    tell_mesh(s, h, obstacle, force, depth);
    return 1;
  }
  snprintf(how, sizeof how, "%.3g mm into", 1e3 * depth);
  tell(s, h, obstacle, force, how, "lift");
  return 1;
}

/* --- holds that point the wire into an obstacle --------------------------------------------- */

static double depth_of(const sw_shape *shape, sw_vec at, double skin) {
  sw_closest near;
  return sw_shape_point(shape, at, skin, &near) ? skin - near.gap : 0;
}

/* Returns how much deeper than the held place the first free edge would be on one side, if it
 * went straight on; pose: of the hold in the shape's axes. 0 if there is no such edge [m]. */
static double depth_ahead(const sw_hold *h, const sw_plan *p, const sw_shape *shape, sw_pose pose,
                          int leaves) {
  const size_t node = sw_plan_first(p, leaves ? h->s2 : h->s1);
  if (leaves ? node + 1 >= p->nodes : node == 0) return 0;
  const size_t edge = leaves ? node : node - 1;
  if (p->held[leaves ? node + 1 : node - 1] != SW_FREE) return 0;
  const double skin = sw_plan_skin(p, node), way = leaves ? p->rest[edge] : -p->rest[edge];
  const sw_vec from = sw_pose_point(pose, sw_vec_at(h->local, leaves ? h->count - 1 : 0));
  const sw_vec to = sw_madd(from, sw_rotate(pose.q, h->director[leaves]), way);
  double depth = depth_of(shape, to, skin);
  sw_closest near[SW_CLOSEST_MAX];
  const int n = sw_shape_segment(shape, from, to, skin, near);
  for (int k = 0; k < n; k++) depth = fmax(depth, skin - near[k].gap);
  return depth - depth_of(shape, from, skin);
}

sw_status sw_hold_watch_tilt(sw_scene *s, const sw_hold *h, double noticed, sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  const sw_plan *plan = system->bodies[h->wire].plan;
  if (!sw_scene_contact(s) || plan->web || !h->cls->hold->direction) return SW_OK;
  const double usual = sw_contact_usual_force(system, plan);
  if (!(force_beside(s, h, ANY) > usual)) return SW_OK;
  sw_motion_state at, there;
  SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &at, err));
  for (size_t i = 0; i < sw_scene_obstacle_slots(s); i++) {
    const sw_scene_obstacle *o = sw_scene_obstacle_in(s, i);
    if (!o->alive || o->off || (o->drive.tool && o->drive.tool == h->drive.tool)) continue;
    const double force = force_beside(s, h, i);
    if (!(force > usual)) continue;
    SW_TRY(sw_drive_eval(s, &o->drive, sw_scene_time(s), &there, err));
    const sw_pose pose = sw_pose_from(there.pose, at.pose);
    const double depth =
        fmax(depth_ahead(h, plan, o->shape, pose, 0), depth_ahead(h, plan, o->shape, pose, 1));
    char how[80];
    if (!(depth > noticed)) continue;
    snprintf(how, sizeof how, "by its direction, %.3g mm within an edge, into", 1e3 * depth);
    tell(s, h, i, force, how, "turn or lift");
  }
  return SW_OK;
}
