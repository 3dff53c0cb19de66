/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records of every accepted state: histories, extremes, logs. Part of the scene's inside, see
 * world.h. */
#ifndef SW_SCENE_OBSERVE_H
#define SW_SCENE_OBSERVE_H

#include "scene/scene.h"

struct sw_scene_obstacle;

/* After an accepted state: histories, extremes, logs. */
sw_status sw_scene_observe(sw_scene *scene, sw_error *err);
/* Extremes of wire w at the refreshed state. */
void sw_scene_wire_now(sw_scene *scene, size_t w, sw_wire_extremes *now);
/* The tensions of the run so far, the state now included. */
void sw_scene_run_tension(const sw_scene *scene, size_t wire, const sw_wire_extremes *now,
                          sw_wire_extremes *run);
/* Keep the larger ones, but for the tension. */
void sw_scene_keep_extremes(sw_wire_extremes *kept, const sw_wire_extremes *now);
void sw_scene_reset_extremes(sw_scene *scene);

/* Kinetic, elastic, gravity energy of the state [J]. */
void sw_scene_frame_energies(sw_scene *scene, double out[SW_FRAME_ENERGIES]);
sw_status sw_scene_store_frame(sw_scene *scene, sw_error *err);
void sw_scene_drop_frames(sw_scene *scene);

/* Mean force of wires on an obstacle over the last step, blows included, and its moment about a
 * point [N], [N m]. */
void sw_obstacle_mean(const struct sw_scene_obstacle *obstacle, sw_vec about, sw_vec *force,
                      sw_vec *moment);

#endif
