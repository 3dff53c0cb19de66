/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step of fixed size, halved where it has to be: where nothing else helps, and where blows and
 * what wires pass ask for it. */
#include <math.h>

#include "scene/feed.h"
#include "scene/world.h"
#include "step/blow.h"
#include "step/passing.h"
#include "step/restart.h"
#include "step/slip.h"

/* A first step after a jump knows no accelerations, and its reactions are off by their own
 * size, by which slips would be wrong: it is kept to this share [-]. */
static const double FIRST_SLIP = 1e-3;

/* Parts end with their step: the difference of two times is known to no more than so much of a
 * part, and what that leaves is no part [-]. */
static const double ROUNDING = 1e-6;

/* Advance by h, in smaller parts where needed. t1 is the exact end time. */
sw_status sw_step_fixed(sw_ladder *p, double h, double t1, sw_error *err) {
  sw_scene *s = p->s;
  const double t0 = s->time;
  double done = 0, part = h;
  sw_error failed = {""}; /* why a part of this step was refused last */
  int starts = s->course.next && sw_slip_any(s), cut = 0; /* cut: at a rebound */
  p->cuts = 0;
  if (starts) part = FIRST_SLIP * h;
  p->changed = sw_restart_changed(s);
  while (done < h) {
    const double left = h - done;
    part = sw_blow_part(s, part);
    if (part > left * (1 - ROUNDING)) part = left;
    if (done > 0 && p->interrupted && p->interrupted()) return SW_EINTR; /* there may be many */
    SW_TRY(sw_ladder_make_room(p, &part, err));
    sw_restart_at_jerk(s);
    if (!(part >= SW_SMALLEST_SHARE * SW_SMALLEST_SHARE * h))
      return sw_feed_too_fast(s, failed.text, err);
    const sw_status status = sw_ladder_try(p, part, 0.5 * part < SW_SMALLEST_SHARE * h, err);
    if (status == SW_OK && sw_blow_begins(s, part)) { /* not refused: it only told of the blow */
      sw_ladder_undo(p);
      continue;
    }
    const double over = status == SW_OK ? sw_passing_of(s, s->course.stepper.trial_x) : 0;
    if (sw_passing_part(part, over) < part) { /* nor is this */
      sw_ladder_undo(p);
      part = sw_passing_part(part, over);
      continue;
    }
    if (status == SW_OK) {
      done += part;
      sw_ladder_accept(p, part, done < h ? t0 + done : t1);
      if (p->redo != SW_AS_IS) sw_blow_refused(s, part);
      SW_TRY(sw_ladder_record(p, part, err));
      part = starts || cut ? h : over > 0.5 ? part : 2 * part;
      starts = cut = 0;
      continue;
    }
    if (sw_ladder_hopeless(status)) return status;
    failed = *err;
    p->report->rejected++;
    p->held = *err;
    cut = p->soonest > 0;
    p->cuts += cut;
    if (!cut) sw_blow_refused(s, part);
    sw_restart_refused(p, cut);
    part = cut ? p->soonest : 0.5 * part;
    if (part < SW_SMALLEST_SHARE * h) return status;
  }
  return SW_OK;
}
