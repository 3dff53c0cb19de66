/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records of every accepted state: histories, extremes, logs. Of the scene's inside. */
#ifndef SW_WATCH_OBSERVE_H
#define SW_WATCH_OBSERVE_H

#include "scene/scene.h"

/* After an accepted state, which holds and jaws follow: histories, extremes, logs. */
sw_status sw_scene_observe(sw_scene *scene, sw_error *err);
/* Steps are to begin at the state, whose holds are placed: the wear of wires goes on from it, and
 * zones see it. SW_ENOMEM. */
sw_status sw_scene_begin_watching(sw_scene *scene, sw_error *err);

#endif
