/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps in which a drive comes to rest while wires slide, and steps that end early because the
 * velocity of a drive jumps or a drive so comes to rest. */
#include <math.h>

#include "contact/contact.h"
#include "link/hold.h"
#include "scene/drive.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "step/restart.h"

/* A drive that is slower than this rests [m/s], [rad/s]. */
static const double STILL = 1e-9;
/* A touch that goes less in a step does not slide [m]. */
static const double SLID = 1e-9;
static const double ROUNDING = 1e-12; /* of places and turns [m], [rad] */
/* A drive that stops softly goes at most this share of its speed times the step: 1/2 with an even
 * deceleration, 1/3 with minimum jerk; 1 if it stops at once [-]. */
static const double SOFTLY = 0.75;
/* A drive stops nearly if it is this much slower at the step's end than at its start. The error of
 * tr-bdf2 turns the velocity of what it pushes to the other side below 0.07 [-]. */
static const double NEARLY = 0.15;

/* Evaluates a motion just after t. The velocity of a function is a difference over the time before
 * and after. */
static int eval(const sw_motion *m, double t, sw_motion_state *out) {
  sw_error ignored;
  if (sw_motion_eval(m, t, out, &ignored) != SW_OK) return 0;
  const double half = 0.5 * sw_motion_step(m);
  out->v = sw_madd(out->v, out->a, half), out->omega = sw_madd(out->omega, out->alpha, half);
  return 1;
}

static double speed(const sw_motion_state *m) { return sw_norm(m->v) + sw_norm(m->omega); }
static double rate(const sw_motion_state *m) { return sw_norm(m->a) + sw_norm(m->alpha); }

/* An even deceleration is this share of its mean over a step, or more, at the step's end; that of
 * minimum jerk is at most 0.56 where the drive stops nearly [-]. */
static const double EVENLY = 0.75;

static int is_even(const sw_motion_state *now, const sw_motion_state *end, double h) {
  return rate(end) * h > EVENLY * (speed(now) - speed(end));
}

/* 1 if the motion comes softly to rest, or nearly, from t to t + h, or did in the step before. */
static int stops(const sw_motion *m, double t, double h) {
  sw_motion_state end, now, before;
  if (!eval(m, t + h, &end) || !eval(m, t, &now)) return 0;
  const int rested = speed(&now) < STILL;
  if (speed(&end) >= STILL)
    return !rested && speed(&end) < NEARLY * speed(&now) && !is_even(&now, &end, h);
  if (rested && (!eval(m, t - h, &before) || speed(&before) < STILL)) return 0;
  if (!rested) before = now;
  const sw_quat turn = sw_quat_mul(end.pose.q, sw_quat_conj(before.pose.q));
  return sw_dist(before.pose.p, end.pose.p) <= SOFTLY * h * sw_norm(before.v) + ROUNDING &&
         sw_norm(sw_quat_log(turn)) <= SOFTLY * h * sw_norm(before.omega) + ROUNDING;
}

/* A drive stops with a deceleration if that at the end is this share of the mean one [-]. */
static const double DECELERATES = 0.1;
/* A stop this near to the start or end of a step counts as there; share of the step. Of a function
 * also one this near to its start; share of the step of its differences. A shorter part would
 * divide their error by its length [-]. */
static const double NEAR = 1e-3, NEAR_OF_FUNCTION = 0.2;
/* A stop this near to the end of a step is there; share of the step. Further away, a step that goes
 * on would turn the velocity round [-]. */
static const double END = 2e-6;
enum { HALVINGS = 60 }; /* of the time in which a drive comes to rest */

/* Returns the time after t at which a motion comes to rest with a deceleration; 0: at t; h: at t +
 * h; HUGE_VAL: not between these [s]. */
static double halt_of(const sw_motion *m, double t, double h) {
  const double near = fmax(NEAR * h, NEAR_OF_FUNCTION * sw_motion_step(m));
  sw_motion_state now, end;
  if (!eval(m, t + h + near, &end) || !(speed(&end) < STILL)) return HUGE_VAL;
  if (!eval(m, t, &now) || speed(&now) < STILL) return HUGE_VAL;
  double moves = 0, rests = h + near;
  for (int k = 0; k < HALVINGS && rests - moves > ROUNDING * h; k++) {
    const double middle = 0.5 * (moves + rests);
    if (!eval(m, t + middle, &end)) return HUGE_VAL;
    *(speed(&end) < STILL ? &rests : &moves) = middle;
  }
  if (!eval(m, t + moves, &end)) return HUGE_VAL;
  if (!(rate(&end) * rests > DECELERATES * speed(&now))) return HUGE_VAL;
  return rests < near ? 0.0 : rests > h * (1 - END) ? h : rests;
}

/* Smaller changes of velocity are no jump [m/s], [rad/s]. */
static const double NO_JUMP = 1e-6;
/* A jump is found to this, and one this near to a step's start is there [s]. */
static const double FOUND = 1e-9;

/* 1 if the velocity changes more between two times than accelerations explain. */
static int jumps(const sw_motion_state *a, const sw_motion_state *b, double h) {
  const double explained = 2.0 * h * (rate(a) + rate(b));
  return sw_dist(a->v, b->v) + sw_dist(a->omega, b->omega) > NO_JUMP + explained;
}

/* Returns the time after t just before a velocity jumps, up to h; HUGE_VAL: it does not [s]. A
 * function's velocity, a difference, does not jump. */
static double jump_of(const sw_motion *m, double t, double h) {
  sw_motion_state before, after, middle;
  double from = FOUND, to = h;
  if (!(h > FOUND) || !eval(m, t + from, &before) || !eval(m, t + to, &after)) return HUGE_VAL;
  if (!jumps(&before, &after, to - from)) return HUGE_VAL;
  while (to - from > FOUND) {
    const double half = 0.5 * (from + to);
    if (!eval(m, t + half, &middle)) return HUGE_VAL;
    if (jumps(&before, &middle, half - from))
      after = middle, to = half;
    else if (jumps(&middle, &after, to - half))
      before = middle, from = half;
    else
      return HUGE_VAL;
  }
  return from;
}

/* The same for a stop, soft or not: 0 [s]. */
static double stop_of(const sw_motion *m, double t, double h) {
  return stops(m, t, h) ? 0.0 : HUGE_VAL;
}

typedef double (*when)(const sw_motion *m, double t, double h);

/* Which drives are asked: functions of a script are slow, and only asked while wires slide. */
typedef enum asked { LAWS, FUNCTIONS } asked;

static double ask(const sw_motion *m, double start, const sw_scene *s, double h, asked which,
                  when of) {
  if (!m || sw_motion_is_function(m) != (which == FUNCTIONS)) return HUGE_VAL;
  return of(m, sw_scene_time(s) - start, h);
}

/* The first time of all drives. */
static double first(const sw_scene *s, double h, asked which, when of) {
  double t = HUGE_VAL;
  SW_EACH(hold, hold, s) {
    if (!hold->alive) continue;
    const sw_drive *d = &hold->drive;
    if (!d->tool) t = fmin(t, ask(d->motion, d->start, s, h, which, of));
    t = fmin(t, ask(hold->feed.motion, hold->feed.start, s, h, which, of));
  }
  SW_EACH(tool, tool, s) t = fmin(t, ask(tool->drive.motion, tool->drive.start, s, h, which, of));
  SW_EACH(obstacle, o, s)
    if (o->alive && !o->drive.tool)
      t = fmin(t, ask(o->drive.motion, o->drive.start, s, h, which, of));
  return t;
}

static int any_slides(const sw_scene *s) {
  const sw_contact *contact = sw_scene_contact(s);
  const size_t count = contact ? sw_contact_touches(contact) : 0;
  sw_contact_push p;
  for (size_t k = 0; k < count; k++)
    if (sw_contact_push_at(contact, sw_scene_system(s), k, &p) && p.friction > 0 &&
        sw_norm(p.slip) > SLID)
      return 1;
  return 0;
}

/* For the question whether there is any such drive. */
static double at_once(const sw_motion *m, double t, double h) {
  (void)m, (void)t, (void)h;
  return 0;
}

/* The same while wires slide. */
static double while_sliding(const sw_scene *s, double h, when of) {
  const double t = first(s, h, LAWS, of);
  if (!(t <= h) && first(s, h, FUNCTIONS, at_once) > 0) return HUGE_VAL;
  return any_slides(s) ? fmin(t, first(s, h, FUNCTIONS, of)) : HUGE_VAL;
}

double sw_restart_until_break(const sw_scene *s, double h) {
  const double jump = first(s, h, LAWS, jump_of);
  const double halt = sw_scene_contact(s) ? while_sliding(s, h, halt_of) : HUGE_VAL;
  const double t = fmin(jump < h * (1 - NEAR) ? jump : HUGE_VAL, halt);
  return t > 0 && t < h * (1 - END) ? t : h;
}

int sw_restart_halts(const sw_scene *s, double h) { return while_sliding(s, h, halt_of) <= h; }

int sw_restart_stops(const sw_scene *s, double h) { return while_sliding(s, h, stop_of) <= h; }
