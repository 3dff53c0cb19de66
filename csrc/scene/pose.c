/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses: equilibria at the places of what drives the wires, one after another. Jaws that obey a
 * force are as open at each as it takes, found by repeating the pose from where it began. */
#include <math.h>

#include "scene/world.h"

enum { MOST_HALVINGS = 6 }; /* of a pose step [-] */

static void add_up(sw_settle_report *sum, const sw_settle_report *trial) {
  const size_t iterations = sum->iterations + trial->iterations;
  *sum = *trial;
  sum->iterations = iterations;
}

/* One equilibrium after another until the jaws' forces are as wanted; begun: as it was before. */
static sw_status squeezed_rest(sw_scene *s, const sw_live *begun, double since, int *too_far,
                               const sw_settle_args *args, int (*interrupted)(void),
                               sw_settle_report *report, sw_error *err) {
  for (;;) {
    sw_settle_report trial = {0};
    sw_error ignored;
    const sw_status status = sw_scene_rest(s, since, too_far, args, interrupted, &trial, err);
    add_up(report, &trial);
    if (status == SW_OK && sw_jaw_correct(s)) return SW_OK;
    const sw_status back = sw_live_put(s, begun, status == SW_OK ? err : &ignored);
    if (status != SW_OK) return status;
    SW_TRY(back);
  }
}

sw_status sw_scene_squeezed_rest(sw_scene *s, double since, int *too_far,
                                 const sw_settle_args *args, int (*interrupted)(void),
                                 sw_settle_report *report, sw_error *err) {
  sw_live begun = {0};
  sw_status status = sw_live_take(s, &begun);
  if (status == SW_OK)
    status = squeezed_rest(s, &begun, since, too_far, args, interrupted, report, err);
  else
    sw_fail(err, status, "scene '%s': out of memory", s->name);
  sw_live_free(&begun);
  return status;
}

/* What drives the wires goes on to t1, the wires to their equilibrium. Without friction the pose
 * step does not matter; with friction it does, and halving it shows how much. */
static sw_status pose(sw_scene *s, double t1, int halvings, int (*interrupted)(void),
                      sw_run_report *report, sw_error *err) {
  static const sw_settle_args args = {.tolerance = 1e-9, .max_iterations = 4000};
  sw_settle_report rest = {0};
  const double t0 = s->time;
  int too_far = 0;
  int *const tells = halvings ? &too_far : NULL;
  const int squeezes = sw_jaw_begin(s, t1 - t0);
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

sw_status sw_scene_pose(sw_scene *s, double t1, int (*interrupted)(void), sw_run_report *report,
                        sw_error *err) {
  return pose(s, t1, MOST_HALVINGS, interrupted, report, err);
}
