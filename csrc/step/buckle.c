/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divides steps in which a pushed wire buckles. The bend of a wire that is pushed along its length
 * grows like exp(r t), with 1/r of about a millisecond for a cable. In a step of several 1/r an
 * implicit method lets it grow too fast or not at all, so the step decides the push that the wire
 * bears. */
#include "step/buckle.h"

#include <math.h>

#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/pushed.h"
#include "system/system.h"

/* Largest growth of a bend in a part, as its logarithm. Of 60 straight cables on a table, pushed by
 * a gripper in steps of 10 ms, 33 had a peak force that was off by more than 5 % without parts,
 * none has with this value or with half or twice of it; with four times of it 8 have
 * (spec/physics/pushed_straight_spec) [-]. */
static const double MOST = 0.5;
/* The event "coarse" comes above this growth in a part that was taken [-]. */
static const double TOLD = 4.0;
/* Shortest part; rounding of parts [s], [-]. */
static const double SHORTEST = 1e-4, ROUNDING = 1e-6;
/* After this much growth, as its logarithm, even a bend from rounding is as large as the wire. A
 * push that goes on is borne: by walls on both sides, or by perfect symmetry [-]. */
static const double ENOUGH = 40.0;
/* Time after a push in which this growth is forgotten [s]. */
static const double FORGOTTEN = 0.1;

/* x: places of all nodes [m]. Returns the growth rate [1/s]. */
static double rate_of(const sw_scene *s, size_t w, const double *x) {
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  sw_pushed most;
  if (b->waits || !(b->plan->beam.EI > 0)) return 0;
  return sw_pushed_rate(system, b, x, sw_norm(sw_scene_gravity(s)), &most);
}

/* The steps of explicit methods are shorter than any growth. */
double sw_buckle_of(const sw_scene *s, double h) {
  const double *x = sw_scene_course(s)->stepper.trial_x;
  double most = 0;
  if (!(sw_scene_course(s)->method->flags & SW_INTEGRATOR_IMPLICIT)) return 0;
  for (size_t w = 0; w < sw_scene_system(s)->body_count; w++)
    if (sw_scene_wire_in(s, w)->grown < ENOUGH) most = fmax(most, rate_of(s, w, x) * h / MOST);
  return most;
}

/* A part that is cut by rounding only would be tried for ever. */
double sw_buckle_part(double h, double over) {
  if (!(over > 1.0) || h <= SHORTEST * (1.0 + ROUNDING)) return h;
  return fmin(h, fmax(SHORTEST, h * exp2(-ceil(log2(over)))));
}

/* Tells of a part that is too long, because parts are not shorter or steps are not divided. */
static void tell(sw_scene *s, size_t w, double h, double rate) {
  const char *name = sw_scene_wire_in(s, w)->name;
  sw_scene_tell(s, "coarse", name, NAN, rate * h,
                "wire '%s' is pushed and buckles: its bend grows %.3g times in a step or part of "
                "%.3g ms: the push may be wrong; run again with dt = %.2g s and compare",
                name, exp(fmin(rate * h, 99.0)), 1e3 * h, MOST / rate);
}

void sw_buckle_taken(sw_scene *s, double h) {
  if (!(sw_scene_course(s)->method->flags & SW_INTEGRATOR_IMPLICIT)) return;
  for (size_t w = 0; w < sw_scene_system(s)->body_count; w++) {
    sw_scene_wire *wire = sw_scene_wire_in(s, w);
    const double rate = rate_of(s, w, sw_scene_system(s)->x), before = wire->grown;
    wire->grown = rate > 0 ? before + rate * h : fmax(0.0, before - ENOUGH * h / FORGOTTEN);
    if (rate * h > TOLD && before < ENOUGH) tell(s, w, h, rate);
  }
}
