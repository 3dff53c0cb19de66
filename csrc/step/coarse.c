/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/coarse.h"

#include <math.h>

#include "contact/mutual.h"
#include "scene/course.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "system/system.h"

/* Allowed in a step: so much of a wire's length and of its radius, whichever is less [-]. A metre
 * of cable of 2 mm that is laid at 0.25 m/s in steps of 10 ms is beyond that in 3 of 100; one that
 * whips, falls on a peg or is struck, in most of those that make its largest tension. */
static const double OF_LENGTH = 1e-4, OF_RADIUS = 0.1;
/* Of the length of a wire that is all but straight between two holds, and not yet stretched by
 * them: its tension comes from how little it sags. Of 201 runs of cables that fall into two holds,
 * are let in and drawn taut, 26 largest tensions are more than 10 % off without this, 3 with it, 9
 * at twice of it; at half of it 3, in 1.3 times the steps [-]. */
static const double OF_STRAIGHT = 1e-5;
/* Distance of the holds over the wire between them. From 0.99 on 9 of those are off, from 0.95 on 3
 * in 2 % more steps; all that is stretched takes up to four times the steps for nothing
 * (spec/physics/drawn_spec) [-]. */
static const double NEARLY = 0.97, STRETCHED = 1.0001;
/* No part is a smaller share of a step, nor shorter [-], [s]. */
static const double SMALLEST = 1.0 / 64, SHORTEST = 1e-4;

/* Of more wires one is too fast all the time, and all would take the parts of each [-]. */
enum { MOST_WIRES = 32 };

/* Jaws that close obey a force by steps of their own. */
int sw_coarse_applies(const sw_scene *s) {
  SW_EACH(tool, t, s)
    if (t->alive && t->pads && !t->frozen) return 0;
  return sw_scene_wire_slots(s) <= MOST_WIRES;
}

/* Wires that touch each other, or nearly do, converge worse in shorter parts, and cost more than
 * all else. */
static int touch_each_other(const sw_scene *s) {
  const sw_mutual *pairs = sw_scene_pairs(s);
  size_t near = 0;
  if (pairs) sw_mutual_seen(pairs, &near);
  return near > 0;
}

/* Sections of meshes swing far faster than any step, which is to damp that: their axis counts. */
static double error_of(const sw_stepper *stepper, const sw_system *system, const sw_body *b) {
  const sw_web *web = b->plan->web;
  const size_t first = b->first_node;
  double most = 0;
  if (!web) return sw_stepper_error(stepper, system, first, first + b->plan->nodes);
  for (size_t r = 0; web->per_ring && r < web->rings; r++)
    most = fmax(most, sw_stepper_error_of_mean(stepper, system, first + web->first[r],
                                               first + web->first[r + 1]));
  return most;
}

/* Of a line at x: is it all but straight between two of its holds, and not stretched? */
static int is_straight(const sw_plan *p, const double *x) {
  for (size_t i = 0, from = p->nodes; i < p->nodes; i++) {
    if (p->held[i] == SW_FREE) continue;
    const double along = i > from + 2 ? p->s[i] - p->s[from] : 0.0;
    const double apart = along > 0 ? sw_dist(sw_vec_at(x, i), sw_vec_at(x, from)) : 0.0;
    if (apart > NEARLY * along && apart < STRETCHED * along) return 1;
    from = i;
  }
  return 0;
}

static double allowed_of(const sw_body *b, const double *x) {
  const sw_plan *p = b->plan;
  const int straight = !p->web && is_straight(p, x + 3 * b->first_node);
  return fmin((straight ? OF_STRAIGHT : OF_LENGTH) * p->length, OF_RADIUS * p->beam.radius);
}

double sw_coarse_of(const sw_scene *s, double tolerance) {
  const sw_system *system = sw_scene_system(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  double over = 0;
  if (touch_each_other(s)) return 0;
  SW_ITEMS(const sw_body, b, system->bodies, system->body_count) {
    const double allowed = fmin(tolerance, allowed_of(b, stepper->trial_x));
    over = fmax(over, error_of(stepper, system, b) / allowed);
  }
  return over;
}

/* The estimate goes with this power of the step [-]. */
static double power_of(const sw_scene *s) {
  return 1.0 + sw_stepper_order(&sw_scene_course(s)->stepper);
}

double sw_coarse_shortest(double dt) { return fmax(SMALLEST * dt, SHORTEST); }

/* What would take more parts than that is a shock, such as a tie that is made far too short. */
double sw_coarse_part(const sw_scene *s, double h, double dt, double over) {
  const double part = h * exp2(-ceil(log2(fmax(over, 1.0)) / power_of(s)));
  if (!(over > 1.0) || h < 2.0 * SHORTEST || part < SMALLEST * dt) return h;
  return fmax(SHORTEST, part);
}

double sw_coarse_half(double h, double dt) {
  const double part = 0.5 * h;
  return part >= sw_coarse_shortest(dt) ? part : h;
}

/* Half a part of smooth motion has an eighth of its error, one with a jump in it more than all. */
int sw_coarse_helps(double before, double over) { return over <= fmax(1.0, before); }

int sw_coarse_may_grow(const sw_scene *s, double over) { return over * exp2(power_of(s)) <= 1.0; }
