/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ties that break. */
#ifndef SW_EDIT_TIE_H
#define SW_EDIT_TIE_H

#include "scene/scene.h"

/* 1: there is a tie that has a strength, and is not broken. */
int sw_scene_may_break(const sw_scene *scene);
/* SW_ENOCONV when a tie is pulled far beyond its strength with nodes at x: it breaks earlier. */
sw_status sw_scene_check_ties(const sw_scene *scene, const double *x, sw_error *err);
/* After a step, before histories follow: ties that were pulled too hard break. */
void sw_scene_watch_ties(sw_scene *scene);

#endif
