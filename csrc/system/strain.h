/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial strains and their rates, kept in the state where forces have axial dashpots. Over a step,
 * the nodes' velocities do not give the change of length of an edge that turns: an edge of length l
 * that turns by theta seems to get longer by l theta^2/2. With a cable's axial stiffness this would
 * be a large spurious force. The strain of the mixed Newton is free of this error.
 *
 * The same holds for edges at clamps with bending dashpots. Within a step, the turning rate of an
 * edge differs from that of its hold, though both turn as one, and a stiff wire's true bending is
 * less than the difference. So the edge's direction is kept in the hold's coordinates. */
#ifndef SW_SYSTEM_STRAIN_H
#define SW_SYSTEM_STRAIN_H

#include "system/system.h"

/* After the last term: adds room for strains to the state and beside it, if any body needs them.
 * SW_ENOMEM. */
sw_status sw_system_add_strains(sw_system *system);

/* Sums up the state's axial forces and those of dashpots. */
void sw_system_add_up_pull(sw_system *system);

/* For a stage with strain rates. begin_stage, end_stage: it begins and ends. place: its holds have
 * been placed. finish: it has been solved, with nodes at y. */
void sw_strain_begin_stage(sw_system *system, const sw_stage *stage);
void sw_strain_place(sw_system *system);
void sw_strain_finish(sw_system *system, const double *y);
void sw_strain_end_stage(sw_system *system);

/* Sets the velocities of held nodes in v (nodes x 3) as the method defines those of all other
 * nodes. show_held: in a stage, with nodes at y and this rate, for the bodies that are solved now
 * [1/s]. show_held_rates: at a state. */
void sw_strain_show_held(const sw_system *system, const double *y, double rate, double *v);
void sw_strain_show_held_rates(const sw_system *system, double *v);

/* Sets what a body's field knows about edges at its clamps. past: in a stage. rates: at a state. */
void sw_strain_show_past(const sw_system *system, sw_body *body);
void sw_strain_show_rates(sw_system *system, sw_body *body);

/* Computes the body's strains after its update, which has just set its axial forces tension_new. */
void sw_strain_advance(sw_system *system, const sw_body *body);

/* Applies this share of the update to the strains of the bodies that are solved now. */
void sw_strain_take(sw_system *system, double share);

#endif
