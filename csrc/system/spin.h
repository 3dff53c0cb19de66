/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies with material frames. The turn of each edge about itself is a fourth unknown of the node
 * at the edge's start. It is always in equilibrium, unless the wire rolls (roll.h). Private to this
 * room. */
#ifndef SW_SYSTEM_SPIN_H
#define SW_SYSTEM_SPIN_H

#include "system/system.h"

/* Returns the number of doubles in the state for a body with this plan; 0 without frames. */
size_t sw_spin_state_size(const sw_plan *plan);

/* Makes work space if the plan has frames. SW_ENOMEM. */
sw_status sw_spin_new(sw_body *body);

/* Returns the body's edge between held nodes `number` and `number` + 1 if both are the body's and
 * of one hold, else -1. */
long sw_spin_held_edge(const sw_system *system, const sw_body *body, size_t number);

/* Sets the iterate's frames and twist to those of the state. */
void sw_spin_begin(sw_system *system, sw_body *body);

/* Spins do not converge: sets them to the state's, and adds the section's inertia over hbar^2
 * against turns away from the state's frames; rate2 = 1/hbar^2. */
void sw_spin_slow_down(sw_system *system, double rate2);

/* Carries the iterate's frames to the field's present tangents. */
void sw_spin_carry(sw_system *system, sw_body *body);

/* Converts block rows of nodes (nodes x SW_ROW_SIZE, without held nodes) to those of nodes with
 * spins (nodes x SW_ROW4_SIZE). */
void sw_spin_assemble(const sw_body *body, const double *rows, double *out);

/* Fills the matrix (spin_rows) and the right-hand side (spin_delta); delta has the latter's part
 * for nodes (nodes x 3). */
void sw_spin_load(const sw_system *system, sw_body *body, const double *delta);

/* Solves for the update of nodes (delta, nodes x 3, in place) and spins, with the field's rows
 * without held nodes. Fails as sw_band4_factor. */
sw_status sw_spin_solve(const sw_system *system, sw_body *body, double *delta, size_t *negative);

/* Returns the turn of edge e's frame about the edge since the state [rad]. */
double sw_spin_turned(const sw_system *system, const sw_body *body, size_t e);

/* largest: the largest turn of the last solve [rad]. turn: turns the frames by a share of that
 * solve's turns. */
double sw_spin_largest(const sw_body *body);
void sw_spin_turn(sw_body *body, double share);

/* Turns the iterate's frames by share times angle[edge stride]. */
void sw_spin_turn_by(sw_body *body, const double *angle, size_t stride, double share);

/* begin: a stage begins at the system's yhat; rate2: factor of the inertia, 0 without inertia
 * [1/s2]. end: it ends at y (freedoms); writes the turns of rolling edges there. */
void sw_spin_begin_stage(sw_system *system, double rate2);
void sw_spin_end_stage(sw_system *system, double *y);

/* Small motions of a body with frames, (nodes x 4): the fourth value of a node is the turn of the
 * edge from there. free_turns: number of free turns with inertia. fix_held: sets the held turns to
 * zero. stiffness_times: adds the turns' part of K times a motion. mass_times: sets their part of M
 * times a motion. shift_rows: subtracts shift times their inertia from the rows. Turns that are not
 * free are not in the matrix. */
size_t sw_spin_free_turns(const sw_system *system, const sw_body *body);
void sw_spin_fix_held(const sw_system *system, const sw_body *body, double *motion);
void sw_spin_stiffness_times(const sw_body *body, const double *motion, double *out);
void sw_spin_mass_times(const sw_body *body, const double *motion, double *out);
void sw_spin_shift_rows(const sw_system *system, const sw_body *body, double shift, double *rows);

/* Adds the effect of the last solve's spins to the reaction of a held node. */
void sw_spin_react(sw_held_node *held, const sw_body *body);

/* The state takes the iterate's frames, carried to positions x: those of the body (take) or of the
 * system (follow). follow also turns held edges with their holds. */
void sw_spin_take(sw_system *system, sw_body *body, const double *x);
void sw_spin_follow(sw_system *system, sw_body *body, const double *x);

/* 0 if the iterates have led frames between two clamps through other turns than the straight way
 * from the state to the stage's end y. */
int sw_spins_are_whole(const sw_system *system, const double *y, int iterations);

/* Sets the field's frames to the state's. */
void sw_spin_show(sw_system *system, sw_body *body);

#endif
