/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step of fixed size, halved where it has to be: where nothing else helps, and where blows and
 * what wires pass ask for it. */
#include "scene/parts.h"

#include <math.h>

#include "body/guide.h"
#include "scene/course.h"
#include "step/blow.h"
#include "step/coarse.h"
#include "step/energy.h"
#include "step/passing.h"
#include "step/restart.h"
#include "step/slip.h"
#include "watch/observe.h"

/* A first step after a jump knows no accelerations, and its reactions are off by their own
 * size, by which slips would be wrong: it is kept to this share [-]. */
static const double FIRST_SLIP = 1e-3;

/* Parts end with their step: the difference of two times is known to no more than so much of a
 * part, and what that leaves is no part [-]. */
static const double ROUNDING = 1e-6;

typedef struct parts {
  double h, t0, t1;  /* of the whole step: size, start, exact end [s] */
  double done, part; /* so much is behind; what is tried now [s] */
  double whole;      /* what is tried now, were it not cut at the step's end [s] */
  double longest;    /* part that was taken [s] */
  int refused;       /* parts */
  double doubted;    /* a part that is coarse, while a shorter one is tried instead; 0: none [s] */
  double struck;     /* a part that has a blow in it, while none of those that follow it went
                        well; 0: none [s] */
  int unfollowed;    /* 1: that part is tried again, to be taken */
  double over;       /* by so much the last part that was tried is [-] */
  int worse;         /* shorter parts on end that were as coarse */
  int rough;         /* 1: coarse ones are taken in this step, for shorter ones do not help */
  int starts, cut;   /* 1: the part is short, for reactions are to be known; for a rebound */
  sw_error failed;   /* why a part was refused last */
} parts;

/* The part may be shorter than asked for; there are nodes for it. */
static sw_status begin(sw_ladder *p, parts *k, sw_error *err) {
  const double left = k->h - k->done;
  k->part = k->whole = sw_blow_part(p->s, k->part);
  if (k->part > left * (1 - ROUNDING)) k->part = left;
  /* there may be many parts */
  if (k->done > 0 && p->interrupted && p->interrupted()) return SW_EINTR;
  SW_TRY(sw_ladder_make_room(p, &k->part, err));
  sw_restart_at_jerk(p->s);
  if (k->part >= SW_SMALLEST_SHARE * SW_SMALLEST_SHARE * k->h) return SW_OK;
  return sw_feed_too_fast(p->s, k->failed.text, err);
}

/* What strikes, or begins to pull, late in a part may do so in a shorter one too, and be as coarse
 * there: so many shorter parts may be [-]. */
enum { MOST_WORSE = 1 };

/* A part that is coarse is not taken unless shorter ones are as coarse: then something jumps in it,
 * a wire that rolls onto a drum, and it is taken as it was. may_grow: see below. */
static int is_coarse(const sw_ladder *p, parts *k, int *may_grow) {
  const double over = k->rough ? 0.0 : sw_coarse_of(p->s, HUGE_VAL);
  sw_snap snap;
  const int snaps = over > 1 && sw_scene_ties_snap(p->s, &snap);
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
  if (!(shorter < k->part)) return 0;
  if (helps) k->doubted = k->part;
  k->over = over;
  k->part = shorter;
  return 1;
}

/* The trial converged, but it contains a blow, went past a force, or is coarse. may_grow: 1, one of
 * twice the size would not be. */
static int is_too_long(const sw_ladder *p, parts *k, int *may_grow) {
  if (!k->unfollowed && sw_blow_begins(p->s, k->part)) {
    k->struck = k->part;
    return 1;
  }
  const double passes = sw_passing_of(p->s, sw_scene_course(p->s)->stepper.trial_x);
  const double shorter = sw_passing_part(k->part, passes);
  if (!(shorter < k->part)) {
    const int coarse = is_coarse(p, k, may_grow);
    *may_grow &= passes <= 0.5;
    return coarse;
  }
  k->part = shorter;
  return 1;
}

/* A step begins in the parts that the one before ended in: to try it whole first would be in vain,
 * and one far too long cannot be told from a shock. Parts of a smaller share are of what is driven
 * into something, and are not gone on with [-]. */
static const double REMEMBERED = 1.0 / 33;

static double first_part(const sw_scene *s, double h) {
  const double part = sw_scene_course(s)->part;
  return part > REMEMBERED * h && part < h ? h * exp2(-ceil(log2(h / part) - ROUNDING)) : h;
}

static sw_status take(sw_ladder *p, parts *k, int may_grow, sw_error *err) {
  k->done += k->part;
  k->struck = 0, k->unfollowed = 0;
  k->longest = fmax(k->longest, k->part);
  if (!k->rough || (p->args->parts && !sw_coarse_applies(p->s))) sw_coarse_tell(p->s, k->part);
  sw_ladder_accept(p, k->part, k->done < k->h ? k->t0 + k->done : k->t1);
  if (p->redo != SW_AS_IS) sw_blow_refused(p->s, k->part);
  SW_TRY(sw_ladder_record(p, k->part, err));
  k->part = k->starts || k->cut ? k->h : may_grow ? 2 * k->part : k->part;
  if (k->whole > k->part) k->part = k->whole;
  k->starts = k->cut = 0;
  p->asked = fmin(k->h, fmax(p->asked, k->part));
  return SW_OK;
}

/* A part went well that is doubted, or has a blow in it that cannot be followed: it is taken. 0:
 * there is none [s]. */
static double part_that_went(const sw_ladder *p, const parts *k) {
  const int followed = isfinite(sw_blow_part(p->s, HUGE_VAL));
  if (k->cut) return 0;
  return k->doubted > 0 ? k->doubted : followed ? 0.0 : k->struck;
}

/* The status, unless a smaller part may go well. */
static sw_status refuse(sw_ladder *p, parts *k, sw_status status, const sw_error *err) {
  if (sw_ladder_hopeless(status)) return status;
  k->failed = p->held = *err;
  p->report->rejected++, k->refused++;
  k->cut = p->soonest > 0;
  p->cuts += k->cut;
  if (!k->cut) sw_blow_refused(p->s, k->part);
  sw_restart_refused(p, k->cut);
  const double went = part_that_went(p, k);
  if (went > 0) {
    k->rough = 1, k->unfollowed = 1;
    k->part = went, k->doubted = k->struck = 0;
    return SW_OK;
  }
  k->part = k->cut ? p->soonest : 0.5 * k->part;
  return k->part < SW_SMALLEST_SHARE * k->h ? status : SW_OK;
}

/* A bundle that falls or is pressed converges badly for many steps on end, and each part that fails
 * costs as much as several that go well: the next step begins in parts that went, or once went
 * twice as long. */
static void remember(sw_scene *s, const parts *k) {
  sw_course *c = sw_scene_course(s);
  const int shorter = c->blow_until > sw_scene_time(s) - 0.5 * k->h; /* so was this step */
  if (!sw_coarse_is_bundle(s) || !(k->refused || shorter)) return;
  const double part = k->refused > 1 ? k->longest : 2 * (k->refused ? k->longest : c->blow_part);
  c->blow_part = part;
  c->blow_until = part < k->h ? sw_scene_time(s) + 0.5 * k->h : 0.0;
}

sw_status sw_step_fixed(sw_ladder *p, double h, double t1, sw_error *err) {
  parts k = {.h = h, .t0 = sw_scene_time(p->s), .t1 = t1, .part = first_part(p->s, h)};
  p->asked = k.part;
  k.starts = sw_scene_course(p->s)->next && sw_slip_any(p->s);
  if (k.starts) k.part = FIRST_SLIP * h;
  p->cuts = 0;
  p->changed = sw_restart_changed(p->s);
  k.rough = !p->args->parts || !sw_coarse_applies(p->s);
  while (k.done < h) {
    int may_grow = 1;
    SW_TRY(begin(p, &k, err));
    const int smallest = 0.5 * k.part < SW_SMALLEST_SHARE * h;
    const sw_retries redone = sw_scene_books(p->s)->sums.redone;
    const sw_status status = sw_ladder_try(p, k.part, smallest, err);
    if (status == SW_OK && is_too_long(p, &k, &may_grow)) {
      sw_ladder_undo(p);
      sw_scene_books(p->s)->sums.redone = redone; /* of steps that are taken */
      p->asked = k.part;
    } else {
      SW_TRY(status == SW_OK ? take(p, &k, may_grow, err) : refuse(p, &k, status, err));
    }
  }
  sw_scene_course(p->s)->part = k.rough || k.refused || k.part >= h ? 0.0 : k.part;
  remember(p->s, &k);
  return SW_OK;
}
