/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a scene on a tape: the tape of a file, or that of a snapshot, which stays in the process
 * ("at home"). */
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

/* Writes or reads the whole scene. Reading fills an empty scene or, from a tape at home, a scene
 * that has the tape's system, which then stays. live: the state of a built scene (at writing, or
 * read from the tape). */
void sw_tape_scene(sw_tape *tape, sw_scene *scene, int *built, sw_live *live);

/* Each writes one object to the tape, or fills a slot from it; the caller frees the slot also after
 * a failure. placed = 1: the tape holds the particles' places, because the scene is not built. */
void sw_tape_wire(sw_tape *tape, sw_scene_wire *wire, int placed);
void sw_tape_hold(sw_tape *tape, sw_scene *scene, sw_hold *hold);
void sw_tape_obstacle(sw_tape *tape, sw_scene *scene, sw_scene_obstacle *obstacle);
void sw_tape_force(sw_tape *tape, sw_scene_force *force);
void sw_tape_join(sw_tape *tape, sw_joint *join);
void sw_tape_rule(sw_tape *tape, sw_scene_rule *rule);
void sw_tape_frame(sw_tape *tape, const sw_scene *scene, sw_frame *frame);
void sw_tape_extreme(sw_tape *tape, sw_extreme *extreme);

/* Only the parts that define an object, without its state. */
void sw_tape_beam_of(sw_tape *tape, sw_scene_wire *wire);
void sw_tape_hold_args(sw_tape *tape, sw_hold_args *args);

/* Exchanges the contents of two scenes, because handles name a scene by its address; the first
 * scene then goes on where a tape says. On failure both stay as they were. */
sw_status sw_scene_take_place(sw_scene *scene, sw_scene *other, const sw_live *live, int built,
                              const sw_snapshot *restoring, sw_error *err);

/* Checks after reading whether the objects fit each other. SW_EFORMAT. */
void sw_tape_check_scene(sw_tape *tape, sw_scene *scene);

/* The scene is freed: its snapshots live on but can no longer be restored. */
void sw_scene_orphan_snapshots(sw_scene *scene);

#endif
