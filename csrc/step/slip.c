/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Feeds that obey a force. The slipping speed of the wire changes evenly within a step, because a
 * jump would be a blow. False position finds the rate of this change with which the drive has the
 * wanted force at the end of the step; the force is nearly linear in the rate. With a limit the
 * wire slips, as in a slipping clutch, until it has the asked speed again. */
#include "step/slip.h"

#include <math.h>

#include "body/guide.h"
#include "body/hold.h"
#include "link/hold.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/obey.h"
#include "step/restart.h"

static const double PRECISION = 1e-7; /* of the force, the wire's weight or EI/L2, whichever is
                                         largest [-] */

/* Positions have rounding errors of about this share of their size. In a short step the inertia of
 * the node in the guide turns this into a force that no speed can remove [-]. */
static const double ROUNDED = 1e-15;

static const double NO_WAY = 1e-13; /* shorter paths of the wire in a step count as none [m] */

sw_slip *sw_slip_of(sw_hold *h) {
  return h->alive && h->cls->hold->slips ? h->cls->hold->slips(h) : NULL;
}

int sw_slip_any(const sw_scene *s) {
  SW_EACH(hold, h, s)
    if (sw_slip_of(h)) return 1;
  return 0;
}

static int begin(sw_scene *s, double step) {
  int any = 0;
  (void)step;
  SW_EACH(hold, h, s) {
    sw_slip *f = sw_slip_of(h);
    if (!f) continue;
    any = 1;
    /* a discarded step may have left other values */
    f->growth = f->growth_before;
    f->way = f->way_before;
    f->evened = 0, f->anew = sw_restart_changed(s);
    if (!isfinite(f->push) && f->way == 0) f->growth = 0; /* first tried without slip */
  }
  return any;
}

static void give_up(sw_scene *s) {
  SW_EACH(hold, h, s) {
    sw_slip *f = sw_slip_of(h);
    if (!f) continue;
    f->growth = f->growth_before;
    f->way = f->way_before;
  }
}

/* Sets the next guess: by false position between a trial with too little force and one with too
 * much, else by the slope known so far. Returns 1 if both have met: the force jumps there, as in an
 * impact. Also returns 1 if the next guess is the same place, as in very short steps. */
static int improve(sw_slip *f, double off, int first, double mass, double step) {
  sw_bracket *b = &f->found;
  const double before = f->growth;
  if (first) sw_bracket_clear(b);
  const double seen = b->off[off > 0], at = b->tried[off > 0];
  const double width = sw_bracket_closed(b) ? fabs(sw_bracket_width(b)) : HUGE_VAL;
  const int again = b->last_side == (off > 0), side = sw_bracket_add(b, before, off);
  if (sw_bracket_closed(b)) {
    const double left = fabs(sw_bracket_width(b));
    if (left * step * step < NO_WAY) return 1;
    sw_bracket_weigh(b, side);
    f->slope = sw_bracket_slope(b);
    /* the slope at an opening touch is thousands of times steeper on one side than on the other */
    f->growth =
        again && left > 0.5 * width ? 0.5 * (b->tried[0] + b->tried[1]) : sw_bracket_root(b);
    return 0;
  }
  const double slope = isfinite(seen) ? (off - seen) / (before - at) : f->slope;
  f->slope = slope > 0 ? slope : mass; /* all of the wire is pushed along */
  if (!first && fabs(off / f->slope) * step * step < NO_WAY) return 1;
  sw_bracket_weigh(b, side);
  f->growth -= off / f->slope;
  return 0;
}

/* 1 if the slip ends within the step; the slip then ends with the step. */
static int stops(sw_slip *f, double h) {
  if (isfinite(f->push) || f->way_before == 0) return 0;
  if ((f->speed + f->growth * h) * f->way <= 0) return 0;
  f->way = 0;
  f->growth = -f->speed / h;
  return 1;
}

double sw_slip_scale(const sw_scene *s, const sw_hold *h, double want) {
  const sw_plan *p = sw_scene_system(s)->bodies[h->wire].plan;
  const double L = p->length, weight = p->beam.mass * L * sw_norm(sw_scene_gravity(s));
  return fmax(fabs(want), fmax(weight, p->beam.EI / (L * L)));
}

/* Returns the allowed deviation of the drive's force [N]. */
static double allowed(const sw_scene *s, const sw_hold *h, const double *x, double want,
                      double step) {
  const sw_body *b = &sw_scene_system(s)->bodies[h->wire];
  const sw_plan *p = b->plan;
  const double reach = sw_norm(sw_vec_at(x, b->first_node + h->node));
  const double rounded = ROUNDED * reach * p->lumped[h->node] / (step * step);
  return fmax(PRECISION * sw_slip_scale(s, h, want), rounded);
}

/* Returns the drive's force on slipping wire [N]. */
static double asked(const sw_slip *f) {
  return isfinite(f->push) ? f->push : copysign(f->limit, f->way);
}

static int correct_slip(sw_scene *s, sw_hold *h, sw_slip *f, double step, int first) {
  const sw_plan *p = sw_scene_system(s)->bodies[h->wire].plan;
  const double *x = sw_scene_course(s)->stepper.trial_x;
  const sw_hold_way now = sw_hold_way_of(s, h, sw_scene_time(s), x);
  const double drive = now.obeys;
  f->off = 0;
  f->evened = now.obeys == now.force && now.force != now.stage;
  if (!isfinite(f->push) && f->way == 0) {
    if (f->way_before != 0 || fabs(drive) <= f->limit)
      return 1; /* the slip has stopped, or the drive holds */
    f->way = copysign(1.0, drive);
  }
  const double want = asked(f), off = drive - want;
  if (fabs(off) <= allowed(s, h, x, want, step)) return !stops(f, step);
  const int jumps = improve(f, off, first, p->beam.mass * p->length, step);
  if (jumps) f->off = off;
  return jumps;
}

static int correct(sw_scene *s, double h, int first) {
  int good = 1;
  SW_EACH(hold, hold, s) {
    sw_slip *f = sw_slip_of(hold);
    if (f) good &= correct_slip(s, hold, f, h, first);
  }
  return good;
}

/* --- where it cannot obey --------------------------------------------------------- */

/* Deviations that are reported. JUMPED: deviation of the force that the drive obeys, over the
 * precision of the search. READ: deviation of the force that is read out, over the scale of forces.
 * The two differ in a blow. The first step of a run begins abruptly and does not count for READ;
 * LEFT: what it may still have to even out, for a search for rest stops at 1e-5 of the force, and
 * touches at the limit of friction multiply that: 2.3e-5 were seen round a peg [-]. */
static const double JUMPED = 100.0, READ = 0.01, LEFT = 1e-4;

/* Returns the deviation of the force after a step of size h if it has to be reported; else 0
 * [N]. */
static double disobeys(const sw_scene *s, const sw_hold *h, const sw_slip *f, double want,
                       double step) {
  const double drive = h->feed.guide.drive, scale = sw_slip_scale(s, h, want);
  const double left = f->anew ? LEFT * scale : 0.0;
  const double most = fmax(left, JUMPED * allowed(s, h, sw_scene_system(s)->x, want, step));
  const double read = isfinite(f->push) ? drive - want : fmax(0.0, fabs(drive) - f->limit);
  if (fabs(f->off) > most) return f->off;
  return !f->anew && fabs(read) > fmax(most, READ * scale) ? read : 0.0;
}

/* The usual window of peaks [s], and the excess of a drive's mean force over the asked one that is
 * told, as its part in such a peak, over the scale of forces [-]. */
static const double WINDOW = 0.01, UNEVEN = 0.1;

/* Tells a drive that slips, whose force is the asked one at the ends of steps only: a wire that is
 * as stiff as a wall feels each micrometre by which its slip within the step is not that of a
 * steady force. */
static void tell_uneven(sw_scene *s, sw_hold *h, const sw_slip *f, double want, double step) {
  sw_vec force = h->force, moment;
  const double *x = sw_scene_system(s)->x, scale = sw_slip_scale(s, h, want);
  if (f->anew || !(isfinite(f->push) || f->way != 0)) return;
  if (!sw_hold_jerked(s, h, &force, &moment)) return;
  const sw_vec way = sw_hold_way_of(s, h, sw_scene_time(s), x).direction;
  const double more = fabs(want + sw_dot(sw_sub(force, h->force), way)) - fabs(want);
  if (!(more * fmin(1.0, step / WINDOW) > UNEVEN * scale)) return;
  sw_events_go_on(sw_scene_events_of(s), "coarse", h->name, sw_scene_time(s)); /* one in a run */
  sw_scene_tell(s, "coarse", h->name, NAN, more,
                "feed '%s': in a step of %.3g ms the drive's force is %.4g N as a mean instead of "
                "%.4g N, because the wire slips unevenly: peaks may be wrong; compare with smaller "
                "steps",
                h->name, 1e3 * step, fabs(want) + more, fabs(want));
}

/* Wire that is driven by a force faster than this runs away: the fastest feeders of machines reach
 * some m/s. At half of it wire that falls out of its guide by 1.3 m would be told; at twice a cable
 * of 19 g/m pushed by 4 N would be told 10 ms later [m/s]. */
static const double RUNAWAY = 10.0;

/* Tells a drive whose force nothing holds back. */
static void tell_runaway(sw_scene *s, sw_hold *h, const sw_scene_wire *wire, const sw_slip *f) {
  if (!isfinite(f->push) || !(fabs(f->speed) > RUNAWAY)) return;
  sw_events_go_on(sw_scene_events_of(s), "runaway", h->name, sw_scene_time(s)); /* one in a run */
  sw_scene_tell(s, "runaway", h->name, h->s1 - wire->mesh.s[0], f->speed,
                "feed '%s' %s wire '%s' at %.3g m/s at t = %.4g s: nothing holds back its force "
                "of %.4g N. Above 0 it pushes wire out; a brake is a :force_limit(%.4g) at speed 0",
                h->name, f->speed > 0 ? "pays out" : "draws in", wire->name, fabs(f->speed),
                sw_scene_time(s), f->push, fabs(f->push));
}

/* A wire that runs away and has this speed, over RUNAWAY, and this length, over the drawn one,
 * stops the run: it would grow and slow down the run until steps collapse [-]. */
static const double LOST_SPEED = 5.0, LOST_LENGTH = 10.0;

sw_status sw_slip_check(const sw_scene *s, sw_error *err) {
  SW_EACH(hold, h, s) {
    const sw_slip *f = sw_slip_of(h);
    if (!f || !isfinite(f->push) || !(f->speed > LOST_SPEED * RUNAWAY)) continue;
    const sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
    const double length = w->mesh.s[w->mesh.n - 1] - w->mesh.s[0];
    if (!(length > LOST_LENGTH * w->drawing.length * w->mesh.scale)) continue;
    return sw_fail(err, SW_ELIMIT,
                   "feed '%s' pays out wire '%s' at %.3g m/s and has made it %.3g m long: nothing "
                   "holds back its force of %.4g N. Above 0 it pushes wire out; a brake is a "
                   ":force_limit(%.4g) at speed 0",
                   h->name, w->name, f->speed, length, f->push, fabs(f->push));
  }
  return SW_OK;
}

void sw_slip_tell(sw_scene *s, double step) {
  SW_EACH(hold, h, s) {
    const sw_slip *f = sw_slip_of(h);
    if (!f) continue;
    const sw_scene_wire *wire = sw_scene_wire_in(s, h->wire);
    tell_runaway(s, h, wire, f);
    const double drive = h->feed.guide.drive;
    const double want = isfinite(f->push) ? f->push : copysign(f->limit, f->way ? f->way : drive);
    const double off = disobeys(s, h, f, want, step);
    tell_uneven(s, h, f, want, step);
    if (off == 0) continue;
    sw_events_go_on(sw_scene_events_of(s), "jump", h->name, sw_scene_time(s)); /* one in a run */
    sw_scene_tell(s, "jump", h->name, h->s1 - wire->mesh.s[0], off,
                  "feed '%s' of wire '%s': the drive's force is %.6g N at t = %.6g s "
                  "instead of %.6g N: it jumps there, by a blow or a touch that opens or "
                  "slides",
                  h->name, wire->name, want + off, sw_scene_time(s), want);
  }
}

/* --- the rung --------------------------------------------------------------------- */

/* 1 if nodes can follow a step of size h. */
static int follows(const sw_scene *s, double h) { return !(sw_feed_step(s, h) < h); }

static const sw_obeyer FEEDS = {.begin = begin,
                                .correct = correct,
                                .goes_on = follows,
                                .give_up = give_up,
                                .most = 25,
                                .failure = "the speed at which a feed slips was not found"};

sw_status sw_rung_slip(sw_ladder *p, const sw_rung *below, double h, sw_error *err) {
  return sw_obey(p, below, h, &FEEDS, err);
}
