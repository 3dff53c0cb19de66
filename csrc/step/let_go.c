/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newton's iteration may find an equilibrium in which the wire lies beside the pads that hold it.
 * Pads let go only where there is none with the wire between them. */
#include "step/let_go.h"

#include <math.h>

#include "grip/held.h"
#include "scene/parts.h"

/* 1 if a wire is pressed from both sides. One finger alone pushes it away. */
static int presses(const sw_contact *c, const sw_tool *t) {
  unsigned fingers = 0; /* one bit for each that presses */
  for (size_t k = 0; k < sw_contact_touches(c); k++) {
    const int finger = sw_held_finger(c, t, k);
    if (finger >= 0) fingers |= 1u << finger;
  }
  return (fingers & (fingers - 1)) != 0 || (fingers && t->fingers == 1);
}

int sw_jaws_let_go(const sw_scene *s) {
  const sw_contact *c = sw_scene_contact(s);
  for (size_t k = 0; c && k < sw_scene_tool_slots(s); k++) {
    const sw_tool *t = sw_scene_tool_in(s, k);
    if (t->frozen || t->jaw.mode != SW_JAW_FORCE || t->jaw.status != SW_JAW_HOLDS) continue;
    if (t->pads && !presses(c, t)) return 1;
  }
  return 0;
}

static const double STRAINED = 0.5; /* deviation from the wanted force, over it [-] */

int sw_jaws_strained(const sw_scene *s) {
  SW_EACH(tool, t, s) {
    const sw_jaw *j = &t->jaw;
    if (t->alive && j->mode == SW_JAW_FORCE && j->status == SW_JAW_HOLDS &&
        fabs(j->now / j->force - 1.0) > STRAINED)
      return 1;
  }
  return 0;
}
