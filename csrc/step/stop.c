/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps in which a drive comes to rest while wires slide, and steps that end early because a drive
 * comes to rest in this way or because its velocity jumps. */
#include "step/stop.h"

#include <math.h>

#include "body/touching.h"
#include "contact/contact.h"
#include "link/hold.h"
#include "mutual/mutual.h"
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "step/coarse.h"
#include "step/corner.h"
#include "step/restart.h"
#include "touch/tally.h"

/* A drive that is slower than this rests [m/s], [rad/s]. */
static const double STILL = 1e-9;
/* A touch that moves less in a step does not slide [m]. */
static const double SLID = 1e-9;
static const double ROUNDING = 1e-12; /* of places and angles [m], [rad] */
/* A drive that stops softly moves by at most this share of its speed times the step: 1/2 with an
 * even deceleration, 1/3 with minimum jerk, 1 if it stops at once [-]. */
static const double SOFTLY = 0.75;
/* A drive nearly stops if its speed at the end of the step is below this share of that at the
 * start. Below 0.07 the error of tr-bdf2 reverses the velocity of pushed wires [-]. */
static const double NEARLY = 0.15;

sw_status sw_stop_eval(const sw_motion *m, double t, sw_motion_state *out, sw_error *err) {
  SW_TRY(sw_motion_eval(m, t, out, err));
  const double half = 0.5 * sw_motion_step(m);
  out->v = sw_madd(out->v, out->a, half), out->omega = sw_madd(out->omega, out->alpha, half);
  return SW_OK;
}

double sw_stop_speed(const sw_motion_state *m) { return sw_norm(m->v) + sw_norm(m->omega); }
static double rate(const sw_motion_state *m) { return sw_norm(m->a) + sw_norm(m->alpha); }

/* The deceleration at the end of a step, over its mean in the step, is at least this if it is even;
 * with minimum jerk it is at most 0.56 where the drive nearly stops [-]. */
static const double EVENLY = 0.75;

static int is_even(const sw_motion_state *now, const sw_motion_state *end, double h) {
  return rate(end) * h > EVENLY * (sw_stop_speed(now) - sw_stop_speed(end));
}

static int goes_softly(const sw_motion_state *before, const sw_motion_state *end, double h) {
  const sw_quat turn = sw_quat_mul(end->pose.q, sw_quat_conj(before->pose.q));
  return sw_dist(before->pose.p, end->pose.p) <= SOFTLY * h * sw_norm(before->v) + ROUNDING &&
         sw_norm(sw_quat_log(turn)) <= SOFTLY * h * sw_norm(before->omega) + ROUNDING;
}

/* *at: 0 if the motion stops softly, or nearly stops, between t and t + h, or did in the step
 * before [s]. */
static sw_status stop_of(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  sw_motion_state end, now, before;
  SW_TRY(sw_stop_eval(m, t + h, &end, err));
  SW_TRY(sw_stop_eval(m, t, &now, err));
  const int rested = sw_stop_speed(&now) < STILL;
  int stops;
  if (sw_stop_speed(&end) >= STILL) {
    stops =
        !rested && sw_stop_speed(&end) < NEARLY * sw_stop_speed(&now) && !is_even(&now, &end, h);
  } else if (rested) {
    SW_TRY(sw_stop_eval(m, t - h, &before, err));
    stops = sw_stop_speed(&before) >= STILL && goes_softly(&before, &end, h);
  } else {
    stops = goes_softly(&now, &end, h);
  }
  if (stops) *at = 0;
  return SW_OK;
}

/* A drive stops with a deceleration if its last deceleration is at least this share of the mean
 * [-]. */
static const double DECELERATES = 0.1;
/* Stops this near to the start or end of a step count as there; share of the step. For functions
 * also stops this near to the start; share of the step of their differences. A shorter part would
 * divide their error by its length [-]. */
static const double NEAR = 1e-3, NEAR_OF_FUNCTION = 0.2;
/* A stop this near to the end of a step is at its end; share of the step. If it is further away, a
 * step that goes past it would reverse the velocity. CLOSE is the same for short parts, as near as
 * in steps of 10 ms: a remainder that short is not a part [-], [s]. */
static const double END = 2e-6, CLOSE = 2e-8;

double sw_stop_before_end(double h) { return h - fmax(END * h, fmin(CLOSE, NEAR * h)); }
enum { HALVINGS = 60 }; /* of the time in which a drive comes to rest */

/* Rates of a function are differences, so its speed is evaluated near the stop, at the last share
 * LAST of the time. Over the speed at the start it is 0.1 if the deceleration is even, 0.01 with
 * minimum jerk, and nearly that at the stop itself if the velocity jumps to 0 there [-]. */
static const double LAST = 0.1, SLOWED = 0.03, AT_ONCE = 0.5;
/* For this the stop must be this many difference steps away [-]. */
static const double STEPS = 20;
/* If it is nearer, its poses are asked for. In the last half of the time it goes 1/4 of the way if
 * the deceleration is even, 1/8 with minimum jerk, 1/2 if it stops at once [-]. */
static const double LEAST_OF_WAY = 0.19, MOST_OF_WAY = 0.375;

static double way(const sw_motion_state *a, const sw_motion_state *b) {
  return sw_dist(a->pose.p, b->pose.p) +
         sw_norm(sw_quat_log(sw_quat_mul(b->pose.q, sw_quat_conj(a->pose.q))));
}

/* *yes: as below, of a function. */
static sw_status function_decelerates(const sw_motion *m, double t, double moves, double rests,
                                      double from, int *yes, sw_error *err) {
  sw_motion_state start, end, late;
  if (rests < STEPS * sw_motion_step(m)) {
    SW_TRY(sw_stop_eval(m, t, &start, err));
    SW_TRY(sw_stop_eval(m, t + 0.5 * rests, &late, err));
    SW_TRY(sw_stop_eval(m, t + rests, &end, err));
    const double all = way(&start, &end), last = way(&late, &end);
    *yes = last > LEAST_OF_WAY * all && last < MOST_OF_WAY * all;
    return SW_OK;
  }
  SW_TRY(sw_stop_eval(m, t + moves, &end, err));
  SW_TRY(sw_stop_eval(m, t + (1 - LAST) * rests, &late, err));
  *yes =
      sw_stop_speed(&late) > SLOWED * from && sw_stop_speed(&end) < AT_ONCE * sw_stop_speed(&late);
  return SW_OK;
}

/* *yes: 1 if a motion that rests after t + rests decelerates until then. */
static sw_status decelerates(const sw_motion *m, double t, double moves, double rests, double from,
                             int *yes, sw_error *err) {
  sw_motion_state end;
  if (sw_motion_is_function(m)) return function_decelerates(m, t, moves, rests, from, yes, err);
  SW_TRY(sw_stop_eval(m, t + moves, &end, err));
  *yes = rate(&end) * rests > DECELERATES * from;
  return SW_OK;
}

sw_status sw_stop_rests(const sw_motion *m, double t, double h, double near, sw_rest *out, int *yes,
                        sw_error *err) {
  sw_motion_state at;
  *yes = 0;
  SW_TRY(sw_stop_eval(m, t + h + near, &at, err));
  if (!(sw_stop_speed(&at) < STILL)) return SW_OK;
  SW_TRY(sw_stop_eval(m, t, &at, err));
  if (sw_stop_speed(&at) < STILL) return SW_OK;
  *out = (sw_rest){0, h + near};
  for (int k = 0; k < HALVINGS && out->rests - out->moves > ROUNDING * h; k++) {
    const double middle = 0.5 * (out->moves + out->rests);
    SW_TRY(sw_stop_eval(m, t + middle, &at, err));
    *(sw_stop_speed(&at) < STILL ? &out->rests : &out->moves) = middle;
  }
  *yes = 1;
  return SW_OK;
}

/* *at: time after t at which a motion comes to rest with a deceleration; 0: at t; h: at t + h [s].
 */
static sw_status halt_of(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  const double near = fmax(NEAR * h, NEAR_OF_FUNCTION * sw_motion_step(m));
  sw_motion_state now;
  sw_rest r;
  int yes;
  SW_TRY(sw_stop_rests(m, t, h, near, &r, &yes, err));
  if (!yes) return SW_OK;
  SW_TRY(sw_stop_eval(m, t, &now, err));
  SW_TRY(decelerates(m, t, r.moves, r.rests, sw_stop_speed(&now), &yes, err));
  if (yes) *at = r.rests < near ? 0.0 : r.rests > sw_stop_before_end(h) ? h : r.rests;
  return SW_OK;
}

/* Smaller changes of velocity are no jump [m/s], [rad/s]. */
static const double NO_JUMP = 1e-6;
/* Accuracy of the time of a jump; a jump this near to a step's start is at the start [s]. */
static const double FOUND = 1e-9;

/* 1 if the velocity changes between two times by more than accelerations explain. */
static int jumps(const sw_motion_state *a, const sw_motion_state *b, double h) {
  const double explained = 2.0 * h * (rate(a) + rate(b));
  return sw_dist(a->v, b->v) + sw_dist(a->omega, b->omega) > NO_JUMP + explained;
}

/* *at: time after t just before a velocity jumps [s]. */
static sw_status jump_of(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  sw_motion_state before, after, middle;
  double from = FOUND, to = h;
  if (!(h > FOUND)) return SW_OK;
  if (sw_motion_is_function(m)) return sw_motion_jump(m, t, h, at, err);
  SW_TRY(sw_stop_eval(m, t + from, &before, err));
  SW_TRY(sw_stop_eval(m, t + to, &after, err));
  if (!jumps(&before, &after, to - from)) return SW_OK;
  while (to - from > FOUND) {
    const double half = 0.5 * (from + to);
    SW_TRY(sw_stop_eval(m, t + half, &middle, err));
    if (jumps(&before, &middle, half - from))
      after = middle, to = half;
    else if (jumps(&middle, &after, to - half))
      before = middle, from = half;
    else
      return SW_OK;
  }
  *at = from;
  return SW_OK;
}

/* Sets *at to the time found for this motion, if it is earlier. */
static sw_status ask(const sw_motion *m, double t, double h, sw_asked which, sw_when of, double *at,
                     sw_error *err) {
  double own = HUGE_VAL;
  if (!m || (which != SW_ALL_DRIVES && sw_motion_is_function(m) != (which == SW_FUNCTIONS)))
    return SW_OK;
  SW_TRY(of(m, t, h, &own, err));
  *at = fmin(*at, own);
  return SW_OK;
}

sw_status sw_drives_first(const sw_scene *s, double h, sw_asked which, sw_when of, double *at,
                          sw_error *err) {
  const double t = sw_scene_time(s);
  *at = HUGE_VAL;
  SW_EACH(hold, hold, s) {
    if (!hold->alive) continue;
    const sw_drive *d = &hold->drive;
    if (!d->tool) SW_TRY(ask(d->motion, t - d->start, h, which, of, at, err));
    SW_TRY(ask(hold->feed.motion, t - hold->feed.start, h, which, of, at, err));
  }
  SW_EACH(tool, tool, s)
    SW_TRY(ask(tool->drive.motion, t - tool->drive.start, h, which, of, at, err));
  SW_EACH_DRIVEN(o, s)
  if (o->alive && !o->drive.tool)
    SW_TRY(ask(o->drive.motion, t - o->drive.start, h, which, of, at, err));
  return SW_OK;
}

int sw_drives_slide(const sw_scene *s, double travel, double way) {
  const sw_contact *contact = sw_scene_contact(s);
  const sw_system *system = sw_scene_system(s);
  const size_t count = contact ? sw_contact_touches(contact) : 0;
  sw_contact_push p;
  for (size_t k = 0; k < count; k++)
    if (sw_contact_slides(contact, k, SLID) && sw_contact_push_at(contact, system, k, &p) &&
        p.slid < way &&
        (!(travel < HUGE_VAL) ||
         sw_body_is_stiff(&system->bodies[sw_system_body_of(system, p.node)], travel)))
      return 1;
  const sw_mutual *pairs = sw_scene_pairs(s);
  return pairs && !(way < HUGE_VAL) && sw_presses_slide(sw_mutual_presses(pairs), SLID);
}

static int any_slides(const sw_scene *s) { return sw_drives_slide(s, HUGE_VAL, HUGE_VAL); }

/* *at: 0 if the velocity of a function may jump within the step. */
static sw_status rough_of(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  int smooth;
  SW_TRY(sw_motion_smooth(m, t, h, &smooth, err));
  if (!smooth) *at = 0;
  return SW_OK;
}

sw_status sw_stop_any(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  (void)m, (void)t, (void)h, (void)err;
  *at = 0;
  return SW_OK;
}

/* As sw_drives_first, only while wires slide. */
static sw_status while_sliding(const sw_scene *s, double h, sw_when of, double *at, sw_error *err) {
  double any, later;
  SW_TRY(sw_drives_first(s, h, SW_LAWS, of, at, err));
  SW_TRY(sw_drives_first(s, h, SW_FUNCTIONS, sw_stop_any, &any, err));
  if ((!(*at <= h) && any > 0) || !any_slides(s)) {
    *at = HUGE_VAL;
    return SW_OK;
  }
  SW_TRY(sw_drives_first(s, h, SW_FUNCTIONS, of, &later, err));
  *at = fmin(*at, later);
  return SW_OK;
}

sw_status sw_restart_until_break(sw_scene *s, double *h, sw_error *err) {
  double rough, jump, corner, halt = HUGE_VAL;
  SW_TRY(sw_drives_first(s, *h, SW_FUNCTIONS, rough_of, &rough, err));
  const int smooth = sw_scene_course(s)->smooth = rough > 0;
  SW_TRY(sw_drives_first(s, *h, smooth ? SW_LAWS : SW_ALL_DRIVES, jump_of, &jump, err));
  if (sw_scene_has_contact(s)) SW_TRY(while_sliding(s, *h, halt_of, &halt, err));
  SW_TRY(sw_corner_first(s, *h, &corner, err));
  const double t = fmin(fmin(jump, corner) < *h * (1 - NEAR) ? fmin(jump, corner) : HUGE_VAL, halt);
  if (t > 0 && t < sw_stop_before_end(*h)) *h = t;
  return SW_OK;
}

/* --- a stop at once ------------------------------------------------------------------- */

/* Wires that slide with a drive that stops at once slide on. Waves of push and pull run along them,
 * friction changes its direction, and at rest it keeps what remains: in a stiff cable all of the
 * push, mu m g. Whole steps of 5 to 20 ms left 0.45 to 0.95 of that. Parts up to SW_STOPS give it
 * within 0.01, in steps of 20 ms within 0.06; parts of 2 ms do so for stiff cables only. Parts stay
 * short until no wire slides, at most for FOLLOWED and at least for LEAST: after 20 ms a rubber
 * wire (3 MPa) still swings (spec/contact/stop_at_once_spec) [s]. */
static const double FOLLOWED = 5e-2, LEAST = 1e-2;
/* Distance of the evaluations from a stop. A stop may be this far from the start of a part, because
 * jumps nearer than this to the end of a part do not end it; share of the step for functions [s],
 * [-]. */
static const double ASIDE = 2e-9, ASIDE_OF_FUNCTION = 1.0 / 100;

/* *at: 0 if the motion stops at once at t, in steps of h. */
static sw_status stop_at_once(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  const int function = sw_motion_is_function(m);
  const double after = function ? ASIDE_OF_FUNCTION * h + sw_motion_step(m) : ASIDE;
  const double before = function ? after : ASIDE + NEAR * h;
  sw_motion_state was, is;
  SW_TRY(sw_stop_eval(m, t + after, &is, err)); /* first: most drives move, and this decides */
  if (!(sw_stop_speed(&is) < STILL)) return SW_OK;
  SW_TRY(sw_stop_eval(m, t - before, &was, err));
  if (sw_stop_speed(&was) > SW_CREEPS && jumps(&was, &is, before + after)) *at = 0;
  return SW_OK;
}

sw_status sw_restart_after_stop(sw_scene *s, double h, sw_error *err) {
  sw_course *c = sw_scene_course(s);
  double at;
  if (!sw_scene_contact(s) && (!sw_scene_pairs(s) || sw_coarse_is_bundle(s))) return SW_OK;
  const double left = c->stop_until - sw_scene_time(s);
  if (left > 0 && left < FOLLOWED - LEAST && !any_slides(s)) c->stop_until = 0;
  sw_stop_tell(s);
  SW_TRY(while_sliding(s, h, stop_at_once, &at, err));
  if (at > 0) return SW_OK;
  c->stop_until = sw_scene_time(s) + FOLLOWED;
  sw_stop_note(s);
  return SW_OK;
}

double sw_restart_part(const sw_scene *s) {
  return sw_scene_time(s) < sw_scene_course(s)->stop_until ? SW_STOPS : HUGE_VAL;
}

sw_status sw_restart_halts(const sw_scene *s, double h, int *halts, sw_error *err) {
  double at;
  SW_TRY(while_sliding(s, h, halt_of, &at, err));
  *halts = at <= h;
  return SW_OK;
}

sw_status sw_restart_stops(const sw_scene *s, double h, int *stops, sw_error *err) {
  double at;
  SW_TRY(while_sliding(s, h, stop_of, &at, err));
  *stops = at <= h;
  return SW_OK;
}
