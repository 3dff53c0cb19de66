/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses: equilibria at the places of what drives the wires, one after another. Jaws that obey a
 * force are as open at each as it takes, found by repeating the pose from where it began. */
#include <math.h>

#include "base/alloc.h"
#include "scene/world.h"

enum { MOST_HALVINGS = 6 }; /* of a pose step [-] */

enum {
  FEW_ITERATIONS = 300
};                        /* of a trial: what needs more is sooner found in smaller steps [-] */
enum { MOST_ROUNDS = 4 }; /* of looking for a force from where it jumped to [-] */

typedef struct pose_start {
  sw_live live;
  sw_jaw *jaws; /* (tools) */
} pose_start;

typedef struct poser {
  sw_scene *s;
  const sw_settle_args *args;
  int (*interrupted)(void);
  sw_settle_report *report;
} poser;

static sw_status take(const sw_scene *s, pose_start *p) {
  p->jaws = sw_alloc(s->tool_count, sizeof *p->jaws);
  if (!p->jaws) return SW_ENOMEM;
  for (size_t k = 0; k < s->tool_count; k++) p->jaws[k] = s->tools[k].jaw;
  return sw_live_take(s, &p->live);
}

static void drop(pose_start *p) {
  sw_live_free(&p->live);
  sw_free(p->jaws);
}

/* One equilibrium after another, all from one start, until the jaws' forces are as wanted or known
 * not to be. On failure the scene is as at that start. */
static sw_status search(const poser *p, const sw_live *start, double since, int *too_far,
                        sw_error *err) {
  for (;;) {
    sw_settle_report trial = {0};
    sw_error ignored;
    const sw_status status =
        sw_scene_rest(p->s, since, too_far, p->args, p->interrupted, &trial, err);
    trial.iterations += p->report->iterations;
    *p->report = trial;
    if (status == SW_OK && sw_jaw_correct(p->s, 1)) return SW_OK;
    const sw_status back = sw_live_put(p->s, start, status == SW_OK ? err : &ignored);
    if (status != SW_OK) return status;
    SW_TRY(back);
  }
}

/* Where the force jumped: look for it from there on. What is found without it counts too. */
static sw_status search_on(const poser *p, sw_error *err) {
  sw_status status = SW_OK;
  for (int round = 1; status == SW_OK && round < MOST_ROUNDS && sw_jaw_again(p->s); round++) {
    sw_live start = {0};
    sw_error why;
    status = sw_live_take(p->s, &start);
    if (status == SW_OK) status = search(p, &start, p->s->time, NULL, &why);
    sw_live_free(&start);
    if (status != SW_OK && status != SW_ENOCONV) return sw_fail(err, status, "%s", why.text);
  }
  if (status != SW_OK) sw_jaw_end_rest(p->s, 0);
  return SW_OK;
}

sw_status sw_scene_squeezed_rest(sw_scene *s, double since, int *too_far,
                                 const sw_settle_args *args, int (*interrupted)(void),
                                 sw_settle_report *report, sw_error *err) {
  const poser p = {s, args, interrupted, report};
  pose_start start = {0};
  sw_status status = take(s, &start);
  if (status != SW_OK) sw_fail(err, status, "scene '%s': out of memory", s->name);
  if (status == SW_OK) status = search(&p, &start.live, since, too_far, err);
  if (status == SW_OK) {
    status = search_on(&p, err);
    sw_error ignored;
    for (size_t k = 0; status != SW_OK && k < s->tool_count; k++) s->tools[k].jaw = start.jaws[k];
    if (status != SW_OK) sw_live_put(s, &start.live, &ignored);
  }
  drop(&start);
  return status;
}

/* What drives the wires goes on to t1, the wires to their equilibrium. Without friction the pose
 * step does not matter; with friction it does, and halving it shows how much. */
static sw_status pose(sw_scene *s, double t1, int halvings, int (*interrupted)(void),
                      sw_run_report *report, sw_error *err) {
  sw_settle_args args = {.tolerance = 1e-9, .max_iterations = 4000};
  sw_settle_report rest = {0};
  const double t0 = s->time;
  int too_far = 0;
  int *const tells = halvings ? &too_far : NULL;
  const int squeezes = sw_jaw_begin(s, t1 - t0);
  if (squeezes && halvings) args.max_iterations = FEW_ITERATIONS;
  s->time = t1;
  const sw_status status =
      squeezes ? sw_scene_squeezed_rest(s, t0, tells, &args, interrupted, &rest, err)
               : sw_scene_rest(s, t0, tells, &args, interrupted, &rest, err);
  report->iterations += rest.iterations;
  if (status != SW_OK) {
    s->time = t0;
    const int helps = too_far || (squeezes && status == SW_ENOCONV); /* jaws then go less far */
    if (!helps || !halvings) return status;
    SW_TRY(pose(s, 0.5 * (t0 + t1), halvings - 1, interrupted, report, err));
    sw_jaw_follow(s);
    return pose(s, t1, halvings - 1, interrupted, report, err);
  }
  report->smallest_dt = fmin(report->smallest_dt, t1 - t0);
  if (rest.jumped) {
    report->jumps++;
    report->last_jump = t1;
  }
  return SW_OK;
}

/* Pads that hold a wire are shifted by no more of the thinnest one's radius from one pose to the
 * next: it would be beside them where its equilibrium is looked for [-]. */
static const double WIDEST_SHIFT = 0.5;

/* How far from its centre a tool presses [m]. */
static double reach_of(const sw_scene *s, const sw_tool *t) {
  double reach = 0;
  for (size_t i = 0; s->contact && i < sw_contact_touches(s->contact); i++) {
    sw_contact_push push;
    if (!sw_contact_push_at(s->contact, &s->system, i, &push)) continue;
    for (size_t k = 0; k < t->pads; k++)
      if (t->pad[k].obstacle == (size_t)push.obstacle)
        reach = fmax(reach, sw_dist(push.point, t->now.centre));
  }
  return reach;
}

enum { MOST_CUTS = 60 }; /* of a step, by motions that start slowly and end fast [-] */

/* The largest step up to h in which the tool carries what it presses no further than that. */
static sw_status carried_step(sw_scene *s, const sw_tool *t, double most, double *h,
                              sw_error *err) {
  sw_motion_state from, to;
  SW_TRY(sw_drive_eval(s, &t->drive, s->time, &from, err));
  const double reach = reach_of(s, t);
  for (int cut = 0; cut < MOST_CUTS; cut++) {
    SW_TRY(sw_drive_eval(s, &t->drive, s->time + *h, &to, err));
    const sw_quat turned = sw_quat_mul(to.pose.q, sw_quat_conj(from.pose.q));
    const double shift = sw_dist(from.pose.p, to.pose.p) + reach * sw_norm(sw_quat_log(turned));
    if (!(shift > most)) break;
    *h *= fmax(0.5, 0.95 * most / shift);
  }
  return SW_OK;
}

sw_status sw_scene_pose_step(sw_scene *s, double *h, sw_error *err) {
  double radius = HUGE_VAL;
  for (size_t w = 0; w < s->wire_count; w++) radius = fmin(radius, s->wires[w].beam.radius);
  for (size_t k = 0; k < s->tool_count; k++)
    if (s->tools[k].alive && !s->tools[k].frozen && s->tools[k].jaw.now > 0)
      SW_TRY(carried_step(s, &s->tools[k], WIDEST_SHIFT * radius, h, err));
  *h = sw_jaw_step(s, *h);
  return SW_OK;
}

sw_status sw_scene_pose(sw_scene *s, double t1, int (*interrupted)(void), sw_run_report *report,
                        sw_error *err) {
  return pose(s, t1, MOST_HALVINGS, interrupted, report, err);
}
