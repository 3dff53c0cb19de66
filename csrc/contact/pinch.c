/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds whether a wire is pinched between two obstacles, or two flanks of one obstacle's hollow.
 * There only the touches give way: stiffer touches press more, and the wire stays as deep as
 * before. */
#include <math.h>

#include "contact/touch.h"

/* 1 if the other touch is at the same node or a neighbouring one, and may press against this
 * one. */
static int is_near(const sw_touch *t, const sw_touch *other) {
  return other->body == t->body && other->node <= t->node + 1 && t->node <= other->node + 1;
}

static int faces(const sw_touch *t, const sw_touch *other) {
  return other->press.normal_force > 0 && sw_dot(other->press.normal, t->press.normal) < SW_FACING;
}

/* Facing touches up to this far apart are at one place [edges]. */
static const double ONE_PLACE = 0.1;

/* Place along the wire [edges]. */
static double place_of(const sw_touch *t) {
  return (double)t->node + (t->other != t->node ? fmin(fmax(t->at, 0.0), 1.0) : 0.0);
}

static int is_pad(const sw_contact *c, const sw_touch *t) {
  return c->obstacles[t->obstacle].grips > 0;
}

/* A facing touch on one side only is no pinch: the wire turns between both, as an end that pokes at
 * one wall behind a corner of the other. Pads are made to pinch; the outermost touch of one pad may
 * lie beyond those of the other (spec/contact/round_pad_spec). */
int sw_contact_is_pinched(const sw_contact *c, const sw_touch *t) {
  const sw_touch *const first = c->touches, *const end = first + c->touch_count;
  int before = 0, after = 0;
  const sw_touch *from = t, *to = t + 1;
  while (from > first && is_near(t, from - 1)) from--;
  while (to < end && is_near(t, to)) to++;
  for (const sw_touch *other = from; other < to; other++) {
    if (other == t || !faces(t, other)) continue;
    if (is_pad(c, t) && is_pad(c, other)) return 1;
    const double way = place_of(other) - place_of(t);
    if (way < ONE_PLACE) before = 1;
    if (way > -ONE_PLACE) after = 1;
  }
  return before && after;
}
