/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps by `tolerance`: the size of a step follows its error. */
#include <math.h>

#include "base/each.h"
#include "grip/jaws.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "step/blow.h"
#include "step/buckle.h"
#include "step/coarse.h"
#include "step/outer.h"
#include "step/restart.h"
#include "system/system.h"

/* 1 if a step this short is accepted with any error because the method starts anew. A strike is a
 * jump, which no step is short enough to resolve. */
static int is_short_enough(const sw_ladder *p, double h) {
  return sw_scene_course(p->s)->stepper.restart && h <= SW_SMALLEST_SHARE * p->args->dt;
}

/* Returns the error of the last trial over the allowed error [-]. The method's own estimate is
 * compared with the tolerance. Implicit Euler, which computes strikes, has no estimate. Steps long
 * enough to be divided are also judged like steps of fixed size. This covers implicit Euler, and it
 * applies the allowed error of wires where this is below the tolerance. */
static double over_of(const sw_ladder *p, double h) {
  const sw_scene *s = p->s;
  const sw_system *system = sw_scene_system(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  double over = 0;
  if (sw_stepper_estimates(stepper))
    over = sw_stepper_error(stepper, system, 0, system->nodes) / p->args->tolerance;
  const int judged = p->args->parts && h >= 2.0 * sw_coarse_shortest(p->args->dt);
  return judged && sw_coarse_applies(s) ? fmax(over, sw_coarse_of(s, p->args->tolerance)) : over;
}

/* A velocity that a step misses lasts: its way in so many of the longest steps counts [-]. */
static const double LASTS = 4.0;

/* Returns the error by what the trial misses of force functions, over the tolerance [-]. A jump has
 * this error in steps of any size, in proportion; parts shorter than those of coarse motion are not
 * asked for. */
static double over_of_outer(const sw_ladder *p, double h, const sw_outer_look *look) {
  if (h < 2.0 * sw_coarse_shortest(p->args->dt)) return 0;
  return LASTS * look->speed * p->args->dt / p->args->tolerance;
}

/* Returns the size of the step after one of h [s]. After an accurate step by implicit Euler the
 * next one is not shorter; it is longer if velocities changed little. */
static double next_of(const sw_ladder *p, double h, double over) {
  const sw_scene *s = p->s;
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  if (sw_stepper_estimates(stepper) || over > 1) return sw_stepper_next_h(stepper, h, over, 1);
  const double drift = sw_stepper_drift(stepper, sw_scene_system(s));
  return fmax(h, sw_stepper_next_h(stepper, h, drift, p->args->tolerance));
}

/* Lower bound of the step size with which contact compares a step (`asked`) [s]. In a step much
 * shorter than `asked`, contact leaves the depth of a strike and reduces it slowly. `asked` follows
 * the steps taken; otherwise pressed wires would sink in steadily (spec/physics/struck_spec). Below
 * this bound striking wires would be thrown back. Of four cables drawn taut over a peg, one fails
 * with this bound, two with half of it and two with twice of it. */
static const double SHORTEST_ASKED = 1e-4;

/* A step shorter than this share of the time in which an axial wave passes an edge moves nothing:
 * energy that it makes is a jump of forces, which no smaller step avoids [-]. */
static const double OF_WAVE = 1.0 / 64;

/* Returns the size below which a step that makes energy is not repeated with a smaller one: a share
 * of the shortest time of an axial wave in an edge of a line, but at least rounding of dt [s]. */
static double smallest_judged(const sw_ladder *p) {
  const sw_system *system = sw_scene_system(p->s);
  double wave = HUGE_VAL;
  SW_ITEMS(const sw_body, b, system->bodies, system->body_count) {
    const double rate2 = b->plan->beam.mass / b->EA;
    for (size_t e = 0; !b->plan->web && rate2 > 0 && e < b->plan->edges; e++)
      wave = fmin(wave, b->plan->rest[e] * sqrt(rate2));
  }
  const double least = SW_SMALLEST_SHARE * SW_SMALLEST_SHARE * p->args->dt;
  return isfinite(wave) ? fmax(least, fmin(OF_WAVE * wave, SW_SMALLEST_SHARE * p->args->dt))
                        : least;
}

/* Takes an adaptive step of at most `left`; refuses steps whose error is too large. */
sw_status sw_step_adaptive(sw_ladder *p, double left, double t1, sw_error *err) {
  sw_scene *s = p->s;
  sw_course *course = sw_scene_course(s);
  const double most = fmin(p->args->dt, left);
  double h = course->next_dt > 0 ? fmin(course->next_dt, most) : 0.1 * most;
  if (p->args->parts) SW_TRY(sw_restart_after_stop(s, most, err));
  h = fmin(fmin(sw_blow_part(s, h), sw_restart_part(s)), sw_outer_longest(s));
  if (p->args->parts) SW_TRY(sw_restart_before_stop(p, &h, err));
  SW_TRY(sw_restart_until_break(s, &h, err));
  SW_TRY(sw_ladder_make_room(p, &h, err));
  SW_TRY(sw_restart_at_jerk(s, h, err));
  p->changed = sw_restart_changed(s);
  const double judged = smallest_judged(p);
  p->asked = fmax(SHORTEST_ASKED, fmax(h, 0.5 * p->asked));
  for (double uncut = 0;;) { /* uncut: size of the step that was cut at a rebound [s] */
    const int last = h >= left * (1 - 1e-9);
    const sw_status status = sw_ladder_try(p, h, 0.25 * h < judged, err);
    if (sw_ladder_hopeless(status)) return status;
    sw_outer_look outer = {.speed = 0};
    if (status == SW_OK) SW_TRY(sw_outer_look_at(p, h, &outer, err));
    const double over = status == SW_OK ? fmax(over_of(p, h), over_of_outer(p, h, &outer)) : 0.0;
    const int fine = status == SW_OK && (over <= 1 || is_short_enough(p, h));
    double next = status == SW_OK ? next_of(p, h, over) : 0.25 * h;
    if (fine && sw_blow_begins(s, h)) {
      sw_ladder_undo(p);
      h = sw_blow_part(s, h);
      continue;
    }
    const double snaps = fine ? sw_blow_snap(s, h) : h;
    if (snaps < h) {
      sw_ladder_undo(p);
      h = snaps;
      continue;
    }
    const int follows = fine && p->args->parts && sw_coarse_applies(s);
    const double grows = follows ? sw_buckle_of(s, h) : 0.0, shorter = sw_buckle_part(h, grows);
    if (fine && shorter < h) {
      sw_ladder_undo(p);
      h = shorter;
      continue;
    }
    if (grows > 0) next = fmin(next, fmax(h, h / grows));
    if (fine) SW_TRY(sw_grips_overloaded(s, sw_scene_time(s), sw_scene_time(s) + h, &p->lost, err));
    if (p->lost) {
      sw_ladder_undo(p);
      return SW_OK;
    }
    if (fine) {
      const double before = sw_scene_time(s);
      sw_outer_taken(s, h, &outer);
      sw_ladder_accept(p, h, last ? t1 : before + h);
      sw_buckle_taken(s, h);
      if (!(sw_scene_time(s) > before))
        return sw_fail(err, SW_ENOCONV, "a step of %g s is too short to advance the time", h);
      course->next_dt = uncut > 0 ? uncut : last && next > h ? fmax(next, course->next_dt) : next;
      return sw_ladder_record(p, h, err);
    }
    if (status == SW_OK) sw_ladder_undo(p);
    if (status != SW_OK) p->held = *err;
    if (status != SW_OK && p->soonest > 0) uncut = h, next = p->soonest;
    p->report->rejected++;
    h = fmin(next, 0.9 * h);
    if (h < SW_SMALLEST_SHARE * SW_SMALLEST_SHARE * p->args->dt)
      return status != SW_OK ? status
                             : sw_fail(err, SW_ENOCONV, "the tolerance needs steps below %g s", h);
  }
}
