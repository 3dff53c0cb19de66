/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Feeds that yield to a force. Shared by the files of this room only. */
#ifndef SW_STEP_SLIP_H
#define SW_STEP_SLIP_H

#include "scene/scene.h"

/* 1 if there are feeds that yield to a force. */
int sw_slip_any(const sw_scene *scene);

#endif
