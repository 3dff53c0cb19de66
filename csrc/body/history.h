/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Carries the histories of forces over a change of the system. */
#ifndef SW_BODY_HISTORY_H
#define SW_BODY_HISTORY_H

#include "base/tape.h"
#include "force/force.h"
#include "scene/scene.h"
#include "state/plan.h"

/* History of a force on a wire between two systems. */
typedef struct sw_kept_history {
  size_t force, wire;
  const sw_force_class *inner; /* class of a force of the wire's recipe; NULL: one of the scene's
                                  forces */
  uint32_t generation;         /* of the force */
  sw_plan *plan;               /* retained */
  double *data;
} sw_kept_history;

/* Puts the forces' histories aside; gives them to the new system; drops them. */
sw_status sw_scene_keep_histories(sw_scene *scene);
void sw_scene_inherit_histories(sw_scene *scene);
void sw_scene_forget_histories(sw_scene *scene);

/* On a tape: contact memory and histories that an unbuilt scene keeps of its last system. */
void sw_tape_kept_contact(sw_tape *tape, sw_scene *scene);
void sw_tape_kept_history(sw_tape *tape, sw_scene *scene, sw_kept_history *history);

#endif
