/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the force of a rigid grip with that of the pads that it stands for.
 *
 * Edges of a rod and of a mesh are chords of other lengths, by parts of a micrometre. A wire that
 * another hold keeps from moving along itself answers with newtons: a cable between two clamps
 * pulled at a frozen grip with 0.99 N where it had pulled at the pads with 0.03 N
 * (spec/physics/mixed_between_spec). So the grip is shifted along the wire until the force is the
 * same. */
#include <math.h>

#include "remodel/exchange.h"
#include "remodel/remodel.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"

/* The force along the wire is matched to this share of the force, or of the wire's weight [-]. */
static const double MATCHED = 1e-4;
/* Longest shift, over the wire's radius: twice the largest of 60 random cables between holds [-].
 */
static const double FARTHEST = 0.02;
enum { MOST_SHIFTS = 6 };

/* Changes of the tool's force and moment above which they are told: of the force before, or of the
 * wire's weight (without gravity of EI/L^2, which bends it); of the moment before, or of that force
 * at a radius [-]. Rod and mesh differ by less than that (mixed.md). */
static const double FORCE_STAYS = 0.02, MOMENT_STAYS = 0.05;

/* Returns the force that counts for a wire [N]. */
static double least_force(sw_scene *s, size_t wire, sw_vec force) {
  const sw_plan *p = sw_scene_system(s)->bodies[wire].plan;
  const double g = sw_norm(sw_scene_gravity(s));
  const double load = g > 0 ? g * p->beam.mass * p->length : p->beam.EI / (p->length * p->length);
  return fmax(sw_norm(force), load);
}

static void load_of(sw_scene *s, sw_handle hold, sw_vec about, sw_vec *force, sw_vec *moment) {
  const sw_hold *h = sw_scene_hold_in(s, hold.slot);
  sw_system_reaction(sw_scene_system(s), (int)h->number, about, force, moment);
}

/* Shifts the grip along the wire and balances the wire again. *off: how much the force along it is
 * above the wanted one [N]. */
static sw_status shift(sw_scene *s, const sw_match *m, sw_vec from, double by, double *off) {
  sw_hold *h = sw_scene_hold_in(s, m->hold.slot);
  sw_vec force, moment;
  h->drive.pose.p = sw_madd(from, m->along, by);
  SW_TRY(sw_frozen_balance(s, m->wire, m->rings, m->count, m->balance));
  load_of(s, m->hold, m->about, &force, &moment);
  *off = sw_dot(sw_unrotate(m->q, sw_sub(force, m->was->force)), m->along);
  return SW_OK;
}

/* A wire that answers a shift with less than this share of its own stiffness is free to move along
 * itself [-]. */
static const double FREE = 1e-3;

/* Searches for the shift. *off: as of shift(), of the last one; 0 of a wire that is free to move
 * along itself. */
static sw_status search(sw_scene *s, const sw_match *m, double *off) {
  const sw_body *b = &sw_scene_system(s)->bodies[m->wire];
  const sw_vec from = sw_scene_hold_in(s, m->hold.slot)->drive.pose.p;
  const double most = FARTHEST * b->plan->beam.radius;
  const double good = MATCHED * least_force(s, m->wire, m->was->force);
  SW_TRY(shift(s, m, from, 0, off));
  const double first = *off;
  /* the first guess is that of a wire held at both its ends */
  const double least = FREE * b->plan->beam.EA / b->plan->length;
  double last = 0, slope = HUGE_VAL, by = -first * b->plan->length / (4.0 * b->plan->beam.EA);
  for (int k = 0; k < MOST_SHIFTS && fabs(*off) > good; k++) {
    double now;
    if (!(fabs(by) < most)) break;
    SW_TRY(shift(s, m, from, by, &now));
    slope = (now - *off) / (by - last);
    *off = now;
    if (!(slope > least)) break;
    last = by, by = by - now / slope;
  }
  if (fabs(first) <= good || fabs(*off) < 0.5 * fabs(first)) return SW_OK;
  SW_TRY(shift(s, m, from, 0, off));
  if (!(slope > least)) *off = 0;
  return SW_OK;
}

sw_status sw_frozen_match(sw_scene *s, const sw_match *m) {
  double off;
  SW_TRY(search(s, m, &off));
  /* Only along the wire: across it, what the pads push on a table ends with the freeze. */
  const sw_vec now = sw_madd(m->was->force, sw_rotate(m->q, m->along), off);
  sw_frozen_tell_jump(s, m->wire, m->was, now, m->was->moment, "a rigid grip");
  return SW_OK;
}

void sw_frozen_tell_jump(sw_scene *s, size_t wire, const sw_freeze_report *was, sw_vec force,
                         sw_vec moment, const char *to) {
  const double radius = sw_scene_system(s)->bodies[wire].plan->beam.radius;
  const double borne = least_force(s, wire, was->force);
  const double turning = fmax(sw_norm(was->moment), borne * radius);
  const double off = sw_dist(force, was->force), turned = sw_dist(moment, was->moment);
  if (off <= FORCE_STAYS * borne && turned <= MOMENT_STAYS * turning) return;
  sw_course_jump(sw_scene_course(s));
  const char *name = sw_scene_wire_in(s, wire)->name;
  sw_scene_tell(s, "unbalanced", name, NAN, off,
                "the change to %s on wire '%s' alters the force of its gripper by %.3g N (of %.3g "
                "N) and the moment by %.3g N m (of %.3g N m): forces just after it may be wrong",
                to, name, off, sw_norm(was->force), turned, sw_norm(was->moment));
}
