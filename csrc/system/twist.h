/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The twist of spans inside a stage. Private to this room. */
#ifndef SW_SYSTEM_TWIST_H
#define SW_SYSTEM_TWIST_H

#include "system/system.h"

/* Director of a clamp or join before and now, and its turn about the director in between. */
typedef struct sw_clamp_change {
  sw_vec before, now;
  double turn; /* [rad] */
} sw_clamp_change;
sw_clamp_change sw_clamp_change_of(const sw_system *system, const sw_clamp_hinge *clamp);

/* Returns the change of a hinge's twist where its tangents go from (a0, b0) to (a, b) and carry the
 * edges along without a turn about themselves [rad]. */
double sw_hinge_change(sw_vec a0, sw_vec b0, sw_vec a, sw_vec b);

/* Computes the unit vectors of edges first to last, with nodes at x. */
void sw_edge_directions(size_t first, size_t last, const double *x, double *tx, double *ty,
                        double *tz);

/* Returns the change of a span's twist from the state to positions x (of the system). */
double sw_twist_change(const sw_system *system, const sw_body *body, size_t span, const double *x);

/* Computes the total twist of the body's spans with the field's present tangents. */
void sw_twist_measure(sw_system *system, sw_body *body);

/* Adds the effect of the twist's rank-one stiffness to a solved update (nodes x 3). Returns by how
 * many the negative directions become fewer. */
size_t sw_twist_correct(sw_body *body, double *delta);
/* Does this for another solution with the same factor. */
size_t sw_twist_correct_again(const sw_body *body, double *more);
/* Computes the torques added by the solution delta (twist_gain). */
void sw_twist_gain(sw_body *body, const double *delta);

/* Computes the slope of the twist at nodes from its slope at edges: into twist_rank, and without
 * held nodes into twist_solved. */
void sw_twist_gather(sw_body *body);

/* Returns the slope of one span times x (nodes x 3), without held nodes. */
double sw_twist_dot(const sw_body *body, const sw_span *span, const double *x);

/* Adds the twist's part to the reaction of a held node. */
void sw_twist_react(sw_held_node *held, const sw_body *body);

#endif
