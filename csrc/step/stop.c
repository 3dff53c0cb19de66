/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps in which a drive comes to rest softly while wires slide. */
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

static int eval(const sw_motion *m, double t, sw_motion_state *out) {
  sw_error ignored;
  return sw_motion_eval(m, t, out, &ignored) == SW_OK;
}

static double speed(const sw_motion_state *m) { return sw_norm(m->v) + sw_norm(m->omega); }

/* 1 if the motion comes softly to rest, or nearly, between t and t + h, or did in the step before.
 */
static int stops(const sw_motion *m, double t, double h) {
  sw_motion_state end, now, before;
  if (!m || sw_motion_is_function(m)) return 0;
  if (!eval(m, t + h, &end) || !eval(m, t, &now)) return 0;
  const int rested = speed(&now) < STILL;
  if (speed(&end) >= STILL) return !rested && speed(&end) < NEARLY * speed(&now);
  if (rested && (!eval(m, t - h, &before) || speed(&before) < STILL)) return 0;
  if (!rested) before = now;
  const sw_quat turn = sw_quat_mul(end.pose.q, sw_quat_conj(before.pose.q));
  return sw_dist(before.pose.p, end.pose.p) <= SOFTLY * h * sw_norm(before.v) + ROUNDING &&
         sw_norm(sw_quat_log(turn)) <= SOFTLY * h * sw_norm(before.omega) + ROUNDING;
}

static int any_stops(const sw_scene *s, double t, double h) {
  SW_EACH(hold, hold, s) {
    if (!hold->alive) continue;
    if (!hold->drive.tool && stops(hold->drive.motion, t - hold->drive.start, h)) return 1;
    if (stops(hold->feed.motion, t - hold->feed.start, h)) return 1;
  }
  SW_EACH(tool, tool, s)
    if (stops(tool->drive.motion, t - tool->drive.start, h)) return 1;
  SW_EACH(obstacle, o, s)
    if (o->alive && !o->drive.tool && stops(o->drive.motion, t - o->drive.start, h)) return 1;
  return 0;
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

int sw_restart_stops(const sw_scene *s, double h) {
  return any_stops(s, sw_scene_time(s), h) && any_slides(s);
}
