/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports wires and objects whose solid elements get none of the damping that was asked for: a
 * damping's stiffness damps springs only (force/damping.c). */
#include <math.h>

#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

/* 1 if a particle of the body moves. In poses none does, and dashpots have no force. */
static int moves(const sw_system *s, const sw_body *b) {
  const double *v = s->v + 3 * b->first_node;
  for (size_t i = 0; i < 3 * b->plan->nodes; i++)
    if (v[i] != 0) return 1;
  return 0;
}

void sw_scene_watch_undamped(sw_scene *s, size_t wire) {
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  if (!(b->axial_time > 0) || !b->plan->web || !b->plan->web->solids || !moves(system, b)) return;
  const char *name = sw_scene_wire_in(s, wire)->name;
  sw_scene_tell(s, "undamped", name, (double)NAN, b->axial_time,
                "a damping's stiffness, here %.3g s, does not damp solid elements: '%s' may swing "
                "farther, and have larger peaks, than a rod or springs; give mass [1/s] instead, "
                "or take a model without solid elements",
                b->axial_time, name);
}
