/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds: clamps, pins, grips, feeds. Of the scene's inside. */
#ifndef SW_BODY_HOLD_H
#define SW_BODY_HOLD_H

#include "link/hold.h"
#include "scene/scene.h"

/* A stage was solved, see sw_coupling. */
void sw_hold_book(sw_scene *scene, const sw_booking *booking);
/* 1: the step that led here had a jerk, so the hold's load at its end differs from its mean over
 * the step. The means, about the hold's place [N], [N m]. */
int sw_hold_jerked(const sw_scene *scene, const sw_hold *hold, sw_vec *force, sw_vec *moment);
/* What is written beside a force: above 0 the time that it is the mean of, below 0 the step at
 * whose end it is the force [s]. */
double sw_hold_span(const sw_scene *scene, int mean);

/* Nodes for the wire's living holds in another mesh of the same length. SW_ENOMEM. */
sw_status sw_scene_make_places(const sw_scene *scene, size_t wire, sw_mesh *mesh);

/* SW_EINVAL, naming the hold that is in the way, when one between s1 and s2, rings of a mesh, is
 * on another living hold of the wire or too near it; what: who asks [m]. */
sw_status sw_scene_check_clear(const sw_scene *scene, size_t wire, const sw_hold *self,
                               const char *what, double s1, double s2, sw_error *err);
/* SW_EINVAL, naming both, when two living holds hold the same node or particle. */
sw_status sw_scene_check_holds(const sw_scene *scene, sw_error *err);
/* Its wire, as links see it. */
sw_link_wire sw_scene_link_wire(const sw_scene *scene, size_t wire);
/* A state was accepted, and the scene has its time: meshes and holds follow. */
void sw_scene_follow_holds(sw_scene *scene);
/* What slides of the wire was given another speed: its holds know it. */
void sw_scene_take_rails(sw_scene *scene, size_t wire);
/* Plans back to the meshes, before these are read. */
void sw_scene_undo_holds(sw_scene *scene);
/* Way and force of a hold through which wire goes, see sw_hold_acts. */
sw_hold_way sw_hold_way_of(const sw_scene *scene, const sw_hold *hold, double t, const double *x);

#endif
