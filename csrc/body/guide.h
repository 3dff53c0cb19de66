/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps in which wire goes through holds. Of this room and of steps. */
#ifndef SW_BODY_GUIDE_H
#define SW_BODY_GUIDE_H

#include "link/hold.h"
#include "scene/scene.h"

/* The largest step up to h that nodes can follow [s]. */
double sw_feed_step(const sw_scene *scene, double h);
/* SW_ENOCONV: which feed goes faster than steps can follow, and why longer ones were refused. */
sw_status sw_feed_too_fast(const sw_scene *scene, const char *refused, sw_error *err);
/* Insert and remove nodes beside guides as a step to time t needs. changed: the system was
 * made anew. SW_EEMPTY: no wire left to draw in. */
sw_status sw_feed_make_room(sw_scene *scene, double t, int *changed, sw_error *err);
#endif
