/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rungs in their order, and functions that they share. */
#include "step/ladder.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/quota.h"
#include "body/guide.h"
#include "body/touching.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "step/energy.h"
#include "step/restart.h"

static const sw_rung LADDER[] = {
#define SW_RUNG(name, file, what) {sw_rung_##name},
#include "step/stages.def"
};

sw_status sw_ladder_try(sw_ladder *p, double h, int smallest, sw_error *err) {
  SW_TRY(sw_quota_take(err));
  p->smallest = smallest;
  return sw_rung_go(p, LADDER, h, err);
}

void sw_ladder_undo(sw_ladder *p) {
  sw_scene *s = p->s;
  sw_system *system = sw_scene_system(s);
  sw_stepper_reject(&sw_scene_course(s)->stepper, system);
  if (sw_scene_has_contact(s)) memcpy(system->v, p->v_start, system->freedoms * sizeof(double));
}

int sw_ladder_hopeless(sw_status status) {
  return status == SW_ECALLBACK || status == SW_ENOMEM || status == SW_EINVAL ||
         status == SW_EEMPTY || status == SW_EINTR || status == SW_ELIMIT;
}

sw_status sw_ladder_method(sw_scene *s, const sw_run_args *args, sw_error *err) {
  sw_course *course = sw_scene_course(s);
  const sw_integrator *m = sw_integrator_all()[args->integrator];
  if (course->has_stepper && course->method == m) return SW_OK;
  sw_stepper_free(&course->stepper);
  course->has_stepper = 0;
  if (sw_stepper_new(&course->stepper, m, sw_scene_system(s)) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  course->has_stepper = 1;
  course->method = m;
  sw_restart_stepper(s);
  return SW_OK;
}

sw_status sw_ladder_make_room(sw_ladder *p, double *h, sw_error *err) {
  sw_scene *s = p->s;
  sw_system *system = sw_scene_system(s);
  int changed;
  const sw_counters before = system->counters;
  const int pending = sw_restart_pending(s);
  *h = sw_feed_step(s, *h);
  SW_TRY(sw_feed_make_room(s, sw_scene_time(s) + *h, &changed, err));
  if (!changed) return SW_OK;
  sw_ledger_forget(s);
  system->counters = before;
  SW_TRY(sw_ladder_method(s, p->args, err));
  sw_restart_resume(s, pending);
  sw_free(p->v_start);
  p->v_start = sw_alloc(sw_scene_has_contact(s) ? system->freedoms : 1, sizeof(double));
  return p->v_start ? SW_OK
                    : sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
}
