/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pads that would lose their wire in one pose. Private to this room. */
#ifndef SW_STEP_LET_GO_H
#define SW_STEP_LET_GO_H

#include "scene/scene.h"

/* After a trial of a pose: 1 if jaws that held with their force no longer press on anything. */
int sw_jaws_let_go(const sw_scene *scene);

/* 1 if jaws hold with another force than the wanted one: they bear what they could not with it. */
int sw_jaws_strained(const sw_scene *scene);

#endif
