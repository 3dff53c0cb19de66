/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rung of the energy referee: redoes a step that makes energy. */
#include "scene/course.h"
#include "scene/parts.h"
#include "step/energy.h"
#include "step/ladder.h"

static sw_status judge(sw_ladder *p, double h, double *excess, sw_error *err) {
  sw_scene *s = p->s;
  const sw_status status = sw_ledger_judge(s, sw_scene_time(s) + h, h, p->changed, err);
  *excess = p->changed || status != SW_OK ? 0.0 : sw_ledger_excess(s, h, p->args->dt);
  if (status != SW_OK) sw_ladder_undo(p);
  return status;
}

/* Returns what to try after a step that made energy. Where nothing touches, only a smaller step
 * helps; the accelerations at its start remain valid. */
static int next_redo(sw_ladder *p) {
  const sw_stepper *stepper = &sw_scene_course(p->s)->stepper;
  p->smooth = !sw_scene_books(p->s)->step.touching;
  if (p->smooth) return SW_GIVE_UP;
  if (p->redo == SW_AS_IS && stepper->start != stepper->method && !stepper->restart)
    return SW_BY_START;
  return p->redo < SW_DULLY ? SW_DULLY : SW_GIVE_UP;
}

/* Where nothing touches, half a step makes at most a quarter of the energy, because the methods are
 * of second order. A step that makes more than HELPS of the energy of a longer one, and less than
 * LITTLE of the energy in play, only corrects the iteration error of the last state: no smaller
 * step helps [-]. */
static const double HELPS = 0.5, LITTLE = 5e-4;

static int smaller_helps(sw_ladder *p, double excess) {
  const double start = sw_scene_time(p->s), least = LITTLE * sw_scene_books(p->s)->sums.play;
  const int helps = p->made_at != start || !(excess > HELPS * p->made) || excess > least;
  p->made_at = start, p->made = excess;
  return helps;
}

/* The referee: repeats a step that makes energy. SW_ENOCONV: it still makes energy. With
 * p->smallest such a step is accepted and counted. */
sw_status sw_rung_judge(sw_ladder *p, const sw_rung *below, double h, sw_error *err) {
  sw_scene *s = p->s;
  sw_ledger *l = &sw_scene_books(s)->sums;
  double excess;
  p->smooth = 0;
  SW_TRY(sw_ledger_open(s, err));
  if (p->interrupted && p->interrupted()) return SW_EINTR;
  for (p->redo = SW_AS_IS;;) {
    SW_TRY(sw_rung_go(p, below, h, err));
    if (p->interrupted && p->interrupted()) { /* with many nodes each trial takes long */
      sw_ladder_undo(p);
      return SW_EINTR;
    }
    SW_TRY(judge(p, h, &excess, err));
    if (!(excess > 0)) return SW_OK;
    const int next = next_redo(p);
    if (p->smooth && !smaller_helps(p, excess)) return SW_OK;
    if (next == SW_GIVE_UP && p->smallest) {
      sw_ledger_retry(s, &l->accepted, sw_scene_time(s), excess);
      return SW_OK;
    }
    if (p->redo == SW_AS_IS) sw_ledger_retry(s, &l->redone, sw_scene_time(s), excess);
    if (next == SW_GIVE_UP) sw_ledger_retry(s, &l->halved, sw_scene_time(s), excess);
    sw_ladder_undo(p);
    if (next == SW_GIVE_UP) return sw_fail(err, SW_ENOCONV, "the step makes energy from nowhere");
    p->redo = next;
  }
}
