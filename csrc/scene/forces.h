/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A force of the scene. */
#ifndef SW_SCENE_FORCES_H
#define SW_SCENE_FORCES_H

#include "scene/scene.h"

typedef struct sw_scene_force {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE]; /* used in events, or "" */
  const sw_force_class *cls;
  long wire;    /* -1 = all */
  double scale; /* scale of the wire's mesh when the force was made [-] */
  double args[SW_FORCE_ARGS_MAX / sizeof(double)];
  uint32_t *particle; /* list of particles of a force on particles, to which args points; or NULL */
} sw_scene_force;

#endif
