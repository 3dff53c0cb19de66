/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Feeds that yield to a force. The speed at which wire slips changes evenly within a
 * step (a jump of it would be a blow to the wire), at the rate for which the drive's force
 * at the step's end is the one wanted: found by false position, since the force is nearly
 * linear in it. With a limit wire slips until it has the speed asked for
 * again, like a slipping clutch. */
#include "step/slip.h"

#include <math.h>

#include "scene/world.h"
#include "step/ladder.h"

static const double PRECISION = 1e-7; /* of the force, the wire's weight or EI/L2 [-] */

static const double SAME_PLACE = 1e-13; /* way of the wire in a step [m] */

static int yields(const sw_hold *h) {
  return h->alive && sw_hold_passes(h) && (isfinite(h->feed.push) || isfinite(h->feed.limit));
}

int sw_slip_any(const sw_scene *s) {
  for (size_t k = 0; k < s->hold_count; k++)
    if (yields(&s->holds[k])) return 1;
  return 0;
}

int sw_slip_begin(sw_scene *s) {
  int any = 0;
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_feed *f = &s->holds[k].feed;
    if (!yields(&s->holds[k])) continue;
    any = 1;
    f->slip_before = f->slip_growth;
    f->way_before = f->slip_way;
    if (!isfinite(f->push) && f->slip_way == 0) f->slip_growth = 0; /* first tried without */
  }
  return any;
}

void sw_slip_give_up(sw_scene *s) {
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_feed *f = &s->holds[k].feed;
    if (!yields(&s->holds[k])) continue;
    f->slip_growth = f->slip_before;
    f->slip_way = f->way_before;
  }
}

/* The next guess: between a trial with too little force and one with too much, as the false
 * position has it (halving the weight of a side that stays), else by the slope known so far.
 * Returns 1 when both are one place: the force jumps there, as in an impact; or in very short
 * steps, when the next guess is the same place. */
static int improve(sw_feed *f, double off, int first, double mass, double step) {
  const int side = off > 0;
  const double before = f->slip_growth;
  if (first) f->off[0] = f->off[1] = NAN, f->last_side = -1;
  const double seen = f->off[side], at = f->tried[side];
  f->tried[side] = before, f->off[side] = off;
  const double gap = f->tried[1] - f->tried[0];
  if (isfinite(f->off[!side])) {
    if (fabs(gap) * step * step < SAME_PLACE) return 1;
    if (f->last_side == side) f->off[!side] *= 0.5;
    f->slope = (f->off[1] - f->off[0]) / gap;
    f->slip_growth = f->tried[0] - f->off[0] / f->slope;
  } else {
    const double slope = isfinite(seen) ? (off - seen) / (before - at) : f->slope;
    f->slope = slope > 0 ? slope : mass; /* all of the wire is pushed along */
    if (!first && fabs(off / f->slope) * step * step < SAME_PLACE) return 1;
    f->slip_growth -= off / f->slope;
  }
  f->last_side = side;
  return 0;
}

/* Has the slip come to its end within the step? Then it stops with it. */
static int stops(sw_feed *f, double h) {
  if (isfinite(f->push) || f->way_before == 0) return 0;
  if ((f->slip_speed + f->slip_growth * h) * f->slip_way <= 0) return 0;
  f->slip_way = 0;
  f->slip_growth = -f->slip_speed / h;
  return 1;
}

static int correct(sw_scene *s, sw_hold *h, double step, int first) {
  sw_feed *f = &h->feed;
  const sw_plan *p = s->system.bodies[h->wire].plan;
  const sw_link_wire w = sw_scene_link_wire(s, h->wire);
  const double drive = h->cls->hold->passes(h, &w, s->time, s->stepper.trial_x).force;
  const double L = p->length;
  const double weight = p->beam.mass * L * sw_norm(s->gravity);
  if (!isfinite(f->push) && f->slip_way == 0) {
    if (f->way_before != 0 || fabs(drive) <= f->limit) return 1; /* stopped, or holds */
    f->slip_way = copysign(1.0, drive);
  }
  const double want = isfinite(f->push) ? f->push : copysign(f->limit, f->slip_way);
  const double off = drive - want, scale = fmax(fabs(want), fmax(weight, p->beam.EI / (L * L)));
  if (fabs(off) <= PRECISION * scale) return !stops(f, step);
  return improve(f, off, first, p->beam.mass * L, step);
}

int sw_slip_correct(sw_scene *s, double h, int first) {
  int good = 1;
  for (size_t k = 0; k < s->hold_count; k++)
    if (yields(&s->holds[k])) good &= correct(s, &s->holds[k], h, first);
  return good;
}

enum { MOST_SLIP_TRIALS = 25 };

/* One step of size h in which feeds slip that yield to a force. */
sw_status sw_rung_slip(sw_ladder *p, const sw_rung *below, double h, sw_error *err) {
  sw_scene *s = p->s;
  if (!sw_slip_begin(s)) return sw_rung_go(p, below, h, err);
  for (int i = 0; i < MOST_SLIP_TRIALS; i++) {
    const sw_status status = sw_rung_go(p, below, h, err);
    if (status != SW_OK) {
      sw_slip_give_up(s);
      return status;
    }
    if (sw_slip_correct(s, h, i == 0)) return SW_OK;
    sw_ladder_undo(p);
    if (sw_feed_step(s, h) < h) break; /* further than nodes can follow */
  }
  sw_slip_give_up(s);
  return sw_fail(err, SW_ENOCONV, "the speed at which a feed slips was not found");
}
