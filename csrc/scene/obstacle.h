/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An obstacle of the scene. */
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
  int off;              /* 1: contact is off, wires pass through it */
  uint32_t next_driven; /* in the list of sw_scene_driven: slot + 2 of the next one, 1: it is the
                           last; 0: not in the list */
  sw_contact_past past;
  sw_log log;
  size_t
      logged; /* count of the scene's contact steps that are in its log or came before its start */
} sw_scene_obstacle;

#endif
