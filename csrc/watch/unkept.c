/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In poses: reports pads that end with another force than the one that they are to keep. */
#include <math.h>

#include "scene/events.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "watch/observe.h"

/* Smaller deviations, over the wanted force, are not reported [-]. */
static const double COUNTS = 0.1;

/* 1 if the jaws could move on, so that their speed does not excuse them. */
static int has_time(const sw_jaw *j) { return fabs(j->speed) < j->most * (1 - 1e-9); }

void sw_scene_watch_unkept(sw_scene *s) {
  SW_EACH(tool, t, s) {
    const sw_jaw *j = &t->jaw;
    if (!t->alive || !t->pads || t->frozen || j->mode != SW_JAW_FORCE ||
        j->status != SW_JAW_HOLDS || !has_time(j))
      continue;
    const double off = j->now / j->force - 1.0;
    if (!(fabs(off) > COUNTS)) continue;
    sw_scene_tell(s, "unkept", t->name, (double)NAN, off,
                  "the pads of '%s' press with %.3g N instead of %.3g N: no equilibrium was found "
                  "with the wanted force. Take other steps, or a run without quasistatic",
                  t->name, j->now, j->force);
  }
}
