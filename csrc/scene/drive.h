/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drives: they move a hold, an obstacle or a gripper. */
#ifndef SW_SCENE_DRIVE_H
#define SW_SCENE_DRIVE_H

#include "base/tape.h"
#include "link/hold.h"
#include "scene/scene.h"

/* Evaluates the drive at time t. The scene refuses changes meanwhile, because the motion may be a
 * user's function. */
sw_status sw_drive_eval(sw_scene *scene, const sw_drive *drive, double t, sw_motion_state *out,
                        sw_error *err);
/* The same in a stage of the system: in an inner stage (sw_stage.inner) a drive is ahead of its
 * path, by the stage's length times the velocity and angular velocity at its end. */
sw_status sw_drive_place(sw_scene *scene, const sw_drive *drive, double t, sw_motion_state *out,
                         sw_error *err);
/* Lets the drive follow the motion from the scene's time on. SW_EINVAL if it goes with a
 * gripper. */
sw_status sw_drive_follow(sw_scene *scene, sw_drive *drive, const char *object, sw_motion *motion,
                          int relative, sw_error *err);
/* Stops the drive at the pose from now on. SW_EINVAL if it goes with a gripper. */
sw_status sw_drive_put(sw_scene *scene, sw_drive *drive, const char *object, sw_pose pose,
                       sw_error *err);
void sw_drive_free(sw_drive *drive);
void sw_tape_drive(sw_tape *tape, sw_scene *scene, sw_drive *drive);

/* 1 if the drive goes with no tool, and its motion has ended at time t, if it has one. */
int sw_drive_stands(const sw_drive *drive, double t);
/* 1 if the drive may change its place without an edit. */
static inline int sw_drive_moves(const sw_drive *drive) { return drive->motion || drive->tool; }

#endif
