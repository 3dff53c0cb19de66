/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frozen grips that would bear far more than their pads could. A rigid grip bears any load: an
 * axially stiff cable drawn taut gave 3.5 to 140 N in the step before the thaw where pads slip at
 * 1.2 N. */
#include <math.h>

#include "body/hold.h"
#include "grip/frozen.h"
#include "grip/jaws.h"
#include "scene/drive.h"
#include "scene/parts.h"

/* A step may end with a margin of this times the limit, with which the grip thaws after the step.
 * With the limit of 0.9 the load is still less than the pads bear [-]. */
static const double OVER = 1.1;

/* Returns the margin of a frozen grip at time t, the end of the last trial of size `span`; 0: of
 * the state itself [s]. */
static sw_status margin_of(sw_scene *s, size_t slot, double t, double span, double *margin,
                           sw_error *err) {
  const sw_tool *tool = sw_scene_tool_in(s, slot);
  const sw_system *system = sw_scene_system(s);
  sw_vec force = sw_v(0, 0, 0), moment = force;
  sw_motion_state at;
  SW_TRY(sw_drive_eval(s, &tool->drive, t, &at, err));
  SW_EACH(hold, hold, s) {
    sw_vec F, M;
    if (!hold->alive || hold->drive.tool != 1 + slot) continue;
    sw_hold_coming_load(s, hold, span, &F, &M);
    const sw_vec arm = sw_sub(system->hold_states[hold->number].pose.p, at.pose.p);
    force = sw_add(force, F);
    moment = sw_add(moment, sw_add(M, sw_cross(arm, F)));
  }
  *margin =
      sw_frozen_margin(tool->frozen, sw_unrotate(at.pose.q, force), sw_unrotate(at.pose.q, moment));
  return SW_OK;
}

/* 1 if the tool's rigid grip is still to be lost. */
static int holds(const sw_tool *t) { return t->alive && t->frozen && isnan(t->now.lost_time); }

int sw_grips_frozen(const sw_scene *s) {
  SW_EACH(tool, t, s)
    if (holds(t)) return 1;
  return 0;
}

sw_status sw_grips_overloaded(sw_scene *s, double since, double until, int *over, sw_error *err) {
  const double span = sw_scene_time(s) < until ? until - since : 0.0;
  *over = 0;
  for (size_t k = 0; k < sw_scene_tool_slots(s); k++) {
    sw_tool *t = sw_scene_tool_in(s, k);
    double margin;
    if (!holds(t)) continue;
    SW_TRY(margin_of(s, k, until, span, &margin, err));
    if (!(margin > OVER * t->limit)) continue;
    t->now.margin = margin;
    t->now.lost_time = since;
    *over = 1;
  }
  return SW_OK;
}
