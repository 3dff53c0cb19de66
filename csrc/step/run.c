/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running: steps to a given time, with retries, contact review, observation. */
#include "step/run.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"
#include "step/believe.h"
#include "step/blow.h"
#include "step/energy.h"
#include "step/jaw.h"
#include "step/passing.h"
#include "step/rest.h"
#include "step/restart.h"
#include "step/run_check.h"
#include "step/slip.h"

/* Rebounds closer than this share of a step are one [-]. */
static const double SAME_TIME = 1.0 / 1024;
static const double SAME_TIME_CONTROLLED = 1.0 / 4; /* of the longest, in steps by tolerance [-] */
enum { MOST_CUTS = 8 };   /* at rebounds, of a step: what rattles is followed no further [-] */
enum { MOST_REDOS = 40 }; /* impacts found one after another in one step [-] */
static const double SMALLEST_SHARE = 1.0 / 4096; /* of a step, before giving up [-] */

/* How a step that made energy is redone where something touches: by the method's start, which takes
 * no acceleration from before and is of second order too; then with implicit Euler, which makes
 * none but where touches go wrong. What a method makes by itself a smaller step mends. */
enum { AS_IS, BY_START, DULLY, GIVE_UP };

/* So many parts of less than this share of their step in the mean are no way to go on: the
 * run stops and says what holds it back [-]. Adaptive steps may be as small as they like for
 * longer. */
enum { MOST_SMALL = 20000, MOST_SMALL_ADAPTIVE = 20000 };
static const double SMALL = 1.0 / 512, SMALL_ADAPTIVE = 2e-5;

typedef struct loop {
  sw_scene *s;
  const sw_run_args *args;
  sw_run_report *report;
  double *v_start; /* velocities at the step's start, which impacts change */
  int redo;        /* AS_IS, or how the step is redone, for it made energy */
  double soonest;  /* a rebound asks the step to end then, after its start; 0 = none does [s] */
  int cuts;        /* of this step, at rebounds [-] */
  sw_error held;   /* what the last rejected part was rejected for */
  int smooth;      /* 1: the step that was rejected last made energy where nothing touches */
  int changed;     /* 1: the scene was, since the last step: its energy is not judged */
  int (*interrupted)(void);
  sw_observer *observer; /* or NULL */
} loop;

static sw_status use_integrator(sw_scene *s, const sw_run_args *args, sw_error *err) {
  const sw_integrator *m = sw_integrator_all()[args->integrator];
  if (s->has_stepper && s->method == m) return SW_OK;
  sw_stepper_free(&s->stepper);
  s->has_stepper = 0;
  if (sw_stepper_new(&s->stepper, m, &s->system) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", s->name);
  s->has_stepper = 1;
  s->method = m;
  if (s->discontinuous == SW_GOES_ON) s->stepper.restart = 0;
  return SW_OK;
}

/* A hold may turn by this much in a step: at half a turn and more its wire would not know
 * which way [rad]. */
static const double WIDEST_TURN = 2.5;

/* Steps are cut down to this share of dt to find the moment at which a tie breaks [-]. */
static const double SHORTEST_BREAK = 1.0 / 1024;

static sw_status trial(loop *p, double h, sw_error *err) {
  sw_scene *s = p->s;
  sw_status status = sw_stepper_trial(&s->stepper, &s->system, s->time, h, err);
  p->report->iterations += s->stepper.iterations;
  if (status == SW_OK && !s->stepper.plastic && sw_rails_struck(&s->system)) {
    sw_stepper_reject(&s->stepper, &s->system);
    s->stepper.plastic = s->stepper.restart = 1; /* what strikes does not bounce */
    return trial(p, h, err);
  }
  if (status == SW_OK) status = sw_scene_check_trial(s, err);
  if (status == SW_OK && s->system.fastest_turn * h > WIDEST_TURN)
    status = sw_fail(err, SW_ENOCONV, "what holds a wire turns too far in one step");
  if (status == SW_OK && s->join_count + s->force_count > 0 && h > SHORTEST_BREAK * p->args->dt)
    status = sw_scene_check_ties(s, s->stepper.trial_x, err);
  if (status != SW_OK) sw_stepper_reject(&s->stepper, &s->system);
  return status;
}

/* The shortest part of a step that may end at a rebound [s]. */
static double shortest_cut(const loop *p) {
  if (isfinite(p->args->tolerance)) return SAME_TIME_CONTROLLED * p->args->dt;
  return p->cuts < MOST_CUTS ? SAME_TIME * p->args->dt : HUGE_VAL;
}

/* One step of size h, redone as long as contact finds impacts. */
static sw_status attempt(loop *p, double h, sw_error *err) {
  sw_scene *s = p->s;
  if (s->discontinuous > 0) s->stepper.restart = 1;
  s->stepper.plastic = p->redo == DULLY;
  p->soonest = 0;
  if (p->redo == BY_START) s->stepper.restart = 1;
  if (!sw_scene_has_contact(s)) return trial(p, h, err);
  memcpy(p->v_start, s->system.v, s->system.freedoms * sizeof(double));
  sw_status status = sw_scene_begin_contact(
      s, s->method->flags & SW_INTEGRATOR_IMPLICIT ? SW_CONTACT_IMPLICIT : SW_CONTACT_EXPLICIT,
      s->time, h, sw_blow_part(s, p->args->dt), err);
  if (s->contact) sw_contact_cut(s->contact, shortest_cut(p));
  for (int redo = 0; status == SW_OK && redo < MOST_REDOS; redo++) {
    status = trial(p, h, err);
    if (status != SW_OK) break;
    const sw_contact_verdict verdict =
        sw_scene_review_contact(s, s->stepper.trial_x, s->stepper.trial_v, h);
    if (verdict == SW_CONTACT_ACCEPT) return SW_OK;
    if (verdict == SW_CONTACT_STRIKE) s->stepper.plastic = 1;
    sw_stepper_reject(&s->stepper, &s->system);
    if (verdict == SW_CONTACT_SOONER) {
      p->soonest = sw_contact_soonest(s->contact);
      status = sw_fail(err, SW_ENOCONV, "something rebounds within the step");
      break;
    }
    if (verdict == SW_CONTACT_SMALLER)
      status = sw_fail(err, SW_ENOCONV, "what the wire touches cuts too deep into it");
    s->stepper.restart = 1;
  }
  memcpy(s->system.v, p->v_start, s->system.freedoms * sizeof(double));
  return status != SW_OK ? status
                         : sw_fail(err, SW_ENOCONV, "impacts do not come to an end in one step");
}

/* Forget a trial that went well. */
static void undo(loop *p) {
  sw_scene *s = p->s;
  sw_stepper_reject(&s->stepper, &s->system);
  if (sw_scene_has_contact(s)) memcpy(s->system.v, p->v_start, s->system.freedoms * sizeof(double));
}

enum { MOST_SLIP_TRIALS = 25 };

/* A first step after a jump knows no accelerations, and its reactions are off by their own
 * size, by which slips would be wrong: it is kept to this share [-]. */
static const double FIRST_SLIP = 1e-3;

/* One step of size h in which jaws close with a force. */
static sw_status squeezing_attempt(loop *p, double h, sw_error *err) {
  sw_scene *s = p->s;
  const int squeezes = sw_jaw_begin(s, h);
  for (;;) {
    const sw_status status = attempt(p, h, err);
    if (status != SW_OK || !squeezes || sw_jaw_correct(s, 0)) return status;
    undo(p);
  }
}

/* One step of size h in which feeds slip that yield to a force. */
static sw_status yielding_attempt(loop *p, double h, sw_error *err) {
  sw_scene *s = p->s;
  if (!sw_slip_begin(s)) return squeezing_attempt(p, h, err);
  for (int i = 0; i < MOST_SLIP_TRIALS; i++) {
    const sw_status status = squeezing_attempt(p, h, err);
    if (status != SW_OK) {
      sw_slip_give_up(s);
      return status;
    }
    if (sw_slip_correct(s, h, i == 0)) return SW_OK;
    undo(p);
    if (sw_feed_step(s, h) < h) break; /* further than nodes can follow */
  }
  sw_slip_give_up(s);
  return sw_fail(err, SW_ENOCONV, "the speed at which a feed slips was not found");
}

static sw_status judge(loop *p, double h, double *excess, sw_error *err) {
  sw_scene *s = p->s;
  const sw_status status = sw_ledger_judge(s, s->time + h, h, p->changed, err);
  *excess = p->changed || status != SW_OK ? 0.0 : sw_ledger_excess(s, h, p->args->dt);
  if (status != SW_OK) undo(p);
  return status;
}

/* What to try after a step that made energy, tried as it is now. Where nothing touches only a
 * smaller one helps, and what is known at its start stays so. */
static int next_redo(loop *p) {
  const sw_stepper *stepper = &p->s->stepper;
  p->smooth = !p->s->books.step.touching;
  if (p->smooth) return GIVE_UP;
  if (p->redo == AS_IS && stepper->start != stepper->method && !stepper->restart) return BY_START;
  return p->redo < DULLY ? DULLY : GIVE_UP;
}

/* One step of size h, and the referee: a step that makes energy is redone. SW_ENOCONV: it makes
 * some all the same. smallest: it is then taken as it is, and counted. */
static sw_status judged_attempt(loop *p, double h, int smallest, sw_error *err) {
  sw_scene *s = p->s;
  sw_ledger *l = &s->books.sums;
  double excess;
  p->smooth = 0;
  SW_TRY(sw_ledger_open(s, err));
  if (p->interrupted && p->interrupted()) return SW_EINTR;
  for (p->redo = AS_IS;;) {
    SW_TRY(yielding_attempt(p, h, err));
    if (p->interrupted && p->interrupted()) { /* of many nodes each part takes its time */
      undo(p);
      return SW_EINTR;
    }
    SW_TRY(judge(p, h, &excess, err));
    if (!(excess > 0)) return SW_OK;
    const int next = next_redo(p);
    if (next == GIVE_UP && smallest) {
      sw_ledger_retry(s, &l->accepted, s->time, excess);
      return SW_OK;
    }
    if (p->redo == AS_IS) sw_ledger_retry(s, &l->redone, s->time, excess);
    if (next == GIVE_UP) sw_ledger_retry(s, &l->halved, s->time, excess);
    undo(p);
    if (next == GIVE_UP) return sw_fail(err, SW_ENOCONV, "the step makes energy from nowhere");
    p->redo = next;
  }
}

/* Accelerations at a step's end may be those of a shock that is over: the next step starts without
 * them, or it pushes with them for half of it and makes energy. A starting step gives no estimate
 * of its error. */
static int is_shaken(const sw_scene *s) {
  const sw_stepper *stepper = &s->stepper;
  if (!s->contact || stepper->wants_error || stepper->start == stepper->method) return 0;
  return sw_contact_shaken(s->contact, &s->system);
}

static void accept(loop *p, double h) {
  sw_scene *s = p->s;
  sw_stepper_accept(&s->stepper, &s->system, h);
  s->system.judged = s->stepper.trial_x;
  sw_scene_commit_contact(s);
  if (is_shaken(s)) s->stepper.restart = 1;
  s->span = h;
  if (s->method->flags & SW_INTEGRATOR_NO_CONTACT) sw_scene_remark_contact(s);
  s->discontinuous = p->changed = 0;
  p->report->steps++;
  if (h < p->report->smallest_dt) p->report->smallest_dt = h;
}

/* A part h of a step that was to be whole is taken. SW_ELIMIT: steps have collapsed. */
static sw_status count_small(loop *p, double h, double whole, sw_error *err) {
  const int adaptive = isfinite(p->args->tolerance);
  const size_t most = adaptive ? MOST_SMALL_ADAPTIVE : MOST_SMALL;
  p->s->covered += h / whole;
  if (++p->s->parts < most) return SW_OK;
  const double share = p->s->covered / (double)most;
  p->s->parts = 0, p->s->covered = 0;
  if (share >= (adaptive ? SMALL_ADAPTIVE : SMALL)) return SW_OK;
  return sw_fail(
      err, SW_ELIMIT,
      "steps have collapsed: the last %zu were about %.2g s, of %.3g s asked for%s%.200s", most,
      share * whole, whole, p->held.text[0] ? "; larger ones fail, for " : "", p->held.text);
}

sw_status sw_step_observe(sw_scene *s, sw_error *err) {
  sw_scene_follow_holds(s);
  sw_jaw_follow(s);
  return sw_scene_observe(s, err);
}

static sw_status observe(sw_scene *s, sw_error *err) {
  SW_TRY(sw_step_observe(s, err));
  if (sw_ledger_close(s) == SW_OK) return SW_OK;
  return sw_fail(err, SW_ENOMEM, "out of memory for the energy of scene '%s'", s->name);
}

/* Errors that a smaller step cannot mend. */
static int hopeless(sw_status status) {
  return status == SW_ECALLBACK || status == SW_ENOMEM || status == SW_EINVAL ||
         status == SW_EEMPTY || status == SW_EINTR || status == SW_ELIMIT;
}

/* Nodes for the wire that a step up to h feeds; shortens the step to what nodes can
 * follow. The system may be a new one afterwards. */
static sw_status make_room(loop *p, double *h, sw_error *err) {
  sw_scene *s = p->s;
  int changed;
  const sw_counters before = s->system.counters;
  const int fresh = s->discontinuous > 0 || s->stepper.restart; /* nodes alone are no jump */
  *h = sw_feed_step(s, *h);
  SW_TRY(sw_feed_make_room(s, s->time + *h, &changed, err));
  if (!changed) return SW_OK;
  sw_ledger_forget(s);
  s->system.counters = before;
  SW_TRY(use_integrator(s, p->args, err));
  s->stepper.wants_error = isfinite(p->args->tolerance);
  s->discontinuous = s->stepper.restart = fresh;
  sw_free(p->v_start);
  p->v_start = sw_alloc(sw_scene_has_contact(s) ? s->system.freedoms : 1, sizeof(double));
  return p->v_start ? SW_OK : sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", s->name);
}

/* Parts end with their step: the difference of two times is known to no more than so much of a
 * part, and what that leaves is no part [-]. */
static const double ROUNDING = 1e-6;

/* Advance by h, in smaller parts where needed. t1 is the exact end time. */
static sw_status step(loop *p, double h, double t1, sw_error *err) {
  sw_scene *s = p->s;
  const double t0 = s->time;
  double done = 0, part = h;
  sw_error failed = {""}; /* why a part of this step was refused last */
  int starts = s->discontinuous && sw_slip_any(s), cut = 0; /* cut: at a rebound */
  p->cuts = 0;
  if (starts) part = FIRST_SLIP * h;
  p->changed = s->discontinuous > 0;
  while (done < h) {
    const double left = h - done;
    part = sw_blow_part(s, part);
    if (part > left * (1 - ROUNDING)) part = left;
    if (done > 0 && p->interrupted && p->interrupted()) return SW_EINTR; /* there may be many */
    SW_TRY(make_room(p, &part, err));
    if ((s->jerks = sw_scene_jerks(s))) s->stepper.restart = 1;
    if (!(part >= SMALLEST_SHARE * SMALLEST_SHARE * h))
      return sw_feed_too_fast(s, failed.text, err);
    const sw_status status = judged_attempt(p, part, 0.5 * part < SMALLEST_SHARE * h, err);
    if (status == SW_OK && sw_blow_begins(s, part)) { /* not refused: it only told of the blow */
      undo(p);
      continue;
    }
    const double over = status == SW_OK ? sw_passing_of(s, s->stepper.trial_x) : 0;
    if (sw_passing_part(part, over) < part) { /* nor is this */
      undo(p);
      part = sw_passing_part(part, over);
      continue;
    }
    if (status == SW_OK) {
      done += part;
      accept(p, part);
      s->time = done < h ? t0 + done : t1;
      if (p->redo != AS_IS) sw_blow_refused(s, part);
      SW_TRY(observe(s, err));
      SW_TRY(count_small(p, part, p->args->dt, err));
      part = starts || cut ? h : over > 0.5 ? part : 2 * part;
      starts = cut = 0;
      continue;
    }
    if (hopeless(status)) return status;
    failed = *err;
    p->report->rejected++;
    p->held = *err;
    cut = p->soonest > 0;
    p->cuts += cut;
    if (!cut) sw_blow_refused(s, part);
    if (!p->smooth && !cut) s->discontinuous = 1;
    part = cut ? p->soonest : 0.5 * part;
    if (part < SMALLEST_SHARE * h) return status;
  }
  return SW_OK;
}

/* An adaptive step of at most `left`; refuses steps whose error is too large. */
static sw_status controlled_step(loop *p, double left, double t1, sw_error *err) {
  sw_scene *s = p->s;
  const double tolerance = p->args->tolerance, most = fmin(p->args->dt, left);
  double h = s->next_dt > 0 ? fmin(s->next_dt, most) : 0.1 * most;
  SW_TRY(make_room(p, &h, err));
  if ((s->jerks = sw_scene_jerks(s))) s->stepper.restart = 1;
  p->changed = s->discontinuous > 0;
  for (double uncut = 0;;) { /* uncut: the step that was cut at a rebound [s] */
    const int last = h >= left * (1 - 1e-9);
    const sw_status status =
        judged_attempt(p, h, 0.25 * h < SMALLEST_SHARE * SMALLEST_SHARE * p->args->dt, err);
    if (hopeless(status)) return status;
    const int fine = status == SW_OK && s->stepper.error <= tolerance;
    double next = status == SW_OK ? sw_stepper_next_h(&s->stepper, h, tolerance) : 0.25 * h;
    if (fine) {
      const int unknown = !(s->stepper.error > 0); /* a starting step gives no estimate */
      accept(p, h);
      const double before = s->time;
      s->time = last ? t1 : s->time + h;
      if (!(s->time > before)) return sw_fail(err, SW_ENOCONV, "steps of %g s are no time", h);
      s->next_dt = uncut > 0          ? uncut
                   : unknown          ? h
                   : last && next > h ? fmax(next, s->next_dt)
                                      : next;
      SW_TRY(observe(s, err));
      return count_small(p, h, p->args->dt, err);
    }
    if (status == SW_OK) undo(p);
    if (status != SW_OK) p->held = *err;
    if (status != SW_OK && p->soonest > 0) uncut = h, next = p->soonest;
    p->report->rejected++;
    h = fmin(next, 0.9 * h);
    if (h < SMALLEST_SHARE * SMALLEST_SHARE * p->args->dt)
      return status != SW_OK ? status
                             : sw_fail(err, SW_ENOCONV, "the tolerance needs steps below %g s", h);
  }
}

/* Slow handling: equilibria up to time t, in parts that nodes can follow where wire is fed. */
static sw_status pose_steps(loop *p, double t, int (*interrupted)(void), sw_error *err) {
  sw_scene *s = p->s;
  while (s->time < t) {
    double h = t - s->time;
    if (interrupted && interrupted()) return SW_EINTR;
    SW_TRY(make_room(p, &h, err));
    const double part = h < (t - s->time) * (1 - 1e-9) ? s->time + h : t;
    if (!(part > s->time)) return sw_fail(err, SW_ENOCONV, "wire is fed too fast to follow it");
    SW_TRY(sw_ledger_open(s, err));
    const sw_pose_args how = {interrupted, SHORTEST_BREAK * p->args->dt};
    SW_TRY(sw_scene_pose(s, part, &how, p->report, err));
    s->span = 0;
    SW_TRY(sw_step_observe(s, err));
  }
  return SW_OK;
}

static const double MOST_TURN_PARTS = 1e4;

/* And in parts in which holds turn by less than half a turn. */
static sw_status whole_pose_step(loop *p, double t1, int (*interrupted)(void), sw_error *err) {
  sw_system *system = &p->s->system;
  const double t0 = p->s->time;
  system->fastest_turn = 0;
  SW_TRY(sw_system_place_holds(system, 0.5 * (t0 + t1), NULL, NULL, NULL, err));
  SW_TRY(sw_system_place_holds(system, t1, NULL, NULL, NULL, err));
  const double turn = system->fastest_turn * (t1 - t0);
  if (turn > MOST_TURN_PARTS * WIDEST_TURN)
    return sw_fail(err, SW_EDIVERGED, "what holds a wire turns by %g rad between two poses", turn);
  const int parts = 1 + (int)(turn / WIDEST_TURN);
  for (int part = 1; part <= parts; part++)
    SW_TRY(pose_steps(p, part < parts ? t0 + (t1 - t0) * part / parts : t1, interrupted, err));
  p->report->steps++;
  return SW_OK;
}

/* The next frame is due after t; frames that steps have passed are left out. */
static void next_frame(sw_scene *s, double every, double t) {
  every *= (double)s->frame_stride;
  if (s->next_frame <= t) s->next_frame += every;
  if (s->next_frame <= t) s->next_frame += every * ceil((t - s->next_frame) / every);
  if (!(s->next_frame > t)) s->next_frame = nextafter(t, HUGE_VAL);
}

static sw_status run_loop(loop *p, double until, int (*interrupted)(void), sw_error *err) {
  sw_scene *s = p->s;
  const double t0 = s->time, span = until - t0;
  const double count = fmax(1.0, ceil(span / p->args->dt - 1e-9));
  if (span > 0 && span < SW_SHORTEST_STEP) s->time = until;
  const int adaptive = isfinite(p->args->tolerance);
  s->stepper.wants_error = adaptive;
  const double slack = 1e-12 * fmax(fabs(until), span);
  const size_t first = p->report->steps;
  for (size_t k = 1; s->time < until - slack;) {
    if (interrupted && interrupted()) return SW_EINTR;
    if ((double)(p->report->steps - first) >= (double)p->args->max_steps) return SW_OK;
    if (p->report->steps > first && (sw_tool_slipped(s) || sw_hold_crashed(s))) return SW_OK;
    double t1 = (double)k >= count ? until : t0 + span * ((double)k / count);
    int cut = 0;
    if (p->args->quasistatic) SW_TRY(sw_scene_cut_pose(s, &t1, &cut, err));
    if (!cut) k++;
    SW_TRY(p->args->quasistatic ? whole_pose_step(p, t1, interrupted, err)
           : adaptive           ? controlled_step(p, until - s->time, until, err)
                                : step(p, t1 - s->time, t1, err));
    if (isfinite(p->args->frame) && s->time >= s->next_frame - slack)
      SW_TRY(sw_scene_store_frame(s, err));
    if (isfinite(p->args->frame)) next_frame(s, p->args->frame, s->time + slack);
    if (p->observer) {
      SW_TRY(sw_scene_look(s, p->observer, slack, err));
      if (p->observer->stop) return SW_OK;
    }
  }
  return SW_OK;
}

static void conclude(sw_scene *s, sw_status status, sw_run_report *report, const sw_error *why) {
  char broken[SW_NAME_SIZE + 100], pressed[2 * SW_NAME_SIZE + 100];
  report->status = status;
  report->time = s->time;
  if (status == SW_OK || status == SW_EINTR || status == SW_ECALLBACK) return;
  if (status == SW_EEMPTY) report->reason = *why; /* all is well up to here */
  if (status == SW_EEMPTY) return;
  report->status = status == SW_ENOMEM ? SW_ENOMEM : SW_EDIVERGED;
  sw_scene_tell_broken(s, broken, sizeof broken);
  sw_scene_tell_pressed(s, pressed, sizeof pressed);
  sw_fail(&report->reason, status, "at t = %.6g s: %.400s%s%s", s->time,
          why->text[0] ? why->text : sw_status_text(status), pressed, broken);
  if (report->status != SW_EDIVERGED) return;
  s->diverged = 1;
  s->why = report->reason;
}

sw_status sw_scene_begin_run(sw_scene *s, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err)); /* a run without steps would not notice */
  sw_scene_reset_extremes(s);
  sw_events_clear(&s->events);
  sw_ledger_begin_run(s);
  s->parts = 0, s->covered = 0;
  return SW_OK;
}

sw_status sw_scene_advance(sw_scene *s, const sw_run_args *args, double until,
                           int (*interrupted)(void), sw_observer *observer, sw_run_report *report,
                           sw_error *err) {
  sw_error why = {""}, ignored;
  *report = (sw_run_report){.smallest_dt = HUGE_VAL, .time = s->time};
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_run_check(s, args, err));
  SW_TRY(sw_run_check_clock(s, args, until, err));
  SW_TRY(sw_scene_build(s, err));
  SW_TRY(sw_scene_check_step(s, args, until, err));
  SW_TRY(use_integrator(s, args, err));
  s->window = args->window;
  const sw_counters before = s->system.counters;
  loop p = {
      .s = s, .args = args, .report = report, .interrupted = interrupted, .observer = observer};
  p.v_start = sw_alloc(sw_scene_has_contact(s) ? s->system.freedoms : 1, sizeof(double));
  if (!p.v_start) return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", s->name);
  s->running++;
  sw_ledger_forget(s);
  sw_status status = /* energies need it */
      sw_system_place_holds(&s->system, s->time, NULL, NULL, NULL, &why);
  if (status == SW_OK && isfinite(args->frame) && s->frame_count == 0) {
    status = sw_scene_store_frame(s, &why);
    s->next_frame = s->time + args->frame * (double)s->frame_stride;
  }
  if (status == SW_OK) status = run_loop(&p, until, interrupted, &why);
  s->running--;
  s->system.judged = NULL;
  if (status == SW_OK && !args->quasistatic) status = sw_scene_look_for_buckling(s, &why);
  sw_free(p.v_start);
  /* the last good state, for pictures of what went wrong */
  if (status == SW_ENOCONV && isfinite(args->frame) && s->frame_count &&
      s->time > s->frames[s->frame_count - 1].time)
    (void)sw_scene_store_frame(s, &ignored);
  report->evaluations = s->system.counters.evaluations - before.evaluations;
  report->solves = s->system.counters.solves - before.solves;
  report->looks = s->system.counters.looks - before.looks;
  conclude(s, status, report, &why);
  if (status == SW_ECALLBACK) s->discontinuous = 1;
  return SW_OK;
}

sw_status sw_scene_stable_dt(sw_scene *s, double *dt, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_build(s, err));
  *dt = sw_system_stable_dt(&s->system);
  return SW_OK;
}
