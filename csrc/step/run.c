/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a scene: steps to a given time, frames and observers between them. */
#include "step/run.h"

#include <math.h>

#include "base/alloc.h"
#include "body/build.h"
#include "body/touching.h"
#include "grip/jaws.h"
#include "read/extremes.h"
#include "read/kept_frames.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/gripper.h"
#include "scene/lists.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/energy.h"
#include "step/ladder.h"
#include "step/rest.h"
#include "step/run_check.h"
#include "system/axial.h"
#include "system/system.h"
#include "watch/observe.h"

/* Sets the time of the next frame after t; skips frames that steps have passed. */
static void next_frame(sw_scene *s, double every, double t) {
  sw_frames *all = sw_scene_frames_of(s);
  every *= (double)all->stride;
  if (all->next <= t) all->next += every;
  if (all->next <= t) all->next += every * ceil((t - all->next) / every);
  if (!(all->next > t)) all->next = nextafter(t, HUGE_VAL);
}

/* Takes one step of the run's kind towards t1; with a tolerance, as long as its error allows. */
static sw_status one_step(sw_ladder *p, double t1, double until, sw_error *err) {
  const sw_scene *s = p->s;
  if (!sw_scene_wire_slots(s)) return sw_step_empty(p, t1, err);
  if (p->args->quasistatic) return sw_step_poses(p, t1, err);
  if (isfinite(p->args->tolerance))
    return sw_step_adaptive(p, until - sw_scene_time(s), until, err);
  return sw_step_fixed(p, t1 - sw_scene_time(s), t1, err);
}

static sw_status run_loop(sw_ladder *p, double until, int (*interrupted)(void), sw_error *err) {
  sw_scene *s = p->s;
  const double t0 = sw_scene_time(s), span = until - t0;
  const double count = fmax(1.0, ceil(span / p->args->dt - 1e-9));
  if (span > 0 && span < SW_SHORTEST_STEP) sw_scene_set_time(s, until);
  const double slack = 1e-12 * fmax(fabs(until), span);
  const size_t first = p->report->steps;
  double began = t0; /* start of the last step [s] */
  for (size_t k = 1; sw_scene_time(s) < until - slack;) {
    if (p->lost) return SW_OK;
    if (interrupted && interrupted()) return SW_EINTR;
    if ((double)(p->report->steps - first) >= (double)p->args->max_steps) return SW_OK;
    if (p->report->steps > first && (sw_tool_slipped(s, began) || sw_hold_crashed(s, began)))
      return SW_OK;
    double t1 = (double)k >= count ? until : t0 + span * ((double)k / count);
    int cut = 0;
    if (p->args->quasistatic && sw_scene_wire_slots(s))
      SW_TRY(sw_scene_cut_pose(s, &t1, &cut, err));
    began = sw_scene_time(s);
    SW_TRY(one_step(p, t1, until, err));
    SW_TRY(sw_scene_watch_sunk(s, err));
    SW_TRY(sw_scene_look_across(s, err));
    const int early = !p->args->quasistatic && sw_scene_time(s) < t1 - slack; /* jaws arrived */
    if (!cut && !early) k++;
    if (isfinite(p->args->frame) && sw_scene_time(s) >= sw_scene_frames_of(s)->next - slack)
      SW_TRY(sw_scene_store_frame(s, err));
    if (isfinite(p->args->frame)) next_frame(s, p->args->frame, sw_scene_time(s) + slack);
    if (p->observer) {
      SW_TRY(sw_scene_look(s, p->observer, slack, err));
      if (p->observer->stop) return SW_OK;
    }
  }
  return SW_OK;
}

static void conclude(sw_scene *s, const sw_run_args *args, sw_status status, sw_run_report *report,
                     const sw_error *why) {
  char broken[SW_NAME_SIZE + 100], pressed[2 * SW_NAME_SIZE + 150], used[SW_NAME_SIZE + 150] = "";
  report->status = status;
  report->time = sw_scene_time(s);
  if (status == SW_OK || status == SW_EINTR || status == SW_ECALLBACK) return;
  if (status == SW_EEMPTY) report->reason = *why; /* up to here the state is valid */
  if (status == SW_EEMPTY) return;
  report->status = status == SW_ENOMEM ? SW_ENOMEM : SW_EDIVERGED;
  sw_scene_tell_broken(s, broken, sizeof broken);
  sw_scene_tell_pressed(s, pressed, sizeof pressed);
  if (args->quasistatic) sw_scene_tell_used_up(s, used, sizeof used);
  sw_fail(&report->reason, status, "at t = %.6g s: %.400s%s%s%s", sw_scene_time(s),
          why->text[0] ? why->text : sw_status_text(status), used, used[0] ? "" : pressed, broken);
  if (report->status != SW_EDIVERGED) return;
  sw_scene_diverge(s, &report->reason);
}

/* Clears the records that forces on wires keep for one run. */
static void begin_forces(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  for (size_t w = 0; sw_scene_is_built(s) && w < system->body_count; w++)
    SW_ITEMS(const sw_term, term, system->bodies[w].terms, system->bodies[w].term_count)
      if (term->cls->begin_run && term->history) term->cls->begin_run(term->history);
}

sw_status sw_scene_begin_run(sw_scene *s, int wear, sw_error *err) {
  sw_course *course = sw_scene_course(s);
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err)); /* a run without steps would not notice it */
  sw_scene_reset_extremes(s);
  begin_forces(s);
  sw_scene_set_wears(s, wear);
  sw_events_clear(sw_scene_events_of(s));
  sw_ledger_begin_run(s);
  course->parts = 0, course->covered = 0;
  return SW_OK;
}

/* Notes the equilibrium from which slow handling starts: two clamps that approach have the largest
 * tension and the sharpest bend there. */
static sw_status note_start(sw_scene *s, sw_error *err) {
  sw_wire_extremes now;
  sw_scene_course(s)->span = 0;
  sw_system_refresh(sw_scene_system(s));
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++)
    if (!isfinite(sw_scene_wire_in(s, w)->extremes.raw.value)) /* nothing is noted in this run */
      SW_TRY(sw_scene_note_extremes(s, w, &now, err));
  return SW_OK;
}

/* Builds the scene and checks that it can be run like this. */
static sw_status prepare(sw_scene *s, const sw_run_args *args, double until, sw_error *err) {
  SW_TRY(sw_scene_ready(s, err));
  SW_TRY(sw_run_check(s, args, err));
  SW_TRY(sw_run_check_clock(s, args, until, err));
  SW_TRY(sw_scene_build(s, err));
  if (!args->quasistatic)
    SW_TRY(sw_scene_clear_meshes(s, err)); /* poses leave obstacles in one step */
  SW_TRY(sw_scene_check_step(s, args, until, err));
  SW_TRY(sw_ladder_method(s, args, err));
  sw_scene_course(s)->window = args->window;
  return SW_OK;
}

sw_status sw_scene_advance(sw_scene *s, const sw_run_args *args, double until,
                           int (*interrupted)(void), sw_observer *observer, sw_run_report *report,
                           sw_error *err) {
  sw_error why = {""}, ignored;
  *report = (sw_run_report){.smallest_dt = HUGE_VAL, .time = sw_scene_time(s)};
  SW_TRY(prepare(s, args, until, err));
  if (isfinite(args->frame)) sw_scene_reopen_frames(s);
  const sw_counters before = sw_scene_system(s)->counters;
  sw_ladder p = {.s = s,
                 .made_at = NAN,
                 .args = args,
                 .report = report,
                 .interrupted = interrupted,
                 .observer = observer,
                 .until = until};
  p.v_start = sw_alloc(sw_scene_has_contact(s) ? sw_scene_system(s)->freedoms : 1, sizeof(double));
  if (!p.v_start) return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  sw_scene_enter(s, 1);
  sw_ledger_forget(s);
  sw_status status = /* energies need the accelerations */
      sw_system_place_holds(sw_scene_system(s), sw_scene_time(s), NULL, NULL, NULL, &why);
  if (status == SW_OK) sw_scene_watch_rolls(s, 0);
  if (status == SW_OK) sw_system_begin_borne(sw_scene_system(s));
  if (status == SW_OK && isfinite(args->frame) && sw_scene_frames_of(s)->count == 0) {
    status = sw_scene_store_frame(s, &why);
    sw_scene_frames_of(s)->next =
        sw_scene_time(s) + args->frame * (double)sw_scene_frames_of(s)->stride;
  }
  if (status == SW_OK && (sw_scene_wears(s) || sw_scene_zones_of(s)->count))
    status = sw_scene_begin_watching(s, &why);
  if (sw_course_rests(sw_scene_course(s))) sw_yield_tell(s);
  if (status == SW_OK && args->quasistatic && sw_course_is_still(sw_scene_course(s)))
    status = note_start(s, &why);
  if (status == SW_OK) status = run_loop(&p, until, interrupted, &why);
  sw_scene_enter(s, -1);
  sw_scene_system(s)->judged = NULL;
  if (status == SW_OK && !args->quasistatic) status = sw_scene_look_for_buckling(s, &why);
  if (status == SW_OK) sw_scene_end_unbent(s);
  sw_free(p.v_start);
  /* stores the last good state, for pictures of the failure */
  if (status == SW_ENOCONV && isfinite(args->frame) && sw_scene_frames_of(s)->count &&
      sw_scene_time(s) > sw_scene_frames_of(s)->list[sw_scene_frames_of(s)->count - 1].time)
    (void)sw_scene_store_frame(s, &ignored);
  report->evaluations = sw_scene_system(s)->counters.evaluations - before.evaluations;
  report->solves = sw_scene_system(s)->counters.solves - before.solves;
  report->looks = sw_scene_system(s)->counters.looks - before.looks;
  conclude(s, args, status, report, &why);
  if (status == SW_ECALLBACK) sw_course_jump(sw_scene_course(s));
  return SW_OK;
}

sw_status sw_scene_stable_dt(sw_scene *s, double *dt, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_build(s, err));
  *dt = sw_system_stable_dt(sw_scene_system(s));
  return SW_OK;
}
