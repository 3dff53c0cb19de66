/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How steps follow waves of stretch in lines. Shared by the files of this room only. */
#ifndef SW_STEP_STRETCH_H
#define SW_STEP_STRETCH_H

#include "scene/scene.h"

struct sw_body;
/* 1 if it is a line along which waves travel in less than 1 ms. */
int sw_stretch_is_stiff(const struct sw_body *body);
/* Returns the error of the stretch of soft lines with friction in the last trial over the allowed
 * one; 0: there are none, or the method has no estimate [-]. */
double sw_stretch_over(const sw_scene *scene);

#endif
