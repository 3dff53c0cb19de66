/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria between jaws that obey a force: repeated with other openings until the force is as
 * wanted. */
#include <math.h>

#include "base/alloc.h"
#include "body/live.h"
#include "grip/jaws.h"
#include "scene/course.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "step/jaw.h"
#include "step/rest.h"

enum { MOST_ROUNDS = 4 }; /* searches for a force, each from where it jumped [-] */

typedef struct poser {
  sw_scene *s;
  const sw_settle_args *args;
  int (*interrupted)(void);
  sw_settle_report *report;
  sw_tape start;  /* state with which all trials begin */
  int next;       /* course->next at that state */
  sw_jaw *before; /* (tools) at the start of the pose */
  double *speed;  /* (tools) speeds of jaws in the trial that came nearest [m/s] */
  double *loses;  /* (tools) speeds with which they lost their wire; NAN: they did not [m/s] */
  int rests;      /* see sw_jaw_correct */
  double nearest; /* deviation of its force; INFINITY = no trial converged [-] */
} poser;

/* Deviation from the wanted force above which jaws rather let go of a wire that slips from them as
 * soon as they open, over that force [-]. */
static const double FAR = 0.5;

/* Returns the deviation of the jaws' force, over the wanted one; 0 for jaws that do not keep one
 * [-]. */
static double deviation(sw_scene *s, const sw_tool *t) {
  const sw_jaw *j = &t->jaw;
  if (!t->alive || t->frozen || j->mode != SW_JAW_FORCE || j->status != SW_JAW_HOLDS) return 0;
  return sw_tool_squeeze(s, t, sw_scene_time(s)) / j->force - 1.0;
}

static void note_speeds(poser *p) {
  for (size_t k = 0; k < sw_scene_tool_slots(p->s); k++)
    p->speed[k] = sw_scene_tool_in(p->s, k)->jaw.speed;
}

static sw_status try(poser *p, double since, int *too_far, sw_error *err) {
  sw_settle_report trial = {0};
  sw_scene_course(p->s)->next = p->next;
  const sw_status status =
      sw_scene_rest(p->s, since, too_far, p->args, p->interrupted, &trial, err);
  trial.iterations += p->report->iterations;
  *p->report = trial;
  if (status != SW_OK) return status;
  for (size_t k = 0; k < sw_scene_tool_slots(p->s); k++) {
    const sw_tool *t = sw_scene_tool_in(p->s, k);
    if (deviation(p->s, t) <= -1.0) p->loses[k] = t->jaw.speed;
  }
  const double off = sw_jaw_off(p->s);
  if (off > p->nearest) return SW_OK;
  p->nearest = off;
  note_speeds(p);
  return SW_OK;
}

/* Repeats the trial that came nearest, because the last one did not come to rest. Without too_far
 * the wire could leave the pads in it. */
static sw_status fall_back(poser *p, double since, int *too_far, sw_error *err) {
  SW_TRY(sw_live_back(p->s, &p->start, err));
  for (size_t k = 0; k < sw_scene_tool_slots(p->s); k++)
    sw_scene_tool_in(p->s, k)->jaw.speed = p->speed[k];
  return try(p, since, too_far, err);
}

/* In poses: jaws whose force stays far too large, because a wire slips out of them as soon as they
 * open a little, let go of it. */
static sw_status let_go(poser *p, double since, sw_error *err) {
  const size_t n = sw_scene_tool_slots(p->s);
  sw_error why;
  int any = 0;
  note_speeds(p);
  for (size_t k = 0; k < n && p->rests == SW_JAW_POSES; k++)
    if (!isnan(p->loses[k]) && deviation(p->s, sw_scene_tool_in(p->s, k)) > FAR) any = 1;
  if (!any) return SW_OK;
  for (size_t k = 0; k < n; k++) {
    sw_tool *t = sw_scene_tool_in(p->s, k);
    if (!isnan(p->loses[k]) && deviation(p->s, t) > FAR) t->jaw.speed = p->loses[k];
  }
  SW_TRY(sw_live_back(p->s, &p->start, err));
  const sw_status status = try(p, since, NULL, &why);
  if (status == SW_ENOCONV) return fall_back(p, since, NULL, err);
  return status == SW_OK ? SW_OK : sw_fail(err, status, "%s", why.text);
}

/* Finds equilibria, all from one start, until the jaws have the wanted forces or cannot have them.
 * If it fails, the scene is at that start. */
static sw_status search(poser *p, double since, int *too_far, sw_error *err) {
  sw_error why;
  p->nearest = HUGE_VAL;
  for (size_t k = 0; k < sw_scene_tool_slots(p->s); k++) p->loses[k] = NAN;
  for (;;) {
    sw_status status = try(p, since, too_far, &why);
    if (status == SW_OK && sw_jaw_correct(p->s, p->rests)) return let_go(p, since, err);
    if (status == SW_ENOCONV && p->nearest < HUGE_VAL) {
      status = fall_back(p, since, too_far, &why);
      if (status == SW_OK) return let_go(p, since, err);
    }
    const sw_status back = sw_live_back(p->s, &p->start, err);
    if (status != SW_OK) return sw_fail(err, status, "%s", why.text);
    SW_TRY(back);
  }
}

/* Searches on from the place where the force jumped. If that finds nothing, the equilibrium
 * stays. */
static sw_status search_on(poser *p, sw_error *err) {
  for (int round = 1; round < MOST_ROUNDS && sw_jaw_again(p->s); round++) {
    sw_tape_free(&p->start);
    SW_TRY(sw_live_take(p->s, &p->start));
    p->next = sw_scene_course(p->s)->next;
    const sw_status status = search(p, sw_scene_time(p->s), NULL, err);
    if (status == SW_ENOCONV || status == SW_EINTR) {
      sw_jaw_end_rest(p->s, 0);
      break;
    }
    SW_TRY(status);
  }
  return SW_OK;
}

static sw_status prepare(poser *p) {
  const size_t n = sw_scene_tool_slots(p->s);
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(p->before, n), SW_ROOM(p->speed, n), SW_ROOM(p->loses, n)));
  p->next = sw_scene_course(p->s)->next;
  for (size_t k = 0; k < n; k++) p->before[k] = sw_scene_tool_in(p->s, k)->jaw;
  return sw_live_take(p->s, &p->start);
}

sw_status sw_scene_squeezed_rest(sw_scene *s, double since, int *too_far,
                                 const sw_settle_args *args, int (*interrupted)(void),
                                 sw_settle_report *report, sw_error *err) {
  poser p = {.s = s,
             .args = args,
             .interrupted = interrupted,
             .report = report,
             .rests = args->poses ? SW_JAW_POSES : SW_JAW_SETTLES};
  sw_status status = prepare(&p);
  if (status != SW_OK) sw_fail(err, status, "scene '%s': out of memory", sw_scene_name(s));
  if (status == SW_OK) status = search(&p, since, too_far, err);
  if (status == SW_OK) status = search_on(&p, err);
  for (size_t k = 0; status != SW_OK && p.before && k < sw_scene_tool_slots(s); k++)
    sw_scene_tool_in(s, k)->jaw = p.before[k];
  sw_tape_free(&p.start);
  sw_free(p.before);
  sw_free(p.speed);
  sw_free(p.loses);
  return status;
}
