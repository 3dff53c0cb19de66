/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports joints that pass no twist (of wires with material frames) where one wire in place of the
 * joined ones would resist it: between two holds that keep the wires' directions, which turn about
 * the wires' axes against one another, or where the wires leave a plane. A wire in a plane has no
 * twist. */
#include "link/joint.h"

#include <math.h>

#include "body/build.h"
#include "link/hold.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/observe.h"

/* Least reported angle. Two joined halves in an arch between clamps that leaves a plane differ from
 * one wire in bends, moments and forces: by less than 1 % at 0.1 rad, 1 % at 0.16 rad, 2 to 4 % at
 * 0.27 rad (spec/link/joint_twist_spec) [rad]. */
static const double TOLD = 0.15;
/* Largest turn of a wire from edge to edge below which it counts as straight [rad]. */
static const double STRAIGHT = 1e-3;

/* The wire of an end, between the joint and a hold that keeps its direction. */
typedef struct arm {
  const sw_body *body;
  const sw_hold *hold;
  size_t first, last; /* its nodes, in the wire */
} arm;

/* Finds the hold nearest to the end; 0: there is none, or the wire has no twist. */
static int find_arm(const sw_scene *s, const sw_joint_end *e, arm *out) {
  const sw_scene_wire *w = sw_scene_wire_in(s, e->wire);
  const sw_body *b = &sw_scene_system(s)->bodies[e->wire];
  *out = (arm){.body = b};
  if (w->strand.web || !(w->beam.GJ > 0)) return 0;
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != e->wire || !h->cls->hold->direction) continue;
    const double way = fmin(fabs(h->s1 - e->s), fabs(h->s2 - e->s));
    const sw_hold *o = out->hold;
    if (!o || way < fmin(fabs(o->s1 - e->s), fabs(o->s2 - e->s))) out->hold = h;
  }
  if (!out->hold) return 0;
  const double near = out->hold->s1 > e->s ? out->hold->s1 : out->hold->s2;
  out->first = sw_plan_first(b->plan, fmin(near, e->s));
  out->last = sw_plan_first(b->plan, fmax(near, e->s));
  return out->last < b->plan->nodes;
}

static sw_vec edge_of(const sw_scene *s, const arm *a, size_t e) {
  const double *x = sw_scene_system(s)->x + 3 * (a->body->first_node + e);
  return sw_unit_or(sw_sub(sw_load(x + 3), sw_load(x)), sw_v(1, 0, 0));
}

/* Adds up the turns from edge to edge, all to one side of the largest so far. */
static void add_turns(const sw_scene *s, const arm *a, sw_vec *normal, double *largest) {
  for (size_t e = a->first; e + 1 < a->last; e++) {
    const sw_vec turn = sw_cross(edge_of(s, a, e), edge_of(s, a, e + 1));
    *normal = sw_madd(*normal, turn, sw_dot(*normal, turn) < 0 ? -1.0 : 1.0);
    *largest = fmax(*largest, sw_norm(turn));
  }
}

static double steepest(const sw_scene *s, const arm *a, sw_vec normal) {
  double most = 0;
  for (size_t e = a->first; e < a->last; e++)
    most = fmax(most, fabs(sw_dot(edge_of(s, a, e), normal)));
  return most;
}

/* Returns by how much the wires leave the plane in which they bend most [rad]. */
static double out_of_plane(const sw_scene *s, const arm *a, const arm *b) {
  sw_vec normal = sw_v(0, 0, 0);
  double largest = 0;
  add_turns(s, a, &normal, &largest);
  add_turns(s, b, &normal, &largest);
  if (!(largest > STRAIGHT) || !(sw_norm(normal) > 0)) return 0;
  normal = sw_unit_or(normal, normal);
  return asin(fmin(1.0, fmax(steepest(s, a, normal), steepest(s, b, normal))));
}

/* Returns the hold's turn about the wire's axis since it took the wire [rad]. */
static double turn_of(const sw_scene *s, const sw_hold *h) {
  const sw_quat q = sw_scene_system(s)->hold_states[h->number].pose.q;
  return 2.0 * atan2(sw_dot(sw_v(q.x, q.y, q.z), h->director[0]), q.w);
}

static void watch(sw_scene *s, const sw_joint *j, const sw_joint_end *one,
                  const sw_joint_end *two) {
  arm a, b;
  if (one->stop && two->stop) return; /* it passes twist */
  if (one->wire == two->wire || !find_arm(s, one, &a) || !find_arm(s, two, &b)) return;
  const double plane = out_of_plane(s, &a, &b);
  const double turn = fabs(remainder(turn_of(s, a.hold) - turn_of(s, b.hold), 2 * M_PI));
  if (!(fmax(plane, turn) > TOLD)) return;
  const double degrees = 180.0 / M_PI * fmax(plane, turn);
  sw_scene_tell(s, "joint", j->name, NAN, fmax(plane, turn),
                "'%s' passes no twist from wire '%s' to '%s'; between '%s' and '%s' %s by "
                "%.3g degrees. One wire would twist there: bends, forces and moments may be "
                "off",
                j->name, sw_scene_wire_in(s, one->wire)->name, sw_scene_wire_in(s, two->wire)->name,
                a.hold->name, b.hold->name,
                turn > plane ? "the holds turn" : "the wires leave a plane", degrees);
}

void sw_scene_end_joints(sw_scene *s) {
  sw_error ignored;
  SW_EACH(join, j, s) {
    if (!j->alive || !j->rigid || !isnan(j->slack)) continue;
    /* after a run without a step, or changes since the last one, there may be no system */
    if (sw_scene_build(s, &ignored) != SW_OK) return;
    for (size_t k = 0; k < j->count; k++)
      for (size_t l = k + 1; l < j->count; l++) watch(s, j, &j->ends[k], &j->ends[l]);
  }
}
