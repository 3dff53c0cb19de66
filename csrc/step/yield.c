/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria with feeds that obey a force: each feed pays wire out or draws it in until it has this
 * force. False position finds the length, because more wire usually means less tension. All trials
 * of a round begin with the same state, because friction depends on history. A round changes the
 * length by at most part of an edge; then nodes come or go, and the next round begins. A free
 * hanging wire has more tension with more wire. Its drive then goes on in the direction of its
 * surplus, as it would in motion, up to the next stable place. If there is none, the feed is locked
 * where it was, and an event says so. */
#include <math.h>

#include "base/alloc.h"
#include "body/guide.h"
#include "body/hold.h"
#include "body/live.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/jaw.h"
#include "step/rest.h"
#include "step/slip.h"
#include "system/system.h"

static const double PRECISION = 1e-5; /* of the force, as in step/slip.c but at rest [-] */
static const double RANGE = 0.2;      /* most wire in one round, over an edge [-] */
static const double FIRST = 1e-3;     /* least wire in the first trial, over an edge [-] */
static const double NO_WAY = 1e-12;   /* a shorter length of wire does not count [m] */
static const double WORSE = 1e-6;     /* smallest growth of a deviation that counts [-] */
static const double TINY = 1e-9;      /* slope of a force that does not grow with the wire [-] */
static const double FARTHEST = 1.0;   /* most wire in all rounds, over the length it had [-] */
static const double TOLD = 0.01;      /* a larger deviation of the force is an event [-] */
/* MOST_TRIALS: of a round. MOST_FAILED: trials of a round without equilibrium. MOST_ROUNDS: for
 * wire of a hundred edges. MOST_AGAIN: rounds that begin where the force jumped or was not found.
 * MOST_CONFIRMED: rounds that repeat a result. Wires drawn into arbitrary shapes may come to rest
 * in several ways; wires at rest follow a small change in one [-]. */
enum { MOST_TRIALS = 40, MOST_FAILED = 6, MOST_ROUNDS = 500, MOST_AGAIN = 4, MOST_CONFIRMED = 3 };

/* State of a feed after a trial. AS_ASKED: it has the asked force. BEYOND: it needs more wire than
 * this round allows. JUMPS: its force jumps past the asked one. LOST: no length gives the force. */
enum { SEEKS = 0, AS_ASKED, BEYOND, JUMPS, LOST, STATES };

/* A feed in the present round. */
typedef struct feeder {
  sw_slip *slip;    /* NULL: this hold is no feed that obeys a force */
  double origin;    /* slipped length before all rounds [m] */
  double most;      /* largest change of that [m] */
  double base;      /* slipped length at the round's start [m] */
  double at;        /* change since then in the present trial [m] */
  double last, off; /* the same in the last trial that came to rest, and its deviation of the force
                       [m], [N] */
  double slope;     /* of the force over the wire; 0 = not known [N/m] */
  double way;       /* sign of the force against which a drive with a limit slips; 0 = none [-] */
  int tried;        /* 1: there was a trial */
  sw_bracket found; /* wire with too small and too large a force [m], [N] */
} feeder;

typedef struct yielder {
  sw_scene *s;
  const sw_settle_args *args;
  int (*interrupted)(void);
  sw_settle_report *report;
  sw_tape start; /* state with which all trials of the round begin */
  int next;      /* course->next at that state */
  sw_jaw *jaws;  /* (tools) at that state */
  feeder *feeds; /* (holds) by slot */
  size_t count;
  int moved; /* 1: the round took more than one trial */
} yielder;

/* --- one feed ------------------------------------------------------------------------ */

static void set(feeder *f, double at) {
  f->at = at;
  f->slip->length = f->base + at;
}

/* Sets the next trial after one at `at`; the round allows at most `most`. */
static int go_on(feeder *f, double at, double most, double first) {
  sw_bracket *b = &f->found;
  double next;
  const double width = sw_bracket_closed(b) ? fabs(sw_bracket_width(b)) : HUGE_VAL;
  const int again = b->last_side == (f->off > 0), side = sw_bracket_add(b, at, f->off);
  const int closed = sw_bracket_closed(b);
  const double left = closed ? fabs(sw_bracket_width(b)) : HUGE_VAL;
  if (left < NO_WAY) return JUMPS;
  sw_bracket_weigh(b, side);
  if (closed) {
    next = again && left > 0.5 * width ? 0.5 * (b->tried[0] + b->tried[1]) : sw_bracket_root(b);
  } else {
    const double way = -f->off / f->slope, least = f->tried ? 0.0 : first;
    next = fmin(most, fmax(-most, at + copysign(fmax(fabs(way), least), way)));
    if (next == at) return BEYOND;
  }
  set(f, next);
  return SEEKS;
}

static int correct(yielder *p, sw_hold *h, feeder *f) {
  const sw_system *system = sw_scene_system(p->s);
  const sw_body *body = &system->bodies[h->wire];
  const double drive = sw_hold_way_of(p->s, h, sw_scene_time(p->s), system->x).force;
  const double at = f->at, last = f->last, before = f->off;
  if (!isfinite(f->slip->push) && f->way == 0 && !(fabs(drive) <= f->slip->limit))
    f->way = copysign(1.0, drive);
  const int rests = !isfinite(f->slip->push) && f->way == 0;
  const double want = isfinite(f->slip->push) ? f->slip->push : f->way * f->slip->limit;
  f->last = at, f->off = rests ? 0.0 : drive - want;
  if (fabs(f->off) <= PRECISION * sw_slip_scale(p->s, h, want)) return AS_ASKED;
  const double size = h->cls->hold->guide(h)->size;
  if (f->tried && at != last) {
    const double slope = (f->off - before) / (at - last);
    const int worse = (at - last) * before < 0 && before * f->off > 0 &&
                      fabs(f->off) > (1 + WORSE) * fabs(before);
    if (worse)
      f->slope = TINY * body->plan->beam.EA / body->plan->length; /* continue as far as allowed */
    if (slope > 0) f->slope = slope;
  }
  if (!(f->slope > 0)) f->slope = body->plan->beam.EA / body->plan->length;
  if (fabs(f->slip->length - f->origin) > f->most) return LOST;
  const int state = go_on(f, at, RANGE * size, FIRST * size);
  f->tried = 1;
  return state;
}

/* --- a round --------------------------------------------------------------------------- */

static sw_status keep(yielder *p, sw_error *err) {
  sw_scene *s = p->s;
  sw_tape_free(&p->start);
  p->next = sw_scene_course(s)->next;
  for (size_t k = 0; k < sw_scene_tool_slots(s); k++) p->jaws[k] = sw_scene_tool_in(s, k)->jaw;
  size_t k = 0;
  SW_EACH(hold, h, s) {
    feeder *f = &p->feeds[k++];
    const feeder old = *f;
    *f = (feeder){.slip = sw_slip_of(h), .slope = old.slope, .way = old.way};
    if (!f->slip) continue;
    f->base = f->slip->length;
    f->origin = old.slip ? old.origin : f->base;
    f->most = old.slip ? old.most : FARTHEST * sw_scene_system(s)->bodies[h->wire].plan->length;
    sw_bracket_clear(&f->found);
  }
  const sw_status status = sw_live_take(s, &p->start);
  if (status != SW_OK) sw_fail(err, status, "scene '%s': out of memory", sw_scene_name(s));
  return status;
}

static sw_status back(yielder *p, sw_error *err) {
  for (size_t k = 0; k < sw_scene_tool_slots(p->s); k++)
    sw_scene_tool_in(p->s, k)->jaw = p->jaws[k];
  SW_TRY(sw_live_back(p->s, &p->start, err));
  sw_scene_course(p->s)->next = p->next;
  return SW_OK;
}

/* Finds the equilibrium with the lengths of this trial. */
static sw_status try(yielder *p, sw_error *err) {
  sw_settle_report trial = {0};
  sw_system *system = sw_scene_system(p->s);
  const sw_status status = sw_scene_held_rest(p->s, p->args, p->interrupted, &trial, err);
  trial.iterations += p->report->iterations;
  *p->report = trial;
  SW_TRY(status);
  SW_TRY(sw_system_place_holds(system, sw_scene_time(p->s), system->x, NULL, NULL, err));
  sw_system_refresh(system);
  return SW_OK;
}

/* Corrects all feeds after a trial. Returns SEEKS if another trial must follow, else the worst
 * state. */
static int correct_all(yielder *p) {
  int any[STATES] = {0}, worst = STATES - 1;
  size_t k = 0;
  SW_EACH(hold, h, p->s) {
    feeder *f = &p->feeds[k++];
    if (f->slip) any[correct(p, h, f)] = 1;
  }
  while (worst > AS_ASKED && !any[worst]) worst--;
  return any[SEEKS] && worst != LOST ? SEEKS : worst;
}

/* Locks all feeds where the round began; SW_OK: the scene rests there. */
static sw_status hold_still(yielder *p, sw_error *err) {
  SW_ITEMS(feeder, f, p->feeds, p->count)
    if (f->slip) set(f, 0);
  SW_TRY(back(p, err));
  return try(p, err);
}

/* One round. *state: BEYOND if another must follow. If it fails, the scene is as at its start. */
static sw_status round_of(yielder *p, int *state, sw_error *err) {
  sw_error why = {"out of memory"};
  int failed = 0;
  *state = SEEKS;
  for (int trial = 0; trial < MOST_TRIALS; trial++) {
    if (trial > 0) SW_TRY(back(p, err));
    const sw_status status = try(p, &why);
    p->moved = trial > 0;
    if (status == SW_OK) {
      *state = correct_all(p);
      if (*state == LOST) break;
      if (*state != SEEKS) return SW_OK;
      continue;
    }
    if (status != SW_ENOCONV || trial == 0) {
      SW_ITEMS(feeder, f, p->feeds, p->count)
        if (f->slip) set(f, 0);
      SW_TRY(back(p, err));
      return sw_fail(err, status, "%s", why.text);
    }
    if (++failed > MOST_FAILED) break;
    SW_ITEMS(feeder, f, p->feeds, p->count)
      if (f->slip) set(f, 0.5 * (f->at + f->last));
  }
  *state = LOST;
  return hold_still(p, err);
}

/* --- all of it --------------------------------------------------------------------------- */

void sw_yield_tell(sw_scene *s) {
  SW_EACH(hold, h, s) {
    const sw_slip *f = sw_slip_of(h);
    if (!f) continue;
    const double force = sw_hold_way_of(s, h, sw_scene_time(s), NULL).force;
    const double want = isfinite(f->push) ? f->push : copysign(fmin(fabs(force), f->limit), force);
    if (!(fabs(force - want) > TOLD * sw_slip_scale(s, h, want))) continue;
    const sw_scene_wire *wire = sw_scene_wire_in(s, h->wire);
    sw_scene_tell(s, "held", h->name, h->s1 - wire->mesh.s[0], force,
                  "feed '%s' of wire '%s' bears %.4g N at rest instead of %.4g N: no stable "
                  "equilibrium with that force was found. It was held while the scene "
                  "settled; the next run lets it go",
                  h->name, wire->name, force, want);
  }
}

/* Ends all slips: at rest no wire slips, and the lengths are those now. */
static void stop_slips(sw_scene *s) {
  SW_EACH(hold, h, s) {
    sw_slip *f = sw_slip_of(h);
    if (!f) continue;
    f->length = sw_hold_way_of(s, h, sw_scene_time(s), NULL).slipped;
    f->since = sw_scene_time(s);
    f->speed = f->growth = f->way = 0;
    sw_slip_taken(f);
  }
}

/* *state: that of the last round. */
static sw_status search(yielder *p, int *state, sw_error *err) {
  int again = 0, confirmed = 0;
  for (int round = 0; round < MOST_ROUNDS; round++) {
    int changed = 0;
    SW_TRY(keep(p, err));
    SW_TRY(round_of(p, state, err));
    if (*state >= JUMPS && ++again > MOST_AGAIN) return SW_OK;
    sw_scene_follow_holds(p->s);
    const sw_status status = sw_feed_make_room(p->s, sw_scene_time(p->s), &changed, err);
    *state = status == SW_EEMPTY ? LOST : *state;
    if (status == SW_EEMPTY) return SW_OK;
    SW_TRY(status);
    /* a rest reached by a long path counts only if a search that begins there also rests there */
    if (*state == AS_ASKED && !changed && (!p->moved || ++confirmed > MOST_CONFIRMED)) return SW_OK;
    if (p->interrupted && p->interrupted()) return SW_EINTR;
  }
  *state = LOST;
  return SW_OK;
}

sw_status sw_scene_yielded_rest(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                                int *lost, sw_settle_report *report, sw_error *err) {
  int state = SEEKS;
  *lost = 0;
  stop_slips(s);
  yielder p = {.s = s,
               .args = args,
               .interrupted = interrupted,
               .report = report,
               .count = sw_scene_hold_slots(s)};
  sw_status status =
      SW_ALLOC_ALL(SW_ROOM(p.feeds, p.count), SW_ROOM(p.jaws, sw_scene_tool_slots(s)));
  if (status != SW_OK) sw_fail(err, status, "scene '%s': out of memory", sw_scene_name(s));
  if (status == SW_OK) status = search(&p, &state, err);
  *lost = state == LOST;
  sw_tape_free(&p.start);
  SW_FREE_ALL(p.feeds, p.jaws);
  return status;
}

sw_status sw_scene_clamped_rest(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                                sw_settle_report *report, sw_error *err) {
  stop_slips(s);
  return sw_scene_held_rest(s, args, interrupted, report, err);
}
