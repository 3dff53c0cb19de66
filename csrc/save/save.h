/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a scene has, on a tape: that of a file, or a snapshot's, which stays at home. */
#ifndef SW_SAVE_SAVE_H
#define SW_SAVE_SAVE_H

#include "base/tape.h"
#include "body/live.h"
#include "grip/jaws.h"
#include "read/reading.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "system/system.h"

/* The whole scene. Reading fills an empty scene. From a tape at home it fills a scene that has the
 * system of the tape; the system then stays. live: the state of a scene that is built (then or
 * now). */
void sw_tape_scene(sw_tape *tape, sw_scene *scene, int *built, sw_live *live);

/* Each puts one object on the tape, or fills a slot from it, which the caller frees also after a
 * failure. placed: it says where particles are, for the scene is not built. */
void sw_tape_wire(sw_tape *tape, sw_scene_wire *wire, int placed);
void sw_tape_hold(sw_tape *tape, sw_scene *scene, sw_hold *hold);
void sw_tape_obstacle(sw_tape *tape, sw_scene *scene, sw_scene_obstacle *obstacle);
void sw_tape_force(sw_tape *tape, sw_scene_force *force);
void sw_tape_join(sw_tape *tape, sw_joint *join);
void sw_tape_rule(sw_tape *tape, sw_scene_rule *rule);
void sw_tape_frame(sw_tape *tape, const sw_scene *scene, sw_frame *frame);
void sw_tape_extreme(sw_tape *tape, sw_extreme *extreme);

/* Parts that say what an object is, not where it is. */
void sw_tape_beam_of(sw_tape *tape, sw_scene_wire *wire);
void sw_tape_hold_args(sw_tape *tape, sw_hold_args *args);

/* The contents of two scenes change places, for handles name a scene by its address, and the first
 * goes on where a tape says. On failure they are what they were. */
sw_status sw_scene_take_place(sw_scene *scene, sw_scene *other, const sw_live *live, int built,
                              const sw_snapshot *restoring, sw_error *err);

/* Everything was read: do the objects fit each other? SW_EFORMAT. */
void sw_tape_check_scene(sw_tape *tape, sw_scene *scene);

/* The scene goes away: its snapshots live on, good for nothing. */
void sw_scene_orphan_snapshots(sw_scene *scene);

#endif
