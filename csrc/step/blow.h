/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows of wires on obstacles, followed in parts of a step. Shared by the files of this room only.
 */
#ifndef SW_STEP_BLOW_H
#define SW_STEP_BLOW_H

#include "scene/scene.h"

/* The step to take: one that follows a blow is shorter than asked for [s]. */
double sw_blow_part(const sw_scene *scene, double h);
/* A trial step of size h that went well: does it have to be redone in parts, for something struck?
 */
int sw_blow_begins(sw_scene *scene, double h);
/* A part of a step was refused, or made energy [s]. */
void sw_blow_refused(sw_scene *scene, double part);

#endif
