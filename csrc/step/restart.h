/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps whose method starts anew. Shared by the files of this room only. */
#ifndef SW_STEP_RESTART_H
#define SW_STEP_RESTART_H

#include "scene/scene.h"

/* 1: something that holds a wire starts, stops or turns a corner at once at the present time. */
int sw_scene_jerks(sw_scene *scene);

#endif
