/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far an iteration may move a wire in and beside a clip. In a seat with play nothing presses a
 * wire yet: an iteration towards rest would take it over the lips or through floor or wall, which
 * have an end, and the clip would not act on it any more. */
#include "force/clip_watch.h"

/* Largest way of an iteration into lips, floor or wall, over the way to their crest, behind which
 * they push the wire on. They push hardest half-way there, so a wire is pushed back before it
 * passes, and one that has to pass does so in some iterations more [-]. */
static const double INTO = 0.25;

/* A place before and after the move: u and v [m]. */
typedef struct move {
  double from[2], by[2];
} move;

/* What a place must not jump over. along: 0 = it extends in u, 1 = in v. */
typedef struct barrier {
  int along;
  double low, crest, high; /* on the way over it [m] */
  double ends[2];          /* in the other direction [m] */
} barrier;

/* Returns the share of the move that goes far enough into the barrier. */
static double share_at(const barrier *b, const move *m) {
  const double from = m->from[b->along], by = m->by[b->along];
  const double up = fmax(from, b->low) + INTO * (b->crest - b->low);
  const double down = fmin(from, b->high) - INTO * (b->high - b->crest);
  const int passes =
      by > 0 ? from < b->crest && from + by > up : from > b->crest && from + by < down;
  if (!passes) return 1.0;
  const double share = ((by > 0 ? up : down) - from) / by;
  const double aside = m->from[1 - b->along] + share * m->by[1 - b->along];
  return aside > b->ends[0] && aside < b->ends[1] ? share : 1.0;
}

static double share_of(const sw_clip_law *l, const move *m) {
  const double near = l->clearance, middle = near + l->reach, far = middle + l->reach;
  const barrier barriers[] = {
      {0, 0, l->out, l->out + l->in, {-far, far}}, /* lips */
      {0, -far, -middle, -near, {-far, far}},      /* floor */
      {1, -far, -middle, -near, {-far, l->out}},   /* walls */
      {1, near, middle, far, {-far, l->out}},
  };
  double share = 1.0;
  for (size_t k = 0; k < sizeof barriers / sizeof *barriers; k++)
    share = fmin(share, share_at(&barriers[k], m));
  return share;
}

double sw_clip_largest_share(const void *args, const sw_field *f, const double *delta) {
  if (sw_clip_is_broken(f->history)) return 1.0;
  const sw_clip c = sw_clip_of(args, &f->plan->beam);
  sw_field moved = *f;
  double share = 1.0;
  moved.x = delta;
  for (long e = sw_clip_find(&c, f, 0); e >= 0; e = sw_clip_find(&c, f, e + 1)) {
    sw_clip_walk w;
    if (!sw_clip_begin(&c, f, (size_t)e, &w)) continue;
    const double t = sw_clip_middle_share(&w);
    const sw_vec a = sw_axis_at(&moved, (size_t)e), b = sw_axis_at(&moved, (size_t)e + 1);
    const sw_vec by = sw_madd(sw_scale(a, 1.0 - t), b, t);
    move m = {.by = {sw_dot(by, c.direction), sw_dot(by, c.across)}};
    sw_clip_place_on(&w, t, m.from);
    share = fmin(share, share_of(&c.law, &m));
  }
  return share;
}
