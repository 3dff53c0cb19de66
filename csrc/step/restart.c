/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reasons for a method to start anew (restart.h). */
#include "step/restart.h"

#include "contact/contact.h"
#include "contact/jolt.h"
#include "link/hold.h"
#include "scene/course.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "step/corner.h"
#include "system/axial.h"

/* --- jerks ----------------------------------------------------------------------- */

/* A jerk is a moment at which a drive starts, stops or turns a corner abruptly. Forces just before
 * it belong to a velocity that ends there, and must not start the next step. A method that begins
 * with them counts a dashpot's old force for part of the step: an error of first order. */
static const double BESIDE = 1e-9; /* velocities are compared this far from a jerk [s] */
/* Smaller changes of velocity are not a jump: 10 nm in a step of 10 ms [m/s], [rad/s]. */
static const double NO_JUMP = 1e-6;

static int jumps(sw_vec before, sw_vec after, sw_vec rate1, sw_vec rate2) {
  const double most = NO_JUMP + 2.0 * BESIDE * (sw_norm(rate1) + sw_norm(rate2));
  return sw_dist(before, after) > most;
}

/* *jerks: 1 if the drive has a jerk at this time. */
static sw_status drive_jerks(const sw_drive *d, double time, double h, int smooth, int *jerks,
                             sw_error *err) {
  sw_motion_state one, two;
  if (!d->motion) return SW_OK;
  const double t = time - d->start;
  if (sw_motion_is_function(d->motion))
    return smooth ? SW_OK : sw_motion_jumps(d->motion, t, h, jerks, err);
  SW_TRY(sw_motion_eval(d->motion, t - BESIDE, &one, err));
  SW_TRY(sw_motion_eval(d->motion, t + BESIDE, &two, err));
  *jerks = jumps(one.v, two.v, one.a, two.a) || jumps(one.omega, two.omega, one.alpha, two.alpha);
  return SW_OK;
}

sw_status sw_restart_jerks(const sw_scene *s, double time, double h, int *jerks, sw_error *err) {
  const int smooth = sw_scene_course(s)->smooth;
  *jerks = 0;
  SW_EACH(hold, hold, s) {
    if (hold->alive && !hold->drive.tool)
      SW_TRY(drive_jerks(&hold->drive, time, h, smooth, jerks, err));
    if (*jerks) return SW_OK;
  }
  SW_EACH(tool, t, s) {
    SW_TRY(drive_jerks(&t->drive, time, h, smooth, jerks, err));
    if (*jerks) return SW_OK;
  }
  SW_EACH_DRIVEN(o, s) {
    if (o->alive && !o->drive.tool) SW_TRY(drive_jerks(&o->drive, time, h, smooth, jerks, err));
    if (*jerks) return SW_OK;
  }
  return SW_OK;
}

sw_status sw_restart_at_jerk(sw_scene *s, double h, sw_error *err) {
  sw_course *c = sw_scene_course(s);
  SW_TRY(sw_restart_jerks(s, sw_scene_time(s), h, &c->jerks, err));
  int corner = 0, turned = 0;
  if (!c->jerks) SW_TRY(sw_corner_now(s, &corner, err));
  if (corner) c->jerks = 2;
  if (sw_scene_contact(s)) turned = sw_contact_turned(sw_scene_contact(s), sw_scene_system(s), h);
  if (!c->jerks && !turned) return SW_OK;
  c->stepper.restart |= 1;
  sw_system_uneven(sw_scene_system(s)); /* forces from before would be extrapolated past the jump */
  return SW_OK;
}

/* --- tries ------------------------------------------------------------------------ */

int sw_restart_changed(const sw_scene *s) { return sw_scene_course(s)->next > 0; }

void sw_restart_try(sw_ladder *p) {
  sw_stepper *stepper = &sw_scene_course(p->s)->stepper;
  if (sw_restart_changed(p->s) || p->redo == SW_BY_START) stepper->restart |= 1;
  stepper->plastic = p->redo == SW_DULLY;
}

void sw_restart_struck(sw_scene *s, int dull) {
  sw_course *c = sw_scene_course(s);
  if (dull) c->stepper.plastic = 1;
  c->stepper.restart |= 1;
}

/* 1 if the accelerations at the step's end may come from a shock that is over. The next step then
 * starts without them; otherwise they would push for half of it and make energy. */
static int is_shaken(const sw_scene *s) {
  sw_contact *contact = sw_scene_contact(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  if (!contact || stepper->start == stepper->method) return 0;
  return sw_contact_shaken(contact, sw_scene_system(s));
}

void sw_restart_taken(sw_scene *s) {
  sw_course *c = sw_scene_course(s);
  if (is_shaken(s)) c->stepper.restart |= 1;
  c->next = SW_AS_BEFORE;
}

void sw_restart_refused(sw_ladder *p, int cut) {
  if (!p->smooth && !cut) sw_course_jump(sw_scene_course(p->s));
}

/* --- new steppers and systems ---------------------------------------------------------- */

void sw_restart_stepper(sw_scene *s) {
  sw_course *c = sw_scene_course(s);
  if (c->next == SW_GOES_ON) c->stepper.restart = 0;
}

int sw_restart_pending(const sw_scene *s) {
  return sw_restart_changed(s) || sw_scene_course(s)->stepper.restart;
}

void sw_restart_resume(sw_scene *s, int pending) {
  sw_course *c = sw_scene_course(s);
  c->next = c->stepper.restart = pending;
}
