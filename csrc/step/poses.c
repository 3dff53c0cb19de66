/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step of slow handling: from one equilibrium to the next. */
#include <math.h>

#include "base/quota.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "step/energy.h"
#include "step/jaw.h"
#include "step/ladder.h"
#include "step/passing.h"
#include "step/rest.h"
#include "step/run.h"
#include "step/unsettled.h"
#include "watch/observe.h"

static const double SHORTEST_PASSING = 1.0 / 64; /* shortest pose for passing a clip, over the pose
                                                    step [-] */

/* Slow handling: equilibria up to time t. Where wire is fed, in parts (substeps) that nodes can
 * follow. */
static sw_status pose_steps(sw_ladder *p, double t, sw_error *err) {
  sw_scene *s = p->s;
  double most = HUGE_VAL; /* next part at a clip: twice the last one, at least the shortest [s] */
  double longest = t - sw_scene_time(s);
  SW_TRY(sw_scene_cut_rubbing(s, &longest, err));
  while (sw_scene_time(s) < t) {
    const double t0 = sw_scene_time(s);
    double h = sw_jaw_step(s, fmin(most, t - t0));
    if (p->interrupted && p->interrupted()) return SW_EINTR;
    SW_TRY(sw_quota_take(err));
    SW_TRY(sw_ladder_make_room(p, &h, err));
    const int between = longest < h * (1 - 1e-9);
    if (between) h = longest;
    const double part = h < (t - sw_scene_time(s)) * (1 - 1e-9) ? sw_scene_time(s) + h : t;
    if (!(part > sw_scene_time(s)))
      return sw_fail(err, SW_ENOCONV, "a wire is fed too fast for the steps");
    SW_TRY(sw_ledger_open(s, err));
    const sw_pose_args how = {.interrupted = p->interrupted,
                              .shortest = SW_SHORTEST_BREAK * p->args->dt,
                              .passing = SHORTEST_PASSING * p->args->dt,
                              .between = between,
                              .lost = &p->lost,
                              .unsettled = p->args->unsettled,
                              .falls = &p->falls};
    const int passes = sw_passing_any(s);
    const size_t jumps = p->report->jumps;
    SW_TRY(sw_scene_pose(s, part, &how, p->report, err));
    if (p->lost) return SW_OK;
    most = passes ? fmax(how.passing, 2 * (sw_scene_time(s) - t0)) : HUGE_VAL;
    sw_scene_course(s)->span = 0;
    if (p->report->jumps > jumps) SW_TRY(sw_scene_watch_leap(s, err));
    SW_TRY(sw_step_observe(s, err));
    for (size_t w = 0; w < sw_scene_wire_slots(s); w++) sw_scene_watch_sinking(s, w);
    sw_scene_watch_unkept(s);
  }
  return SW_OK;
}

/* The same; where no equilibrium is found, the wires move. */
static sw_status settle_or_move(sw_ladder *p, double t, sw_error *err) {
  if (sw_unsettled_moves(p, t)) return sw_unsettled_go(p, t, err);
  const sw_status status = pose_steps(p, t, err);
  if (status != SW_OK) return sw_unsettled_begin(p, t, status, err);
  sw_unsettled_ends(p);
  return SW_OK;
}

static const double MOST_TURN_PARTS = 1e4;

/* Also divides the step so that no hold turns by half a turn or more in a part. */
sw_status sw_step_poses(sw_ladder *p, double t1, sw_error *err) {
  sw_system *system = sw_scene_system(p->s);
  const double t0 = sw_scene_time(p->s);
  system->fastest_turn = 0;
  SW_TRY(sw_system_place_holds(system, 0.5 * (t0 + t1), NULL, NULL, NULL, err));
  SW_TRY(sw_system_place_holds(system, t1, NULL, NULL, NULL, err));
  const double turn = system->fastest_turn * (t1 - t0);
  if (turn > MOST_TURN_PARTS * SW_WIDEST_TURN)
    return sw_fail(err, SW_EDIVERGED,
                   "a hold of a wire turns by %g rad between two poses; they must be closer", turn);
  const int parts = 1 + (int)(turn / SW_WIDEST_TURN);
  for (int part = 1; part <= parts && !p->lost; part++)
    SW_TRY(settle_or_move(p, part < parts ? t0 + (t1 - t0) * part / parts : t1, err));
  p->report->steps++;
  return SW_OK;
}
