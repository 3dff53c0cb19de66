/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shortens the parts of a step before a drive comes softly to rest while rods slide. */
#include <math.h>

#include "body/touching.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "step/coarse.h"
#include "step/restart.h"
#include "step/stop.h"

/* A cable that has just landed trembles, and the last milliseconds before its drive stops decide
 * how much friction remains at rest. So parts are SW_STOPS long, from LEAD before the stop until no
 * wire slides, at most until AFTER the stop. Then friction is right within 0.01 of mu N in the
 * mean; whole steps of 10 ms left 0.72 instead of -0.44 mu N. A cable that is lowered lands to the
 * last; a whole step may make it hop there, and its friction is lost: with LEAD of 0.01 s one run
 * in seven is off by up to 0.8, with 0.05 s no fewer than with 0.03 s
 * (spec/contact/soft_landing_spec) [s]. */
static const double LEAD = 0.03, AFTER = 0.01;

/* *at: time after t at which LEAD begins, up to h; it may have begun [s]. */
static sw_status leads_of(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  sw_motion_state last;
  sw_rest r;
  int yes;
  SW_TRY(sw_stop_rests(m, t - AFTER, AFTER + h + LEAD, 0, &r, &yes, err));
  if (!yes) return SW_OK;
  SW_TRY(sw_stop_eval(m, t - AFTER + r.moves, &last, err));
  if (sw_stop_speed(&last) <= SW_CREEPS)
    *at = r.rests - AFTER - LEAD; /* else the drive stops at once */
  return SW_OK;
}

/* Longest travel time of waves along a line that gets short parts; this value: any line. Friction
 * stretches a wire with longer travel times (3 m of cable, 0.2 m of a rubber hose) fifty times as
 * far as its touches give way in steps of 10 ms: it needs neither short parts nor stiff friction
 * (SW_STIFF_TRAVEL). With a tolerance steps are short anyway, and all lines get short parts [s]. */
static const double ANY_LINE = 1e6;

static double travel_of(const sw_ladder *p) {
  return isfinite(p->args->tolerance) ? ANY_LINE : SW_STIFF_TRAVEL;
}

/* Wires that landed earlier than this no longer tremble [s]. */
static const double LATELY = 0.2;

/* *at: minus the distance that the motion moved in the time LATELY [m]. */
static sw_status went_of(const sw_motion *m, double t, double h, double *at, sw_error *err) {
  sw_motion_state now, before;
  (void)h;
  SW_TRY(sw_stop_eval(m, t, &now, err));
  SW_TRY(sw_stop_eval(m, t - LATELY, &before, err));
  *at = -sw_dist(now.pose.p, before.pose.p);
  return SW_OK;
}

/* As leads_of, for functions, and only where a rod has landed lately. Velocities of a function lag
 * a little; in short parts a cable that was only drawn would lose 0.1 of mu N by this. Functions
 * are not called for times after the run's end. */
static sw_status function_leads(const sw_ladder *p, double h, double *at, sw_error *err) {
  const double most = fmin(h, p->until - sw_scene_time(p->s) - LEAD);
  double back;
  SW_TRY(sw_drives_first(p->s, most, SW_FUNCTIONS, leads_of, at, err));
  if (!(*at < h)) return SW_OK;
  SW_TRY(sw_drives_first(p->s, h, SW_FUNCTIONS, went_of, &back, err));
  if (!sw_drives_slide(p->s, travel_of(p), -back)) *at = HUGE_VAL;
  return SW_OK;
}

/* A remainder below this share of a part is not a part of its own [-]. */
static const double NO_PART = 0.01;

sw_status sw_restart_before_stop(sw_ladder *p, double *h, sw_error *err) {
  const sw_scene *s = p->s;
  double at, any, later = HUGE_VAL;
  p->brakes = 0;
  if (!sw_scene_has_contact(s) || sw_coarse_is_bundle(s)) return SW_OK;
  SW_TRY(sw_drives_first(s, *h, SW_LAWS, leads_of, &at, err));
  SW_TRY(sw_drives_first(s, *h, SW_FUNCTIONS, sw_stop_any, &any, err));
  if (!(fmin(at, any) < *h * (1 - NO_PART)) || !sw_drives_slide(s, travel_of(p), HUGE_VAL))
    return SW_OK;
  if (any < HUGE_VAL) SW_TRY(function_leads(p, *h, &later, err));
  at = fmin(at, later);
  if (!(at < *h * (1 - NO_PART))) return SW_OK;
  p->brakes = at <= 0 && !(sw_scene_course(s)->stepper.restart & SW_HALTED);
  if (at > 0) {
    *h = fmin(*h, fmax(at, SW_STOPS));
    return SW_OK;
  }
  const double left = at + LEAD; /* until the stop, at which a part of full length ends */
  const double until = left > SW_STOPS * NO_PART && left < sw_stop_before_end(*h) ? left : *h;
  *h = until / fmax(1.0, ceil(until / SW_STOPS - NO_PART));
  return SW_OK;
}
