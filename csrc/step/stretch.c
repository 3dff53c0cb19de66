/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Soft lines that slide: friction stretches them, waves of stretch run along them for many
 * milliseconds, and at rest friction keeps what is left of these. */
#include "step/stretch.h"

#include <math.h>

#include "body/touching.h"
#include "contact/halt.h"
#include "scene/course.h"
#include "scene/parts.h"

/* Allowed error of a line's stretch in a step, as a share of the stretch by its friction: errors of
 * all steps of a wave add. Of 60 wires of 1 to 30 MPa with the allowed error of places alone, 8
 * kept a friction at rest that was off by 0.1 to 0.58 mu N in steps of 20 ms, and 15 by tolerance;
 * with this share none did, with 2.5 times this share 3 by tolerance (spec/contact/soft_slide_spec)
 * [-].
 */
static const double OF_STRETCH = 0.002;

/* Waves run through stiffer lines faster than any part [s]. */
static const double TRAVEL = 1e-3;

int sw_stretch_is_stiff(const sw_body *b) {
  const sw_plan *p = b->plan;
  return !p->web && p->length * p->length * p->beam.mass < TRAVEL * TRAVEL * b->EA;
}

static double largest_tension(const sw_system *s, const sw_body *b) {
  double most = 0;
  for (size_t e = 0; e < b->plan->edges; e++)
    most = fmax(most, fabs(s->tension[b->first_edge + e]));
  return most;
}

static double friction_of(const sw_scene *s, size_t body) {
  sw_along sum = {0, 0};
  if (sw_scene_contact(s)) sw_contact_along(sw_scene_contact(s), sw_scene_system(s), body, &sum);
  if (sw_scene_pairs(s)) sw_mutual_along(sw_scene_pairs(s), sw_scene_system(s), body, &sum);
  return sum.most;
}

double sw_stretch_over(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  double over = 0;
  for (size_t k = 0; sw_scene_has_contact(s) && k < system->body_count; k++) {
    const sw_body *b = &system->bodies[k];
    if (b->plan->web || sw_stretch_is_stiff(b)) continue;
    const double friction = friction_of(s, k);
    if (!(friction > 0)) continue;
    const size_t first = b->first_node;
    const double off = sw_stepper_error_along(stepper, system, first, first + b->plan->nodes);
    /* where a wire mostly hangs, its weight stretches it */
    const double force = fmax(friction, largest_tension(system, b));
    over = fmax(over, off * b->EA / (OF_STRETCH * force * b->plan->length));
  }
  return over;
}
