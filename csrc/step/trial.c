/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes one trial with the run's method, whose stages the system solves, and checks whether it
 * is believable. */
#include "scene/course.h"
#include "scene/parts.h"
#include "step/believe.h"
#include "step/restart.h"
#include "system/rail.h"
#include "watch/observe.h"

sw_status sw_rung_solve(sw_ladder *p, const sw_rung *below, double h, sw_error *err) {
  sw_scene *s = p->s;
  sw_course *course = sw_scene_course(s);
  sw_system *system = sw_scene_system(s);
  sw_status status = sw_stepper_trial(&course->stepper, system, sw_scene_time(s), h, err);
  p->report->iterations += course->stepper.iterations;
  if (status == SW_OK && !course->stepper.plastic && sw_rails_struck(system)) {
    sw_stepper_reject(&course->stepper, system);
    sw_restart_struck(s, 1);
    return sw_rung_solve(p, below, h, err);
  }
  if (status == SW_OK) status = sw_scene_check_trial(s, err);
  if (status == SW_OK && system->fastest_turn * h > SW_WIDEST_TURN)
    status = sw_fail(err, SW_ENOCONV, "a hold of a wire turns too far in one step");
  if (status == SW_OK && sw_scene_join_slots(s) + sw_scene_force_slots(s) > 0 &&
      h > SW_SHORTEST_BREAK * p->args->dt)
    status = sw_scene_check_ties(s, course->stepper.trial_x, err);
  if (status != SW_OK) sw_stepper_reject(&course->stepper, system);
  return status;
}
