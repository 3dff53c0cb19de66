/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/coarse.h"

#include <math.h>

#include "scene/course.h"
#include "scene/parts.h"
#include "system/system.h"

/* Allowed in a step: so much of a wire's length and of its radius, whichever is less [-]. A metre of
 * cable of 2 mm, laid at 0.25 m/s in steps of 10 ms, is beyond that in 3 of 100 steps; a cable that
 * whips, falls on a peg or is struck, in most of those that make its largest tension. Half of it
 * costs 10 % more steps in a laying. */
static const double OF_LENGTH = 1e-4, OF_RADIUS = 0.1;
/* What a step of this share does not resolve is no smooth motion [-]. */
static const double SMALLEST = 1.0 / 64;
/* The estimate goes with this power of the step [-]. */
static const double POWER = 3.0;

double sw_coarse_of(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  double over = 0;
  SW_ITEMS(const sw_body, b, system->bodies, system->body_count) {
    const sw_plan *p = b->plan;
    const double allowed = fmin(OF_LENGTH * p->length, OF_RADIUS * p->beam.radius);
    const double error =
        sw_stepper_error(stepper, system, b->first_node, b->first_node + p->nodes);
    over = fmax(over, error / allowed);
  }
  return over;
}

double sw_coarse_part(double h, double whole, double over) {
  if (!(over > 1.0)) return h;
  return fmin(h, fmax(SMALLEST * whole, h * exp2(-ceil(log2(over) / POWER))));
}

int sw_coarse_may_grow(double over) { return over * exp2(POWER) <= 1.0; }
