/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes an accepted trial the state of the scene: commits it, records it and books its energy. */
#include <math.h>

#include "body/hold.h"
#include "body/touching.h"
#include "contact/halt.h"
#include "mutual/halt.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/ledger.h"
#include "scene/parts.h"
#include "step/believe.h"
#include "step/blow.h"
#include "step/energy.h"
#include "step/jaw.h"
#include "step/restart.h"
#include "step/run.h"
#include "step/slip.h"
#include "system/system.h"
#include "watch/observe.h"

/* The run stops and says why if this many successive parts (substeps) together cover less than this
 * share of the steps that they belong to [-]. With a tolerance, parts may be much smaller. */
enum { MOST_SMALL = 20000, MOST_SMALL_ADAPTIVE = 20000 };
static const double SMALL = 1.0 / 512, SMALL_ADAPTIVE = 2e-5;

/* 1 while the parts of a blow are short. Friction is then stiff enough for such parts, and wires
 * that stopped now would lie higher than after whole steps. */
static int is_followed(const sw_ladder *p) { return sw_blow_part(p->s, p->args->dt) < p->args->dt; }

/* A drive comes to rest while wires slide. Friction at rest is known if the wires only slide. Wires
 * that have just landed, or that swing, still tremble; this motion decides in the last milliseconds
 * how much friction remains. Parts longer than FINE with speeds above TREMBLE are reported: soft
 * wires kept -0.33 to 0.95 of their friction instead of 0.36 to 0.57
 * (spec/contact/trembling_stop_spec). In shorter parts the friction is right, except in one of
 * twenty runs with steps longer than LONG. Such steps are reported too
 * (spec/contact/soft_landing_spec) [m/s], [s]. */
static const double TREMBLE = 1e-6, FINE = 5.5e-4, LONG = 0.0105;
/* Largest possible friction of all touches with obstacles and between lines [N]. */
static double friction_of(const sw_scene *s) {
  return (sw_scene_contact(s) ? sw_contact_friction(sw_scene_contact(s)) : 0.0) +
         (sw_scene_pairs(s) ? sw_mutual_friction(sw_scene_pairs(s)) : 0.0);
}

/* Sets friction at rest. Returns the largest possible friction of the wires that still tremble
 * [N]. */
static double halt(sw_scene *s) {
  sw_contact *contact = sw_scene_contact(s);
  sw_system *system = sw_scene_system(s);
  double moving = 0;
  if (sw_scene_pairs(s)) moving += sw_mutual_halt(sw_scene_pairs(s), contact, system, TREMBLE);
  if (contact) moving += sw_contact_halt(contact, system, TREMBLE);
  return moving;
}

/* As halt. Softer friction stores more energy at the same force: this is not made by the step. */
static double halt_wires(sw_scene *s) {
  sw_step_energy *step = &sw_scene_books(s)->step;
  const double before = sw_ledger_contact(s), moving = halt(s);
  const double more = sw_ledger_contact(s) - before;
  step->contact += more, step->let_out += fmax(0.0, more);
  return moving;
}

/* Friction of trembling wires is reported above this share of all friction [-]. */
static const double TOLD = 0.1;

/* Reports that forces at rest may be off by `friction` [N]. what: the reason; h: step or part
 * [s]. */
static void tell_rest(sw_scene *s, const char *what, double h, double friction) {
  sw_scene_tell(
      s, "coarse", "", NAN, friction,
      "a drive stops %s %.3g ms: forces at rest may be off by the friction of %.3g N; run "
      "again with dt = 0.0005 s and compare them",
      what, 1e3 * h, friction);
}

/* moving: largest possible friction of the wires that tremble [N]. */
static void tell_trembling(sw_scene *s, double h, double dt, double moving) {
  if ((h > FINE || dt > LONG) && moving > TOLD * friction_of(s))
    tell_rest(s, "while wires that slide still tremble, in steps of", dt > LONG ? dt : h, moving);
}

/* A drive has stopped at once, and wires that slid with it land. Blows, waves and friction that
 * changes direction decide how much friction remains. Steps up to AT_ONCE_FINE gave it within 0.1
 * of mu N, because they are divided in this case. Longer steps gave 0.21 to -0.88 instead of -0.95
 * to -0.99 (spec/contact/landing_stop_spec) [s]. */
static const double AT_ONCE_FINE = 1.05e-3;
/* A landing is reported if touches with more than this share of all friction land in one part
 * [-]. */
static const double LANDED = 0.03;

static void tell_landing(sw_scene *s, double dt, double landed) {
  const double all = sw_contact_friction(sw_scene_contact(s));
  if (dt > AT_ONCE_FINE && landed > LANDED * all)
    tell_rest(s, "at once, and wires that slid with it land in steps of", dt, all);
}

void sw_ladder_accept(sw_ladder *p, double h, double t) {
  sw_scene *s = p->s;
  sw_course *c = sw_scene_course(s);
  sw_system *system = sw_scene_system(s);
  sw_stepper_accept(&c->stepper, system, h);
  system->judged = c->stepper.trial_x;
  double moving = p->turned ? friction_of(s) : 0.0;
  if (p->halts) {
    moving = halt_wires(s);
    c->stepper.restart |= 1 | SW_HALTED;
  }
  const int stopped = sw_scene_contact(s) && sw_scene_time(s) < c->stop_until;
  const double landed = stopped ? sw_contact_landed(sw_scene_contact(s), system) : 0.0;
  sw_scene_commit_contact(s, 0);
  if (sw_scene_contact(s) && !sw_course_lumps(c) && !is_followed(p)) sw_scene_stop_wires(s);
  sw_restart_taken(s);
  c->span = h;
  if (c->method->flags & SW_INTEGRATOR_NO_CONTACT) sw_scene_remark_contact(s);
  p->changed = 0;
  p->report->steps++;
  if (h < p->report->smallest_dt) p->report->smallest_dt = h;
  sw_scene_set_time(s, t);
  const int adapts = isfinite(p->args->tolerance);
  if (moving > 0) tell_trembling(s, h, adapts ? h : p->args->dt, moving);
  if (landed > 0 && !adapts) tell_landing(s, p->args->dt, landed);
}

/* Counts a part h of a step `whole`. SW_ELIMIT: steps have collapsed. */
static sw_status count_small(sw_ladder *p, double h, double whole, sw_error *err) {
  const int adaptive = isfinite(p->args->tolerance);
  const size_t most = adaptive ? MOST_SMALL_ADAPTIVE : MOST_SMALL;
  sw_scene_course(p->s)->covered += h / whole;
  if (++sw_scene_course(p->s)->parts < most) return SW_OK;
  const double share = sw_scene_course(p->s)->covered / (double)most;
  sw_scene_course(p->s)->parts = 0, sw_scene_course(p->s)->covered = 0;
  if (share >= (adaptive ? SMALL_ADAPTIVE : SMALL)) return SW_OK;
  return sw_fail(
      err, SW_ELIMIT,
      "steps have collapsed: the last %zu were about %.2g s long, and dt is %.3g s%s%.200s", most,
      share * whole, whole, p->held.text[0] ? "; larger steps fail: " : "", p->held.text);
}

sw_status sw_step_observe(sw_scene *s, sw_error *err) {
  sw_scene_follow_holds(s);
  sw_jaw_follow(s);
  return sw_scene_observe(s, err);
}

sw_status sw_ladder_record(sw_ladder *p, double h, sw_error *err) {
  SW_TRY(sw_step_observe(p->s, err));
  sw_slip_tell(p->s, h);
  SW_TRY(sw_slip_check(p->s, err));
  if (sw_ledger_close(p->s) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for the energy of scene '%s'",
                   sw_scene_name(p->s));
  return count_small(p, h, p->args->dt, err);
}
