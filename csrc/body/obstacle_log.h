/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series of the forces on obstacles. */
#ifndef SW_BODY_OBSTACLE_LOG_H
#define SW_BODY_OBSTACLE_LOG_H

#include "scene/obstacle.h"

/* begin: an obstacle's series begins now. state: records the observed state. fill: adds missing
 * rows. SW_ENOMEM. */
void sw_obstacle_log_begin(const sw_scene *scene, sw_scene_obstacle *obstacle);
sw_status sw_obstacle_log_state(sw_scene *scene);
sw_status sw_obstacle_log_fill(sw_scene *scene, sw_scene_obstacle *obstacle);
/* Returns the mean force of wires on an obstacle over the last step, with blows, and its moment
 * about a point [N], [N m]. */
void sw_obstacle_mean(const sw_scene_obstacle *obstacle, sw_vec about, sw_vec *force,
                      sw_vec *moment);

#endif
