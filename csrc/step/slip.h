/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Feeds that yield to a force. Private to this room. */
#ifndef SW_STEP_SLIP_H
#define SW_STEP_SLIP_H

#include "link/hold.h"
#include "scene/scene.h"

/* 1 if there are feeds that yield to a force. */
int sw_slip_any(const sw_scene *scene);
/* Returns the slip of a hold that yields, or NULL. */
sw_slip *sw_slip_of(sw_hold *hold);
/* Returns the scale for deviations of a hold's force: the wanted force, the wire's weight or EI/L2
 * [N]. */
double sw_slip_scale(const sw_scene *scene, const sw_hold *hold, double want);
/* Logs an event for each feed whose recorded force at the end of a step of this size is not the one
 * that it obeys [s]. */
void sw_slip_tell(sw_scene *scene, double step);
/* SW_ELIMIT: a feed whose force nothing holds back has made its wire far longer than drawn. */
sw_status sw_slip_check(const sw_scene *s, sw_error *err);

#endif
