/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Corners of drives: moments at which their acceleration jumps, as in a trapezoidal motion. A
 * method that uses earlier steps takes a path with a corner for a smooth one. The forces of bdf2 on
 * a stiff cable are then off by 0.78 of the jump times the cable's mass, whatever the step. So a
 * part ends at a corner, and the method starts anew there. */
#include "step/corner.h"

#include <math.h>

#include "contact/contact.h"
#include "link/hold.h"
#include "scene/course.h"
#include "scene/gripper.h"
#include "scene/lists.h"
#include "scene/obstacle.h"
#include "scene/parts.h"

/* Smaller jumps are no corner: with 0.1 m/s2 forces are off by 0.8 % of a wire's weight [m/s2],
 * [rad/s2]. */
static const double LEAST = 0.1;
/* A corner keeps more than this share of a change in one half of the time; an even change leaves
 * half of it in each [-]. */
static const double AT_ONCE = 0.8;
/* Corners are found to this; accelerations are compared this far from a time [s]. */
static const double FOUND = 1e-9;

static double change(const sw_motion_state *a, const sw_motion_state *b) {
  return sw_dist(a->a, b->a) + sw_dist(a->alpha, b->alpha);
}

/* *at: time after t of a corner, up to h [s]. */
static sw_status corner_of(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  sw_motion_state before, after, middle;
  double from = FOUND, to = h;
  if (sw_motion_is_function(m)) return sw_motion_corner(m, t, h, at, err);
  if (!(h > 2 * FOUND)) return SW_OK;
  SW_TRY(sw_motion_eval(m, t + from, &before, err));
  SW_TRY(sw_motion_eval(m, t + to, &after, err));
  double all = change(&before, &after);
  if (!(all > LEAST)) return SW_OK;
  while (to - from > FOUND) {
    const double half = 0.5 * (from + to);
    SW_TRY(sw_motion_eval(m, t + half, &middle, err));
    const double first = change(&before, &middle), second = change(&middle, &after);
    if (!(fmax(first, second) > AT_ONCE * all) || !(fmax(first, second) > LEAST)) return SW_OK;
    if (first > second)
      after = middle, to = half, all = first;
    else
      before = middle, from = half, all = second;
  }
  *at = to;
  return SW_OK;
}

/* *at: 0 if there is a corner at t. */
static sw_status corner_at(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  sw_motion_state before, after;
  (void)h;
  if (sw_motion_is_function(m)) {
    int yes;
    SW_TRY(sw_motion_corners(m, t, &yes, err));
    if (yes) *at = 0;
    return SW_OK;
  }
  SW_TRY(sw_motion_eval(m, t - 2 * FOUND, &before, err));
  SW_TRY(sw_motion_eval(m, t + 2 * FOUND, &after, err));
  const double all = change(&before, &after);
  if (!(all > LEAST)) return SW_OK;
  /* in a motion of some milliseconds an even change may be as large: half of it is nearer to t */
  SW_TRY(sw_motion_eval(m, t - FOUND, &before, err));
  SW_TRY(sw_motion_eval(m, t + FOUND, &after, err));
  if (change(&before, &after) > AT_ONCE * all) *at = 0;
  return SW_OK;
}

/* A function that is slower than this rests [m/s], [rad/s]. */
static const double STILL = 1e-9;

/* *rests: 1 if the motion rests after a corner at t. A function rests at all times that its
 * differences reach, from a corner that is a difference step off. */
static sw_status rests_after(const sw_motion *m, double t, int *rests, sw_error *err) {
  sw_motion_state after;
  const int function = sw_motion_is_function(m);
  SW_TRY(sw_motion_eval(m, t + (function ? 3 * sw_motion_step(m) : 2 * FOUND), &after, err));
  *rests = !(sw_stop_speed(&after) > (function ? STILL : 0));
  return SW_OK;
}

/* What is asked of the drives. Whether wires slide is looked up only where it matters: that reads
 * every touch, and most steps have no corner. */
typedef struct asking {
  const sw_scene *s;
  double h;  /* [s] */
  int slide; /* 1: wires slide; -1: not known yet */
} asking;

static int slides(asking *a) {
  if (a->slide < 0) a->slide = sw_drives_slide(a->s, HUGE_VAL, HUGE_VAL);
  return a->slide;
}

/* Corners from t to t + h. While wires slide, corners at which a function comes to rest are left
 * out: stop.c knows how near to a step's ends these may be. */
static sw_status first_of(asking *a, const sw_motion *m, double t, double *at, sw_error *err) {
  double own = HUGE_VAL;
  int rests = 0;
  SW_TRY(corner_of(m, t, a->h, &own, err));
  if (own < HUGE_VAL && sw_motion_is_function(m) && slides(a))
    SW_TRY(rests_after(m, t + own, &rests, err));
  if (!rests) *at = fmin(*at, own);
  return SW_OK;
}

/* A corner at t. Wires that slide with a drive until it rests keep their friction (stop.c), and a
 * restart would turn it: such corners are left out. */
static sw_status now_of(asking *a, const sw_motion *m, double t, double *at, sw_error *err) {
  const int function = sw_motion_is_function(m);
  double own = HUGE_VAL;
  int rests = 0;
  if (function && slides(a)) SW_TRY(rests_after(m, t, &rests, err));
  if (!rests) SW_TRY(corner_at(m, t, a->h, &own, err));
  if (!function && own < HUGE_VAL && slides(a)) SW_TRY(rests_after(m, t, &rests, err));
  if (!rests) *at = fmin(*at, own);
  return SW_OK;
}

typedef sw_status (*asked)(asking *, const sw_motion *, double, double *, sw_error *);

static sw_status ask(asking *a, const sw_drive *d, asked of, double *at, sw_error *err) {
  if (d->tool) d = &sw_scene_tool_in(a->s, d->tool - 1)->drive;
  if (!d->motion) return SW_OK;
  if (sw_scene_pairs(a->s) && sw_motion_is_function(d->motion) && slides(a)) return SW_OK;
  return of(a, d->motion, sw_scene_time(a->s) - d->start, at, err);
}

/* Asks the drives of holds, and of obstacles near wires. In a scene whose wires may touch each
 * other corners are left out while wires slide: a cable's sag swings after a corner, steps of 20 ms
 * do not follow that, and friction at rest came out 0.16 mu m g too low
 * (spec/contact/pair_stop_spec). */
static sw_status ask_all(const sw_scene *s, double h, asked of, double *at, sw_error *err) {
  const sw_contact *contact = sw_scene_contact(s);
  asking a = {s, h, -1};
  size_t count = 0;
  *at = HUGE_VAL;
  /* Explicit methods take short steps and begin each with the forces of its start. implicit-euler
   * takes a path's chords for velocities: in a short step after a long one they jump. */
  const sw_integrator *method = sw_scene_course(s)->method;
  if (!(method->flags & SW_INTEGRATOR_IMPLICIT) || method->order < 2) return SW_OK;
  SW_EACH(hold, hold, s)
    if (hold->alive) SW_TRY(ask(&a, &hold->drive, of, at, err));
  const int *busy = contact ? sw_contact_busy(contact, &count) : NULL;
  for (size_t k = 0; k < count; k++)
    SW_TRY(ask(&a, &sw_scene_obstacle_in(s, (size_t)busy[k])->drive, of, at, err));
  if (*at < HUGE_VAL && sw_scene_pairs(s) && slides(&a)) *at = HUGE_VAL;
  return SW_OK;
}

sw_status sw_corner_first(const sw_scene *s, double h, double *at, sw_error *err) {
  return ask_all(s, h, first_of, at, err);
}

sw_status sw_corner_now(const sw_scene *s, int *yes, sw_error *err) {
  double at;
  SW_TRY(ask_all(s, 0, now_of, &at, err));
  *yes = at <= 0;
  return SW_OK;
}
