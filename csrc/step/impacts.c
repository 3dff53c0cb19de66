/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Impacts and rebounds within a step: touches are reviewed after each trial. */
#include <math.h>
#include <string.h>

#include "body/touching.h"
#include "contact/halt.h"
#include "force/force.h"
#include "mutual/halt.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "step/blow.h"
#include "step/restart.h"
#include "system/system.h"

/* Rebounds closer than this share of a step are one [-]. */
static const double SAME_TIME = 1.0 / 1024;
static const double SAME_TIME_CONTROLLED = 1.0 / 4; /* share of the longest step, in runs with a
                                                       tolerance [-] */
enum { MOST_CUTS = 8 };   /* cuts of a step at rebounds; rattling is followed no further [-] */
enum { MOST_REDOS = 40 }; /* impacts found one after another in one step [-] */

/* Returns the shortest part (substep) that may end at a rebound [s]. */
static double shortest_cut(const sw_ladder *p) {
  if (isfinite(p->args->tolerance)) return SAME_TIME_CONTROLLED * p->args->dt;
  return p->cuts < MOST_CUTS ? SAME_TIME * p->args->dt : HUGE_VAL;
}

/* If wires approach each other fast enough to meet within the step, the first try already uses
 * implicit Euler, as steps with a strike do. Returns 1 if it does so only for this reason. */
static int begin_dully(const sw_ladder *p, double h) {
  sw_stepper *stepper = &sw_scene_course(p->s)->stepper;
  if (!(sw_scene_course(p->s)->method->flags & SW_INTEGRATOR_IMPLICIT) || stepper->plastic)
    return 0;
  return stepper->plastic = sw_scene_expects_strike(p->s, h);
}

/* 1 if they did not meet: the step is repeated with the run's method. */
static int was_mistaken(const sw_scene *s, sw_contact_verdict verdict) {
  const int over = verdict == SW_CONTACT_ACCEPT || verdict == SW_CONTACT_SMALLER;
  return over && !sw_scene_was_struck(s);
}

/* 1 if friction changed its direction in a trial in which a drive comes to rest at the end. */
static int has_turned(const sw_scene *s) {
  sw_against sum = {0, 0};
  if (sw_scene_contact(s)) sw_contact_against(sw_scene_contact(s), sw_scene_system(s), &sum);
  if (sw_scene_pairs(s)) sw_mutual_against(sw_scene_pairs(s), sw_scene_system(s), &sum);
  return sw_against_turned(&sum);
}

/* Tries a step of size h; repeats it while contact finds impacts. */
sw_status sw_rung_strike(sw_ladder *p, const sw_rung *below, double h, sw_error *err) {
  sw_scene *s = p->s;
  sw_contact *contact = sw_scene_contact(s);
  sw_course *c = sw_scene_course(s);
  sw_system *system = sw_scene_system(s);
  p->soonest = 0, p->halts = p->turned = 0;
  sw_restart_try(p);
  if (!sw_scene_has_contact(s)) return sw_rung_go(p, below, h, err);
  memcpy(p->v_start, system->v, system->freedoms * sizeof(double));
  const int implicit = c->method->flags & SW_INTEGRATOR_IMPLICIT;
  int stops = 0;
  if (implicit) SW_TRY(sw_restart_halts(s, h, &p->halts, err));
  if (implicit && !p->halts) SW_TRY(sw_restart_stops(s, h, &stops, err));
  sw_status status = sw_scene_begin_contact(s, implicit ? SW_CONTACT_IMPLICIT : SW_CONTACT_EXPLICIT,
                                            sw_scene_time(s), h, sw_blow_part(s, p->args->dt), err);
  if (contact) sw_contact_cut(contact, shortest_cut(p));
  if (contact && p->asked > 0) sw_contact_ask(contact, p->asked, p->args->tolerance > 0);
  if (contact && p->brakes) sw_contact_brake(contact);
  if (stops) c->stepper.plastic = 1;
  int expected = status == SW_OK && begin_dully(p, h);
  for (int redo = 0; status == SW_OK && redo < MOST_REDOS; redo++) {
    status = sw_rung_go(p, below, h, err);
    if (status != SW_OK) break;
    const sw_contact_verdict verdict =
        sw_scene_review_contact(s, c->stepper.trial_x, c->stepper.trial_v, h);
    const int mistaken = expected && was_mistaken(s, verdict);
    const int turned = verdict == SW_CONTACT_ACCEPT && p->halts && has_turned(s);
    if (verdict == SW_CONTACT_ACCEPT && !mistaken && !turned) return SW_OK;
    sw_stepper_reject(&c->stepper, system);
    if (turned) {
      c->stepper.plastic = p->turned = 1, p->halts = 0;
      continue;
    }
    if (mistaken) {
      c->stepper.plastic = expected = 0;
      continue;
    }
    if (verdict == SW_CONTACT_SOONER) {
      p->soonest = sw_contact_soonest(contact);
      status =
          sw_fail(err, SW_ENOCONV, "something rebounds, or a slip turns round, within the step");
      break;
    }
    if (verdict == SW_CONTACT_SMALLER)
      status = sw_fail(err, SW_ENOCONV, "an obstacle cuts too deep into the wire");
    sw_restart_struck(s, verdict == SW_CONTACT_STRIKE);
  }
  memcpy(system->v, p->v_start, system->freedoms * sizeof(double));
  return status != SW_OK ? status
                         : sw_fail(err, SW_ENOCONV, "impacts do not come to an end in one step");
}
