/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds whether a wire is pinched between two obstacles. There only the touches give way: stiffer
 * touches press more, and the wire stays as deep as before. */
#include "contact/touch.h"

/* 1 if the other touch is at the same node or a neighbouring one, and may press against this
 * one. */
static int is_near(const sw_touch *t, const sw_touch *other) {
  return other->body == t->body && other->node <= t->node + 1 && t->node <= other->node + 1;
}

static int faces(const sw_touch *t, const sw_touch *other) {
  return other->obstacle != t->obstacle && other->press.normal_force > 0 &&
         sw_dot(other->press.normal, t->press.normal) < SW_FACING;
}

int sw_contact_is_pinched(const sw_contact *c, const sw_touch *t) {
  const sw_touch *const first = c->touches, *const end = first + c->touch_count;
  for (const sw_touch *other = t; other > first && is_near(t, other - 1); other--)
    if (faces(t, other - 1)) return 1;
  for (const sw_touch *other = t + 1; other < end && is_near(t, other); other++)
    if (faces(t, other)) return 1;
  return 0;
}
