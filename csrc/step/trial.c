/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One trial by the run's method, whose stages the system solves: is it one to believe? */
#include "scene/join.h"
#include "scene/world.h"
#include "step/believe.h"
#include "step/restart.h"
#include "system/rail.h"

sw_status sw_rung_solve(sw_ladder *p, const sw_rung *below, double h, sw_error *err) {
  sw_scene *s = p->s;
  sw_status status = sw_stepper_trial(&s->course.stepper, &s->system, s->time, h, err);
  p->report->iterations += s->course.stepper.iterations;
  if (status == SW_OK && !s->course.stepper.plastic && sw_rails_struck(&s->system)) {
    sw_stepper_reject(&s->course.stepper, &s->system);
    sw_restart_struck(s, 1);
    return sw_rung_solve(p, below, h, err);
  }
  if (status == SW_OK) status = sw_scene_check_trial(s, err);
  if (status == SW_OK && s->system.fastest_turn * h > SW_WIDEST_TURN)
    status = sw_fail(err, SW_ENOCONV, "what holds a wire turns too far in one step");
  if (status == SW_OK && s->join_count + s->force_count > 0 && h > SW_SHORTEST_BREAK * p->args->dt)
    status = sw_scene_check_ties(s, s->course.stepper.trial_x, err);
  if (status != SW_OK) sw_stepper_reject(&s->course.stepper, &s->system);
  return status;
}
