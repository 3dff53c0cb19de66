/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies with material frames: the turn of each edge about itself is a fourth
 * unknown of the node where it starts, always in equilibrium. Private to this
 * room. */
#ifndef SW_SYSTEM_SPIN_H
#define SW_SYSTEM_SPIN_H

#include "system/system.h"

/* Doubles in the state of a body of this plan; 0 without frames. */
size_t sw_spin_state_size(const sw_plan *plan);

/* Make work space, if the plan asks for frames. SW_ENOMEM. */
sw_status sw_spin_new(sw_body *body);

/* The edge between held nodes number number and number + 1, if one hold has both and
 * they are the body's, or -1. */
long sw_spin_held_edge(const sw_system *system, const sw_body *body, size_t number);

/* Frames and twist of the iterate start from those of the state. */
void sw_spin_begin(sw_system *system, sw_body *body);

/* Spins do not come to rest: start again, with the section's inertia over hbar^2 against turns from
 * the state's frames; rate2 = 1/hbar^2. */
void sw_spin_slow_down(sw_system *system, double rate2);

/* Carry the iterate's frames on to the field's present tangents. */
void sw_spin_carry(sw_system *system, sw_body *body);

/* Block rows of nodes (nodes x SW_ROW_SIZE, held ones out) become those of nodes with
 * spins (nodes x SW_ROW4_SIZE). */
void sw_spin_assemble(const sw_body *body, const double *rows, double *out);

/* The matrix into spin_rows, and the right-hand side, of which nodes have theirs in delta
 * (nodes x 3), into spin_delta. */
void sw_spin_load(const sw_system *system, sw_body *body, const double *delta);

/* Solve for the update of nodes (delta, nodes x 3, in place) and spins with the
 * field's rows, whose held nodes are out. Fails as sw_band4_factor. */
sw_status sw_spin_solve(const sw_system *system, sw_body *body, double *delta, size_t *negative);

/* How far edge e has turned about itself since the state, by the frames [rad]. */
double sw_spin_turned(const sw_system *system, const sw_body *body, size_t e);

/* The largest turn of the last solve [rad]; let the frames turn by a share of it. */
double sw_spin_largest(const sw_body *body);
void sw_spin_turn(sw_body *body, double share);

/* Turn the iterate's frames by share times angle[edge stride]. */
void sw_spin_turn_by(sw_body *body, const double *angle, size_t stride, double share);

/* A stage begins, at the system's yhat; rate2 = 1/hbar^2, 0 without inertia. It ends at
 * y (freedoms): turns of edges that roll are put in. */
void sw_spin_begin_stage(sw_system *system, double rate2);
void sw_spin_end_stage(sw_system *system, double *y);

/* Small motions of a body with frames, (nodes x 4): the turn of the edge that starts there
 * goes with a node. Its freedoms with inertia; zero the held ones; the part of K times a
 * motion that has to do with turns, to be added to it; their part of M times a motion; and
 * of the shifted rows. Spins that are not free are not in the matrix. */
size_t sw_spin_free_turns(const sw_system *system, const sw_body *body);
void sw_spin_fix_held(const sw_system *system, const sw_body *body, double *motion);
void sw_spin_stiffness_times(const sw_body *body, const double *motion, double *out);
void sw_spin_mass_times(const sw_body *body, const double *motion, double *out);
void sw_spin_shift_rows(const sw_system *system, const sw_body *body, double shift, double *rows);

/* Add what the spins of the last solve do to the reaction of a held node. */
void sw_spin_react(sw_held_node *held, const sw_body *body);

/* The state takes over the iterate's frames, carried on to positions x; follow: those
 * of held edges too. */
void sw_spin_take(sw_system *system, sw_body *body, const double *x);
void sw_spin_follow(sw_system *system, sw_body *body, const double *x);

/* The field sees the state's own frames. */
void sw_spin_show(sw_system *system, sw_body *body);

#endif
