/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses and motions of holds, obstacles and grippers, as the user sets and reads them. */
#ifndef SW_SCENE_DRIVEN_H
#define SW_SCENE_DRIVEN_H

#include "motion/motion.h"
#include "scene/scene.h"

/* Lets a hold, an obstacle or a gripper follow a motion from now on (retains it); relative: on top
 * of its present pose. An absolute motion that does not start at the present pose is refused. NULL
 * stops it where it is. */
sw_status sw_scene_object_follow(sw_scene *scene, sw_kind kind, sw_handle of, sw_motion *motion,
                                 int relative, sw_error *err);
/* Stops it at the pose from now on. */
sw_status sw_scene_object_put(sw_scene *scene, sw_kind kind, sw_handle of, sw_pose pose,
                              sw_error *err);
/* Returns the present pose; of a released hold, the pose at its release. */
sw_status sw_scene_object_pose(sw_scene *scene, sw_kind kind, sw_handle of, sw_pose *out,
                               sw_error *err);

#endif
