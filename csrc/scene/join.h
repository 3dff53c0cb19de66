/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joins and ties between wires. Of this room and of steps. */
#ifndef SW_SCENE_JOIN_H
#define SW_SCENE_JOIN_H

#include "link/joint.h"
#include "scene/scene.h"

/* The living join that has the wire, or NULL. */
const sw_joint *sw_scene_joined(const sw_scene *scene, size_t wire);
/* The arc lengths of a wire's living joins into out (may be NULL); their number. */
size_t sw_scene_join_places(const sw_scene *scene, size_t wire, double *out);
/* Make their nodes anew in a wire that was drawn again and has its holds. SW_ENOMEM. */
sw_status sw_scene_retake_joins(sw_scene *scene, size_t wire);
/* Meshes are others: joins of wires that lie as drawn keep what these have now. */
void sw_scene_measure_joins(sw_scene *scene);
/* The wires of a joint, as links see them. */
void sw_scene_joint_wires(const sw_scene *scene, const sw_joint *join,
                          sw_link_wire out[SW_JOIN_ENDS]);
/* Springs and hinges of the living joins for the new system. SW_ENOMEM. */
sw_status sw_scene_add_joins(sw_scene *scene);
/* 1: there is a tie that has a strength, and is not broken. */
int sw_scene_may_break(const sw_scene *scene);
/* SW_ENOCONV when a tie is pulled far beyond its strength with nodes at x: it breaks earlier. */
sw_status sw_scene_check_ties(const sw_scene *scene, const double *x, sw_error *err);
/* After a step, before histories follow: ties that were pulled too hard break. */
void sw_scene_watch_ties(sw_scene *scene);
/* NULL: the scene does not know it. */
sw_joint *sw_scene_find_join(const sw_scene *scene, sw_handle join, sw_error *err);

#endif
