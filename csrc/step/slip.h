/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Feeds that yield to a force. Shared by the files of this room only. */
#ifndef SW_STEP_SLIP_H
#define SW_STEP_SLIP_H

#include "scene/scene.h"

/* Steps of feeds that yield to a force: begin one (0: there are none), correct the slips
 * after a trial (1: they were right), or put them back. */
int sw_slip_any(const sw_scene *scene);
int sw_slip_begin(sw_scene *scene);
int sw_slip_correct(sw_scene *scene, double h, int first);
void sw_slip_give_up(sw_scene *scene);

#endif
