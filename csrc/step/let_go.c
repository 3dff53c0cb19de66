/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newton's iteration may find an equilibrium in which the wire lies beside the pads that hold it.
 * Pads let go only where there is none with the wire between them. */
#include "step/let_go.h"

#include "grip/held.h"
#include "scene/parts.h"

static int presses(const sw_contact *c, const sw_tool *t) {
  for (size_t k = 0; k < sw_contact_touches(c); k++)
    if (sw_held_finger(c, t, k) >= 0) return 1;
  return 0;
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
