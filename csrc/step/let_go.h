/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pads that would lose their wire in one pose. Private to this room. */
#ifndef SW_STEP_LET_GO_H
#define SW_STEP_LET_GO_H

#include "scene/scene.h"

/* After a trial of a pose: 1 if jaws that held with their force no longer press on anything. */
int sw_jaws_let_go(const sw_scene *scene);

#endif
