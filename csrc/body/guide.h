/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Guides: holds through which wire passes within a step. */
#ifndef SW_BODY_GUIDE_H
#define SW_BODY_GUIDE_H

#include "link/hold.h"
#include "scene/scene.h"

/* Returns the largest step up to h that nodes can follow [s]. */
double sw_feed_step(const sw_scene *scene, double h);
/* Fails with SW_ENOCONV, naming the feed that is too fast to follow and why longer steps were
 * refused. */
sw_status sw_feed_too_fast(const sw_scene *scene, const char *refused, sw_error *err);
/* Inserts and removes nodes beside guides for a step to time t. changed: 1 if the system was made
 * anew. SW_EEMPTY: no wire is left to draw in. */
sw_status sw_feed_make_room(sw_scene *scene, double t, int *changed, sw_error *err);
#endif
