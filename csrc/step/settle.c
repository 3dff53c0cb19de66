/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene:settle: the equilibrium at the scene's time. */
#include "body/build.h"
#include "mutual/relief.h"
#include "read/extremes.h"
#include "save/life.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "step/jaw.h"
#include "step/rest.h"
#include "step/run.h"
#include "step/slip.h"
#include "watch/observe.h"

static const sw_param rows[] = {
    {"tolerance", SW_PARAM_NUMBER, "m", 1e-9, 0, 1, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_settle_args, tolerance),
     "largest shift of a node in the last iteration (or quantities, see help 'tolerance')"},
    {"max_iterations", SW_PARAM_INTEGER, "-", 4000, 1, 1e9, 0, NULL,
     offsetof(sw_settle_args, max_iterations), "most matrix solves in each part of a hold's path"},
};
const sw_params sw_settle_params = SW_PARAMS("scene:settle", rows);

static void conclude(sw_scene *s, sw_status status, sw_settle_report *report, const sw_error *why) {
  report->ok = status == SW_OK;
  if (status != SW_OK)
    sw_fail(&report->reason, status, "%.400s", why->text[0] ? why->text : sw_status_text(status));
  if (status != SW_OK) sw_course_jump(sw_scene_course(s));
}

enum { MOST_ROUNDS = 100 };

sw_status sw_scene_held_rest(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                             sw_settle_report *report, sw_error *err) {
  if (!sw_jaw_begin_rest(s))
    return sw_scene_rest(s, sw_scene_time(s), NULL, args, interrupted, report, err);
  for (int round = 1;; round++) {
    const sw_status status =
        sw_scene_squeezed_rest(s, sw_scene_time(s), NULL, args, interrupted, report, err);
    const int more = sw_jaw_end_rest(s, status == SW_OK);
    if (status != SW_OK || !more || round == MOST_ROUNDS) return status;
    sw_jaw_follow(s);
    if (!sw_jaw_begin_rest(s)) return SW_OK;
  }
}

/* Finds the equilibrium in which feeds have the forces that they obey. If there is none, feeds are
 * locked where they were. */
static sw_status settle_feeds(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                              sw_settle_report *report, sw_error *err) {
  sw_snapshot *before = NULL;
  int lost = 0;
  SW_TRY(sw_scene_snapshot(s, &before, err));
  sw_scene_enter(s, 1);
  sw_status status = sw_scene_yielded_rest(s, args, interrupted, &lost, report, err);
  sw_scene_enter(s, -1);
  if (lost || status == SW_ENOCONV) {
    const sw_settle_report seeking = *report;
    *report = (sw_settle_report){0};
    status = sw_scene_restore(s, before, err);
    if (status == SW_OK) status = sw_scene_build(s, err);
    sw_scene_enter(s, 1);
    if (status == SW_OK) status = sw_scene_clamped_rest(s, args, interrupted, report, err);
    sw_scene_enter(s, -1);
    report->iterations += seeking.iterations;
  }
  sw_snapshot_free(before);
  return status;
}

static sw_status settle_once(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                             sw_settle_report *report, sw_error *err) {
  if (sw_slip_any(s)) return settle_feeds(s, args, interrupted, report, err);
  sw_scene_enter(s, 1);
  const sw_status status = sw_scene_held_rest(s, args, interrupted, report, err);
  sw_scene_enter(s, -1);
  return status;
}

/* Friction of clips follows from the push in the state before. The wires come to rest again until
 * friction and push agree. */
static sw_status settle(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                        sw_settle_report *report, sw_error *err) {
  sw_settle_report sum = {0};
  for (int round = 1;; round++) {
    sw_error why = {""};
    *report = (sw_settle_report){0};
    const sw_status status = settle_once(s, args, interrupted, report, &why);
    report->iterations += sum.iterations;
    report->transient |= sum.transient, report->jumped |= sum.jumped;
    sum = *report;
    if (status == SW_ENOCONV && round > 1)
      return sw_fail(err, status, "friction of clips does not hold the wires: %.300s", why.text);
    if (status != SW_OK) return sw_fail(err, status, "%s", why.text);
    if (!sw_rest_catch_up(s, 0)) return SW_OK;
    if (round == MOST_ROUNDS)
      return sw_fail(err, SW_ENOCONV, "friction of clips changes with every search for rest");
  }
}

/* Share of a tension that the depth of touches between wires may take [-]. */
static const double SUNK = 0.01;

/* Wires that are drawn taut while they are in each other lose tension. They come to rest again with
 * less depth. This is a second search because loose wires that hang on each other do not come to
 * rest with it; if the taut ones do not either, the scene stays as it was. */
static sw_status settle_tight(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                              sw_settle_report *report, sw_error *err) {
  const sw_mutual *pairs = sw_scene_pairs(s);
  if (!pairs || !sw_mutual_is_sunk(pairs, sw_scene_system(s), SUNK)) return SW_OK;
  sw_settle_args tight = *args;
  sw_settle_report first = *report;
  sw_snapshot *before = NULL;
  sw_error why = {""};
  tight.tight = 1;
  SW_TRY(sw_scene_snapshot(s, &before, err));
  sw_status status = settle(s, &tight, interrupted, report, &why);
  report->iterations += first.iterations;
  if (status == SW_ENOCONV) {
    first.iterations = report->iterations, *report = first;
    status = sw_scene_restore(s, before, &why);
    if (status == SW_OK) status = sw_scene_build(s, &why);
  }
  sw_snapshot_free(before);
  return status == SW_OK ? SW_OK : sw_fail(err, status, "%s", why.text);
}

sw_status sw_scene_settle(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                          sw_settle_report *report, sw_error *err) {
  sw_error why = {""};
  *report = (sw_settle_report){0};
  SW_TRY(sw_scene_ready(s, err));
  if (!sw_scene_wire_slots(s))
    return sw_fail(err, SW_EINVAL, "scene '%s': there is no wire", sw_scene_name(s));
  SW_TRY(sw_scene_build(s, err));
  SW_TRY(sw_system_place_holds(sw_scene_system(s), sw_scene_time(s), NULL, NULL, NULL, err));
  sw_scene_watch_rolls(s, 0);
  sw_status status = settle(s, args, interrupted, report, &why);
  if (status == SW_OK) status = settle_tight(s, args, interrupted, report, &why);
  sw_scene_reset_extremes(s);
  sw_scene_course(s)->span = 0;
  if (status == SW_OK && report->jumped) status = sw_scene_watch_leap(s, &why);
  if (status == SW_OK) status = sw_step_observe(s, &why);
  if (status == SW_OK) sw_yield_tell(s);
  if (status == SW_OK) status = sw_scene_watch_sunk(s, &why);
  if (status == SW_OK) sw_scene_end_sunk(s);
  conclude(s, status, report, &why);
  return status == SW_ECALLBACK || status == SW_ENOMEM ? sw_fail(err, status, "%s", why.text)
                                                       : SW_OK;
}
