/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An obstacle of the scene. Of its inside. */
#ifndef SW_SCENE_OBSTACLE_H
#define SW_SCENE_OBSTACLE_H

#include "base/log.h"
#include "contact/contact.h"
#include "link/hold.h"
#include "scene/scene.h"

typedef struct sw_scene_obstacle {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE];
  sw_shape *shape;
  sw_drive drive;
  double friction, kinetic, restitution;
  int off; /* 1: wires pass through it for the time being */
  sw_contact_past past;
  sw_log log;
  size_t
      logged; /* of the scene's steps with contact: those that its log has, or was not there for */
} sw_scene_obstacle;

/* An obstacle's series begins now. The state is observed. Rows that are missing, of one or of all.
 * SW_ENOMEM. */
void sw_obstacle_log_begin(const sw_scene *scene, sw_scene_obstacle *obstacle);
sw_status sw_obstacle_log_state(sw_scene *scene);
sw_status sw_obstacle_log_fill(sw_scene *scene, sw_scene_obstacle *obstacle);
sw_status sw_obstacle_log_fill_all(sw_scene *scene);
sw_scene_obstacle *sw_scene_find_obstacle(const sw_scene *scene, sw_handle h, sw_error *err);

/* Mean force of wires on an obstacle over the last step, blows included, and its moment about a
 * point [N], [N m]. */
void sw_obstacle_mean(const sw_scene_obstacle *obstacle, sw_vec about, sw_vec *force,
                      sw_vec *moment);

#endif
