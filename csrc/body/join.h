/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joins and ties between wires. */
#ifndef SW_BODY_JOIN_H
#define SW_BODY_JOIN_H

#include "link/joint.h"
#include "scene/scene.h"

/* Returns a living join of the wire, or NULL. */
const sw_joint *sw_scene_joined(const sw_scene *scene, size_t wire);
/* Writes the arc lengths of a wire's living joins to out (may be NULL); returns their number. */
size_t sw_scene_join_places(const sw_scene *scene, size_t wire, double *out);
/* Returns the wires of a joint, as links see them. */
void sw_scene_joint_wires(const sw_scene *scene, const sw_joint *join,
                          sw_link_wire out[SW_JOIN_ENDS]);
/* Before plans are made: numbers the places where rigid joins end spans of twist, after all holds.
 * Returns the number of both. */
size_t sw_scene_number_stops(sw_scene *scene);
/* Writes a wire's such places to out; returns their number. */
size_t sw_scene_stops(const sw_scene *scene, size_t wire, sw_hold_place *out);
/* 1 if a living joint ends a span of the wire's twist there, by the last numbering. */
int sw_scene_stop_at(const sw_scene *scene, size_t wire, double s);
/* Adds springs and hinges of the living joins to the new system. SW_ENOMEM. */
sw_status sw_scene_add_joins(sw_scene *scene);

#endif
