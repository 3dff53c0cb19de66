/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divides steps of fixed size that are too coarse for the motion of a wire (coarse.h). */
#include "step/coarse.h"

#include <math.h>
#include <stdio.h>

#include "contact/halt.h"
#include "mutual/mutual.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "system/system.h"

/* Allowed error in a step: this share of a wire's length or of its radius, whichever is smaller
 * [-]. It is exceeded in 3 of 100 steps by 1 m of 2 mm cable laid at 0.25 m/s in steps of 10 ms,
 * and in most steps near the largest tension of a cable that whips, falls on a peg or is struck. */
static const double OF_LENGTH = 1e-4, OF_RADIUS = 0.1;
/* The tension of a wire drawn almost straight between two holds depends on its small sag. Its
 * allowed error is OF_STRAIGHT of its length, plus PER_SLACK per slack (length over distance of the
 * holds, minus 1) [-]. Measured on 369 runs of cables that fall into two holds, are let in and are
 * drawn taut: without this limit 41 largest tensions are off by more than 10 %; with it 5, with 2.2
 * times the steps. Twice OF_STRAIGHT: 14. Half of it: 5, with 3 times the steps. Half of PER_SLACK:
 * 8 (spec/physics/drawn_spec). */
static const double OF_STRAIGHT = 1.1e-5, PER_SLACK = 1e-3;
/* Above this strain the tension depends on the strain, not on the sag. The limit would give four
 * times the steps and no better tension [-]. */
static const double STRETCHED = 1e-4;
/* Smallest part (substep), as a share of its step and in time; rounding of parts [-], [s], [-]. */
static const double SMALLEST = 1.0 / 64, SHORTEST = 1e-4, ROUNDING = 1e-9;

/* A wire moves if a node is faster than this [m/s]. */
static const double MOVES = 1e-3;

static int moves(const sw_system *system, const sw_body *b) {
  const double *v = system->v + 3 * b->first_node;
  for (size_t i = 0; i < b->plan->nodes; i++)
    if (sw_norm2(sw_vec_at(v, i)) > MOVES * MOVES) return 1;
  return 0;
}

int sw_coarse_is_crowd(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  size_t moving = 0;
  for (size_t b = 0; system->body_count > SW_MOST_MOVING && b < system->body_count; b++) {
    moving += moves(system, &system->bodies[b]);
    if (moving > SW_MOST_MOVING) return 1;
  }
  return 0;
}

static int any_mesh(const sw_system *system) {
  SW_ITEMS(const sw_body, b, system->bodies, system->body_count)
    if (b->plan->web) return 1;
  return 0;
}

static int any_jaw_works(const sw_scene *s) {
  SW_EACH(tool, t, s)
    if (t->alive && t->pads && !t->frozen && t->jaw.status != SW_JAW_RESTS) return 1;
  return 0;
}

/* Steps of meshes between jaws that close, hold or open are not divided, because the section shakes
 * the axis. Too long steps are reported. Whole steps give the same squeeze and work of friction in
 * a fifth to a half of the time (bench case=grip, spec/check/worn_mesh_spec). */
int sw_coarse_has_mesh_in_jaws(const sw_scene *s) {
  return any_jaw_works(s) && any_mesh(sw_scene_system(s));
}

int sw_coarse_applies(const sw_scene *s) {
  return !sw_coarse_has_mesh_in_jaws(s) && !sw_coarse_is_crowd(s);
}

int sw_coarse_is_bundle(const sw_scene *s) {
  const sw_mutual *pairs = sw_scene_pairs(s);
  return pairs && sw_mutual_crowded(pairs, SW_MOST_NEAR);
}

/* Returns the error of a body [m]. Only the axis of a mesh counts: its sections swing far faster
 * than any step, and steps are meant to damp that. */
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

/* Returns the smallest slack of a line at x between two neighbouring holds; 1: there are no two
 * holds, or the line is stretched [-]. */
static double slack_of(const sw_plan *p, const double *x) {
  double least = 1;
  for (size_t i = 0, from = p->nodes; i < p->nodes; i++) {
    if (p->held[i] == SW_FREE) continue;
    if (i > from + 2) {
      const double apart = sw_dist(sw_vec_at(x, i), sw_vec_at(x, from));
      const double slack = 1.0 - apart / (p->s[i] - p->s[from]);
      if (slack > -STRETCHED) least = fmin(least, fmax(0.0, slack));
    }
    from = i;
  }
  return least;
}

static double allowed_of(const sw_body *b, const double *x) {
  const sw_plan *p = b->plan;
  const int drawn = !p->web && p->beam.EI > 0; /* strings that hardly stretch fail in short parts */
  const double slack = drawn ? slack_of(p, x + 3 * b->first_node) : 1.0;
  const double share = fmin(OF_LENGTH, OF_STRAIGHT + PER_SLACK * slack);
  return fmin(share * p->length, OF_RADIUS * p->beam.radius);
}

/* Where an obstacle that moves turns round, friction strikes a held line along its whole length,
 * and waves run along it. In a soft line they last longer than a step, and the hold's force depends
 * on them, but they move it less than the limits above: mu m g stretches 0.3 m of rubber (10 MPa)
 * by 16 um, and OF_LENGTH is 30 um. So its allowed error along the edges is this share of that
 * stretch, mu m g L / (2 EA). Peaks of holds are then within 7 % of those of fine steps, before up
 * to 35 % (spec/contact/held_swing_spec). Three times the share: 10 %, ten times: 35 %. Where only
 * holds move, old limits do: 2 of 40 such peaks were off by more than 10 % at 20 ms, none at 10 ms;
 * and a laying of 50 MPa would take twice the steps [-]. */
static const double OF_STRETCH = 0.03;

/* Largest force along a line at present, at least its possible friction on obstacles that may move;
 * 0: none does [N]. */
static double pull_of(const sw_scene *s, const sw_body *b) {
  const sw_system *system = sw_scene_system(s);
  double most = sw_contact_friction_moved(sw_scene_contact(s), b);
  for (size_t e = 0; most > 0 && e + 1 < b->plan->nodes; e++)
    most = fmax(most, fabs(system->tension[b->first_edge + e]));
  return most;
}

/* Returns the error along a held, soft line on such obstacles, against its first hold, over the
 * allowed one; 0: other bodies [-]. */
static double over_along(const sw_scene *s, const sw_body *b) {
  const sw_plan *p = b->plan;
  const sw_system *system = sw_scene_system(s);
  if (p->web || !b->held || !sw_scene_contact(s) || sw_body_is_stiff(b, SW_STIFF_TRAVEL)) return 0;
  const double pull = pull_of(s, b);
  if (!(pull > 0)) return 0;
  const double off =
      sw_stepper_error_along(&sw_scene_course(s)->stepper, system, b->first_node,
                             b->first_node + p->nodes, system->held[b->held - 1].node);
  return off / (OF_STRETCH * pull * p->length / (2.0 * b->EA));
}

/* Step error over the allowed error, for methods without an error estimate [-]. */
static double defect_of(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  double over = 0;
  SW_ITEMS(const sw_body, b, system->bodies, system->body_count) {
    if (b->plan->web) continue;
    const size_t first = b->first_node, end = first + b->plan->nodes;
    const double allowed = allowed_of(b, stepper->trial_x);
    over = fmax(over, sw_stepper_defect(stepper, system, first, end) / allowed);
  }
  return over;
}

static double over_of(const sw_scene *s, double tolerance) {
  const sw_system *system = sw_scene_system(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  double over = 0;
  SW_ITEMS(const sw_body, b, system->bodies, system->body_count) {
    const double allowed = fmin(tolerance, allowed_of(b, stepper->trial_x));
    over = fmax(over, fmax(error_of(stepper, system, b) / allowed, over_along(s, b)));
  }
  return over;
}

double sw_coarse_of(const sw_scene *s, double tolerance) {
  return sw_coarse_is_bundle(s) ? 0.0 : over_of(s, tolerance);
}

/* Returns p if the estimate is proportional to h^p [-]. */
static double power_of(const sw_scene *s) {
  return 1.0 + sw_stepper_order(&sw_scene_course(s)->stepper);
}

/* A step that is not divided logs the event "coarse" above this error over the allowed one. A
 * second-order method has an eighth of the error in half the step. A first-order method damps what
 * it does not follow, and its errors add up: of 60 random scenes at 1 ms implicit Euler makes a
 * peak 15 % or more too small in 7, told in 1 with 8 for it and in 7 with 1 (a second-order method
 * in none); at 5 ms in 26 [-]. */
static const double TOLD = 8.0, TOLD_FIRST_ORDER = 1.0, SECOND_ORDER = 3.0;

static void tell(sw_scene *s, double h, double over, double limit, const char *of) {
  if (!(over > limit)) return;
  sw_scene_tell(s, "coarse", "", NAN, over,
                "a step of %.3g ms is too long for %s: peaks may be wrong; run again with dt = "
                "%.2g s and compare the peaks",
                1e3 * h, of, h * exp2(-ceil(log2(over) / power_of(s))));
}

void sw_coarse_tell(sw_scene *s, double h) {
  char of[96];
  if (sw_coarse_is_bundle(s)) {
    snprintf(of, sizeof of, "a bundle of %d or more wires that touch", SW_MOST_NEAR + 1);
    tell(s, h, over_of(s, HUGE_VAL), TOLD, of);
  } else if (sw_coarse_is_crowd(s)) {
    snprintf(of, sizeof of, "the motion of a wire (steps are not divided while %d wires move)",
             SW_MOST_MOVING + 1);
    tell(s, h, over_of(s, HUGE_VAL), TOLD, of);
  } else if (sw_coarse_has_mesh_in_jaws(s) &&
             over_of(s, HUGE_VAL) > 0) { /* 0: there is no estimate */
    snprintf(of, sizeof of, "the motion of a mesh between pads (its steps are not divided)");
    tell(s, h, over_of(s, HUGE_VAL), TOLD, of);
  } else {
    snprintf(of, sizeof of, "the motion of a wire (the integrator %s does not divide steps)",
             sw_scene_course(s)->stepper.method->name);
    tell(s, h, defect_of(s), power_of(s) < SECOND_ORDER ? TOLD_FIRST_ORDER : TOLD, of);
  }
}

/* The same for the shortest part of a step. Parts of blows keep errors up to this, and their peaks
 * are right within a few percent (spec/link/slider_stops_spec) [-]. */
static const double LEFT = 64.0;

int sw_coarse_is_shock(double over) { return over > LEFT; }

void sw_coarse_tell_left(sw_scene *s, double h, double dt, double left) {
  if (!sw_coarse_is_shock(left) || !(dt > h)) return;
  const double less = exp2(-ceil(log2(left) / power_of(s)));
  sw_scene_tell(s, "coarse", "", NAN, left,
                "the motion of a wire is too fast for parts of %.3g ms, the shortest of a step of "
                "%.3g ms: peaks may be wrong; run again with dt = %.2g s and compare the peaks",
                1e3 * h, 1e3 * dt, dt * less);
}

void sw_coarse_tell_rough(sw_scene *s, double h) {
  const double over = sw_coarse_of(s, HUGE_VAL);
  if (sw_coarse_is_shock(over))
    tell(s, h, over, TOLD, "the motion of a wire, and shorter parts of it were as coarse");
}

double sw_coarse_shortest(double dt) { return fmax(SMALLEST * dt, SHORTEST); }

/* If more parts than 1/SMALLEST are needed, there may be a shock, such as a tie made far too short,
 * or a jump. The shortest part is then tried; if it is as coarse, the longer one is taken
 * (step/parts.c). */
double sw_coarse_part(const sw_scene *s, double h, double dt, double over) {
  const double part = h * exp2(-ceil(log2(fmax(over, 1.0)) / power_of(s)));
  if (!(over > 1.0) || h < 2.0 * SHORTEST || h <= SMALLEST * dt * (1 + ROUNDING)) return h;
  return fmax(fmax(SHORTEST, SMALLEST * dt), part);
}

double sw_coarse_half(double h, double dt) {
  const double part = 0.5 * h;
  return part >= sw_coarse_shortest(dt) ? part : h;
}

/* Half a part of smooth motion has an eighth of its error. Half a part with a jump has the same
 * error or more. */
int sw_coarse_helps(double before, double over) { return over <= fmax(1.0, before); }

int sw_coarse_may_grow(const sw_scene *s, double over) { return over * exp2(power_of(s)) <= 1.0; }
