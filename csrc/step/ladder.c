/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rungs in their order, and what they share. */
#include "step/ladder.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/quota.h"
#include "scene/feed.h"
#include "scene/touching.h"
#include "scene/world.h"
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
  sw_stepper_reject(&s->course.stepper, &s->system);
  if (sw_scene_has_contact(s)) memcpy(s->system.v, p->v_start, s->system.freedoms * sizeof(double));
}

int sw_ladder_hopeless(sw_status status) {
  return status == SW_ECALLBACK || status == SW_ENOMEM || status == SW_EINVAL ||
         status == SW_EEMPTY || status == SW_EINTR || status == SW_ELIMIT;
}

sw_status sw_ladder_method(sw_scene *s, const sw_run_args *args, sw_error *err) {
  const sw_integrator *m = sw_integrator_all()[args->integrator];
  if (s->course.has_stepper && s->course.method == m) return SW_OK;
  sw_stepper_free(&s->course.stepper);
  s->course.has_stepper = 0;
  if (sw_stepper_new(&s->course.stepper, m, &s->system) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", s->name);
  s->course.has_stepper = 1;
  s->course.method = m;
  sw_restart_stepper(s);
  return SW_OK;
}

sw_status sw_ladder_make_room(sw_ladder *p, double *h, sw_error *err) {
  sw_scene *s = p->s;
  int changed;
  const sw_counters before = s->system.counters;
  const int pending = sw_restart_pending(s);
  *h = sw_feed_step(s, *h);
  SW_TRY(sw_feed_make_room(s, s->time + *h, &changed, err));
  if (!changed) return SW_OK;
  sw_ledger_forget(s);
  s->system.counters = before;
  SW_TRY(sw_ladder_method(s, p->args, err));
  s->course.stepper.wants_error = isfinite(p->args->tolerance);
  sw_restart_resume(s, pending);
  sw_free(p->v_start);
  p->v_start = sw_alloc(sw_scene_has_contact(s) ? s->system.freedoms : 1, sizeof(double));
  return p->v_start ? SW_OK : sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", s->name);
}
