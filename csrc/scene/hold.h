/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds: clamps, pins, grips, feeds. Of this room and of steps. */
#ifndef SW_SCENE_HOLD_H
#define SW_SCENE_HOLD_H

#include "link/hold.h"
#include "scene/objects.h"

/* A stage was solved, see sw_coupling. */
void sw_hold_book(sw_scene *scene, const sw_booking *booking);
/* The step that led here had a jerk: what the hold bore in it is not what it bears at its end.
 * Means over it, about its place [N], [N m]. */
int sw_hold_jerked(const sw_scene *scene, const sw_hold *hold, sw_vec *force, sw_vec *moment);
/* What is written beside a force: above 0 the time that it is the mean of, below 0 the step at
 * whose end it is the force [s]. */
double sw_hold_span(const sw_scene *scene, int mean);

sw_hold *sw_scene_find_hold(const sw_scene *scene, sw_handle h, sw_error *err);
/* The same of a hold that has not been released. */
sw_hold *sw_scene_living_hold(const sw_scene *s, sw_handle hold, sw_error *err);
/* Take hold of the redrawn mesh anew. The hold is not alive; those that are were there
 * before it. What drives it stays. SW_ENOMEM. */
sw_status sw_scene_retake_hold(sw_scene *scene, sw_hold *hold);
/* Nodes for the wire's living holds in another mesh of the same length. SW_ENOMEM. */
sw_status sw_scene_make_places(const sw_scene *scene, size_t wire, sw_mesh *mesh);
/* Where and how a hold holds, into another slot that owns nothing. SW_ENOMEM. */
sw_status sw_scene_copy_shape(const sw_hold *from, sw_hold *to);

/* A wire without frames has got some: its living holds keep it as they do, frames and all. */
void sw_scene_frame_holds(sw_scene *scene, size_t wire);
/* Take hold of a wire that has other nodes but lies as before; the hold's pose is known. It is
 * not alive; those that are have done so. SW_EINVAL when one of them is in the way; SW_ENOMEM. */
sw_status sw_scene_rehold(sw_scene *scene, sw_hold *hold, sw_pose pose, sw_error *err);

/* SW_EINVAL, naming the hold that is in the way, when one between s1 and s2, rings of a mesh, is
 * on another living hold of the wire or too near it; what: who asks [m]. */
sw_status sw_scene_check_clear(const sw_scene *scene, size_t wire, const sw_hold *self,
                               const char *what, double s1, double s2, sw_error *err);
/* SW_EINVAL, naming both, when two living holds hold the same node or particle. */
sw_status sw_scene_check_holds(const sw_scene *scene, sw_error *err);
/* Its wire, as links see it. */
sw_link_wire sw_scene_link_wire(const sw_scene *scene, size_t wire);
/* The scene's time is that of an accepted state: meshes and holds follow. */
void sw_scene_follow_holds(sw_scene *scene);
/* Plans back to the meshes, before these are read. */
void sw_scene_undo_holds(sw_scene *scene);
/* Way and force of a hold through which wire goes, see sw_hold_acts. */
sw_hold_way sw_hold_way_of(const sw_scene *scene, const sw_hold *hold, double t, const double *x);

#endif
