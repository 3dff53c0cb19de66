/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step of fixed size. It is divided into parts (substeps) if it fails, if a blow or coarse motion
 * needs shorter parts, or if a wire would move past a force of short reach. */
#include "scene/parts.h"

#include <math.h>

#include "body/guide.h"
#include "grip/jaws.h"
#include "scene/course.h"
#include "step/blow.h"
#include "step/buckle.h"
#include "step/coarse.h"
#include "step/energy.h"
#include "step/jaw.h"
#include "step/outer.h"
#include "step/passing.h"
#include "step/restart.h"
#include "step/slip.h"
#include "watch/observe.h"

/* The first step after a jump has no accelerations from an earlier step. Its reactions are off by
 * their own size and would make wires slip wrongly. It is shortened to this share [-]. */
static const double FIRST_SLIP = 1e-3;

/* The last part ends with its step. Remainders below this share of a part are rounding, not parts
 * [-]. */
static const double ROUNDING = 1e-6;

typedef struct parts {
  double h, t0, t1;  /* whole step: size, start, exact end [s] */
  double done, part; /* time done; part to try next [s] */
  double whole;      /* part to try if it were not cut at the step's end [s] */
  double longest;    /* longest part taken [s] */
  double least;      /* smallest part that is tried [s] */
  int refused;       /* number of refused parts */
  double doubted;    /* coarse part instead of which a shorter one is tried; 0: none [s] */
  double struck; /* part in which a blow was found; 0: none, or a part short enough for the blow has
                    converged [s] */
  double grew;   /* part instead of which a shorter one is tried, because a pushed wire buckles; 0:
                    none [s] */
  int unfollowed;  /* 1: that part is tried again and taken */
  double over;     /* error of the last part tried, over the allowed one [-] */
  double left;     /* the same of a part that cannot be shorter; 0: its error is allowed [-] */
  int worse;       /* successive shorter parts that were as coarse */
  int rough;       /* 1: coarse parts are taken in this step, because shorter ones do not help */
  int starts, cut; /* starts: 1: the part is short so that reactions become known; cut: 1: it ends
                      at a rebound */
  sw_error failed; /* why the last part was refused */
} parts;

/* Shortens the part where needed, and makes nodes for it. */
static sw_status begin(sw_ladder *p, parts *k, sw_error *err) {
  const double left = k->h - k->done;
  if (p->args->parts) SW_TRY(sw_restart_after_stop(p->s, k->h, err));
  k->whole = sw_blow_part(p->s, k->part);
  k->part = fmin(left, fmin(k->whole, sw_restart_part(p->s)));
  k->least = fmin(k->least, sw_blow_smallest(p->s));
  if (p->args->parts) SW_TRY(sw_restart_before_stop(p, &k->part, err));
  if (k->part > left * (1 - ROUNDING)) k->part = left;
  SW_TRY(sw_restart_until_break(p->s, &k->part, err));
  /* there may be many parts */
  if (k->done > 0 && p->interrupted && p->interrupted()) return SW_EINTR;
  SW_TRY(sw_ladder_make_room(p, &k->part, err));
  SW_TRY(sw_restart_at_jerk(p->s, k->part, err));
  if (k->part >= SW_SMALLEST_SHARE * SW_SMALLEST_SHARE * k->h) return SW_OK;
  return sw_feed_too_fast(p->s, k->failed.text, err);
}

/* A strike or pull that begins late in a part may also begin late in a shorter part, which is then
 * as coarse. This many shorter parts may be as coarse [-]. */
enum { MOST_WORSE = 1 };

/* 1 if the part is coarse and another one must be tried. If shorter parts are as coarse, something
 * jumps within them, such as a wire that rolls onto a drum; the longer part is then taken.
 * may_grow: see below. */
static int is_coarse(const sw_ladder *p, parts *k, int *may_grow) {
  const double over = k->rough ? 0.0 : sw_coarse_of(p->s, HUGE_VAL);
  sw_snap snap;
  const int snaps = over > 1 && sw_scene_ties_snap(p->s, 0, &snap);
  const double shorter = snaps ? sw_coarse_half(k->part, p->args->dt)
                               : sw_coarse_part(p->s, k->part, p->args->dt, over);
  *may_grow = sw_coarse_may_grow(p->s, over);
  const int helps = !(k->doubted > 0) || snaps || sw_coarse_helps(k->over, over);
  k->worse = helps ? 0 : k->worse + 1;
  if (k->worse > MOST_WORSE || (!helps && !(shorter < k->part))) {
    k->rough = 1;
    k->part = k->doubted, k->doubted = 0;
    return 1;
  }
  if (helps) k->doubted = 0;
  k->left = shorter < k->part ? 0.0 : over;
  if (!(shorter < k->part)) return 0;
  if (helps) k->doubted = k->part;
  k->over = over;
  k->part = shorter;
  return 1;
}

/* 1 if a converged trial contains a blow, moves a wire past a force, closes jaws too far, or is
 * coarse. may_grow: 1 if a part of twice the size would be fine too. */
static int is_too_long(const sw_ladder *p, parts *k, int *may_grow) {
  if (!k->unfollowed && sw_blow_begins(p->s, k->part)) {
    k->struck = k->part;
    return 1;
  }
  const double snaps = sw_blow_snap(p->s, k->part);
  if (!k->unfollowed && snaps < k->part) {
    k->part = snaps;
    return 1;
  }
  const int divides = p->args->parts && sw_coarse_applies(p->s);
  const double closes = divides ? sw_jaw_closes(p->s, k->part) : 0.0;
  const double passes = fmax(closes, sw_passing_of(p->s, sw_scene_course(p->s)->stepper.trial_x));
  const double grows = divides && !k->unfollowed ? sw_buckle_of(p->s, k->part) : 0.0;
  const double passed = sw_passing_part(k->part, passes), bent = sw_buckle_part(k->part, grows);
  if (!(fmin(passed, bent) < k->part)) {
    const int coarse = is_coarse(p, k, may_grow);
    *may_grow &= passes <= 0.5 && grows <= 0.5;
    return coarse;
  }
  if (!(passed < k->part)) k->grew = k->part; /* may be taken, if the shorter one fails */
  k->part = fmin(passed, bent);
  return 1;
}

/* A step starts with the last part size of the previous step. Trying the whole step first would
 * waste a solve, and the error of a far too long part looks like a shock. Parts below this share of
 * the step come from wires driven into an obstacle; the next step does not start with them [-]. */
static const double REMEMBERED = 1.0 / 33;

static double first_part(const sw_scene *s, double h) {
  const double part = sw_scene_course(s)->part;
  return part > REMEMBERED * h && part < h ? h * exp2(-ceil(log2(h / part) - ROUNDING)) : h;
}

static sw_status take(sw_ladder *p, parts *k, int may_grow, sw_error *err) {
  sw_outer_look outer;
  SW_TRY(sw_outer_look_at(p, k->part, &outer, err));
  sw_outer_taken(p->s, k->part, &outer);
  k->done += k->part;
  k->struck = k->grew = 0, k->unfollowed = 0;
  k->longest = fmax(k->longest, k->part);
  const int applies = sw_coarse_applies(p->s);
  if (!k->rough || (p->args->parts && !applies)) sw_coarse_tell(p->s, k->part);
  if (k->rough && p->args->parts && applies) sw_coarse_tell_rough(p->s, k->part);
  if (!k->rough) sw_coarse_tell_left(p->s, k->part, p->args->dt, k->left);
  k->left = 0;
  sw_ladder_accept(p, k->part, k->done < k->h ? k->t0 + k->done : k->t1);
  if (p->redo != SW_AS_IS) sw_blow_refused(p->s, k->part);
  sw_buckle_taken(p->s, k->part);
  SW_TRY(sw_ladder_record(p, k->part, err));
  k->part = k->starts || k->cut ? k->h : may_grow ? 2 * k->part : k->part;
  if (k->whole > k->part) k->part = k->whole;
  k->starts = k->cut = 0;
  p->asked = fmin(k->h, fmax(p->asked, k->part));
  return SW_OK;
}

/* Returns the size of an earlier part that converged and may be taken after all: a coarse one, one
 * with a blow that cannot be resolved, or one in which a pushed wire buckles; 0: there is none
 * [s]. */
static double part_that_went(const sw_ladder *p, const parts *k) {
  const int followed = isfinite(sw_blow_part(p->s, HUGE_VAL));
  if (k->cut) return 0;
  if (k->doubted > 0) return k->doubted;
  return !followed && k->struck > 0 ? k->struck : k->grew;
}

/* Sets a smaller part, or an earlier one that converged; returns the status if there is none. */
static sw_status refuse(sw_ladder *p, parts *k, sw_status status, const sw_error *err) {
  if (sw_ladder_hopeless(status)) return status;
  k->failed = p->held = *err;
  p->report->rejected++, k->refused++;
  k->cut = p->soonest > 0;
  p->cuts += k->cut;
  if (!k->cut) sw_blow_refused(p->s, k->part);
  sw_restart_refused(p, k->cut);
  const double went = part_that_went(p, k), half = 0.5 * k->part;
  const int shock = sw_coarse_is_shock(k->over); /* whole parts damp shocks, parts follow them */
  const int halves = k->doubted > 0 ? !shock : k->grew > 0;
  if (halves && went > 0 && half >= sw_coarse_shortest(p->args->dt)) {
    k->part = half;
    return SW_OK;
  }
  if (went > 0) {
    k->rough = 1, k->unfollowed = 1;
    k->part = went, k->doubted = k->struck = k->grew = 0;
    return SW_OK;
  }
  k->part = k->cut ? p->soonest : 0.5 * k->part;
  return k->part < k->least ? status : SW_OK;
}

/* Sets the first part of the next step of a bundle. A bundle that falls or is pressed converges
 * badly for many successive steps, and a failed part costs as much as several good ones. The next
 * step begins with the longest part that converged, or with twice that after at most one
 * refusal. */
static void remember(sw_scene *s, const parts *k) {
  sw_course *c = sw_scene_course(s);
  const int shorter = c->blow_until > sw_scene_time(s) - 0.5 * k->h; /* this step was already
                                                                        shorter */
  if (!sw_coarse_is_bundle(s) || !(k->refused || shorter)) return;
  const double part = k->refused > 1 ? k->longest : 2 * (k->refused ? k->longest : c->blow_part);
  c->blow_part = fmax(part, SW_SHORTEST_PART);
  c->blow_until = part < k->h ? sw_scene_time(s) + 0.5 * k->h : 0.0;
}

/* A remainder of a step below this share of it is not a step of its own [-]. */
static const double LEAST_REST = 0.01;

/* 1 if the step ends with this part because jaws have reached their target: a process that waits
 * for them continues at the end of a step. Pads that squeeze a mesh on a table push it down by its
 * widening sides until they lift it, with 0.24 N for a weight of 0.02 N. Without an early end this
 * push lasts until the step's end: the peak over the window was all of it in steps of 10 ms, and
 * 0.03 N in steps of 0.5 ms (spec/physics/grasp_ends_spec). moving: number of jaws closing on a
 * mesh before the part [-]. */
static int jaws_arrive(const sw_scene *s, const parts *k, size_t moving) {
  return moving > sw_jaw_moving(s) && k->h - k->done > LEAST_REST * k->h;
}

sw_status sw_step_fixed(sw_ladder *p, double h, double t1, sw_error *err) {
  parts k = {.h = h, .t0 = sw_scene_time(p->s), .t1 = t1, .part = first_part(p->s, h)};
  k.least = SW_SMALLEST_SHARE * h;
  p->asked = k.part;
  k.starts = sw_scene_course(p->s)->next && sw_slip_any(p->s);
  if (k.starts) k.part = FIRST_SLIP * h;
  p->cuts = 0;
  p->changed = sw_restart_changed(p->s);
  k.rough = !p->args->parts || !sw_coarse_applies(p->s);
  for (int arrived = 0; k.done < h && !arrived && !p->lost;) {
    int may_grow = 1;
    SW_TRY(begin(p, &k, err));
    const int smallest = 0.5 * k.part < k.least;
    const size_t moving = sw_coarse_has_mesh_in_jaws(p->s) ? sw_jaw_moving(p->s) : 0;
    const sw_retries redone = sw_scene_books(p->s)->sums.redone;
    const sw_status status = sw_ladder_try(p, k.part, smallest, err);
    if (status == SW_OK && is_too_long(p, &k, &may_grow)) {
      sw_ladder_undo(p);
      sw_scene_books(p->s)->sums.redone = redone; /* counts only steps that are taken */
      p->asked = k.part;
      continue;
    }
    const double t0 = sw_scene_time(p->s);
    if (status == SW_OK) SW_TRY(sw_grips_overloaded(p->s, t0, t0 + k.part, &p->lost, err));
    if (p->lost) {
      sw_ladder_undo(p);
      sw_scene_books(p->s)->sums.redone = redone;
    } else {
      SW_TRY(status == SW_OK ? take(p, &k, may_grow, err) : refuse(p, &k, status, err));
      arrived = jaws_arrive(p->s, &k, moving);
    }
  }
  sw_scene_course(p->s)->part = k.rough || k.refused || k.part >= h ? 0.0 : k.part;
  remember(p->s, &k);
  return SW_OK;
}
