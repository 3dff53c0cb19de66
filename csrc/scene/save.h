/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a scene has, on a tape; of the files save*.c only. */
#ifndef SW_SCENE_SAVE_H
#define SW_SCENE_SAVE_H

#include "base/tape.h"
#include "scene/world.h"

/* Each puts one object on the tape, or fills an empty slot from it, which the caller frees also
 * after a failure. */
void sw_tape_wire(sw_tape *tape, sw_scene_wire *wire);
void sw_tape_hold(sw_tape *tape, sw_scene *scene, sw_scene_hold *hold);
void sw_tape_strand(sw_tape *tape, sw_strand *strand);
void sw_tape_tool(sw_tape *tape, sw_scene *scene, sw_tool *tool);
void sw_tape_jaw(sw_tape *tape, sw_jaw *jaw);
void sw_tape_frozen(sw_tape *tape, sw_frozen **frozen); /* or NULL */
int sw_frozen_fits(const sw_frozen *frozen, const sw_scene *scene);
void sw_tape_obstacle(sw_tape *tape, sw_scene *scene, sw_scene_obstacle *obstacle);
void sw_tape_force(sw_tape *tape, sw_scene_force *force);
void sw_tape_join(sw_tape *tape, sw_scene_join *join);
void sw_tape_rule(sw_tape *tape, sw_scene_rule *rule);
void sw_tape_frame(sw_tape *tape, const sw_scene *scene, sw_frame *frame);
void sw_tape_extreme(sw_tape *tape, sw_extreme *extreme);

/* What a scene that is not built remembers of its last system. */
void sw_tape_kept_contact(sw_tape *tape, sw_scene *scene);
void sw_tape_kept_history(sw_tape *tape, sw_scene *scene, sw_kept_history *history);

/* The state of one that is. */
void sw_tape_live(sw_tape *tape, sw_live *live);

/* Parts that say what an object is, not where it is. */
void sw_tape_beam_of(sw_tape *tape, sw_scene_wire *wire);
void sw_tape_hold_args(sw_tape *tape, sw_hold_args *args);

/* Everything was read: do the objects fit each other? SW_EFORMAT. */
void sw_tape_check_scene(sw_tape *tape, sw_scene *scene);

#endif
