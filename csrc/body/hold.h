/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds: clamps, pins, grips, feeds. */
#ifndef SW_BODY_HOLD_H
#define SW_BODY_HOLD_H

#include "link/hold.h"
#include "scene/scene.h"

/* Books the holds' impulses after a solved stage, see sw_coupling. */
void sw_hold_book(sw_scene *scene, const sw_booking *booking);
/* 1 if the last step had a jerk, so that the hold's load at its end differs from the mean over it.
 * Sets the means, about the hold's place [N], [N m]. */
int sw_hold_jerked(const sw_scene *scene, const sw_hold *hold, sw_vec *force, sw_vec *moment);
/* Sets the load that the hold's read-outs would show if the last trial, of size `span`, became the
 * state; 0: at the state itself, a pose. The moment is about the hold's place [s], [N], [N m]. */
void sw_hold_coming_load(const sw_scene *scene, const sw_hold *hold, double span, sw_vec *force,
                         sw_vec *moment);
/* Returns the span written beside a force: above 0 the time that the force is a mean over; below 0
 * minus the step at whose end it acts [s]. */
double sw_hold_span(const sw_scene *scene, int mean);

/* Makes nodes for the wire's living holds in another mesh of the same length. SW_ENOMEM. */
sw_status sw_scene_make_places(const sw_scene *scene, size_t wire, sw_mesh *mesh);

/* SW_EINVAL, naming the hold in the way, when a hold from s1 to s2 (in a mesh: rings) would be on
 * or too near to another living hold of the wire [m]. what: who asks. */
sw_status sw_scene_check_clear(const sw_scene *scene, size_t wire, const sw_hold *self,
                               const char *what, double s1, double s2, sw_error *err);
/* SW_EINVAL, naming both, when two living holds hold the same node or particle. */
sw_status sw_scene_check_holds(const sw_scene *scene, sw_error *err);
/* Returns the wire as links see it. */
sw_link_wire sw_scene_link_wire(const sw_scene *scene, size_t wire);
/* Lets meshes and holds follow an accepted state; the scene has its time. */
void sw_scene_follow_holds(sw_scene *scene);
/* Call when the wire's velocities were set: holds on rails take over the speed of sliding. */
void sw_scene_take_rails(sw_scene *scene, size_t wire);
/* Writes plans back to the meshes, before these are read. */
void sw_scene_undo_holds(sw_scene *scene);
/* Returns way and force of a hold through which wire passes, see sw_hold_acts. */
sw_hold_way sw_hold_way_of(const sw_scene *scene, const sw_hold *hold, double t, const double *x);

#endif
