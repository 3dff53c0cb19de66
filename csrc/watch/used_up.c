/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words about pads whose friction is used up, where a search for equilibrium has failed. */
#include <math.h>
#include <stdio.h>

#include "scene/gripper.h"
#include "scene/parts.h"
#include "watch/observe.h"

/* Poses follow the pull in steps, so the last one that was found may lie this far below what the
 * pads can hold [-]. */
static const double NEARLY = 0.9;

void sw_scene_tell_used_up(const sw_scene *s, char *out, size_t size) {
  const sw_tool *most = NULL;
  out[0] = 0;
  SW_EACH(tool, t, s) {
    const int holds = t->alive && t->now.most > 0 && t->now.margin >= NEARLY;
    if (holds && (!most || t->now.margin > most->now.margin)) most = t;
  }
  if (!most) return;
  snprintf(out, size,
           "; the pads of gripper '%s' use up their friction of %.3g N (margin %.3f): if the wire "
           "slips, no equilibrium exists with this pull",
           most->name, most->now.most, most->now.margin);
}
