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

/* After the last term: adds arrays for strains to the state and beside it, if any body has
 * dashpots. SW_ENOMEM. */
sw_status sw_system_add_strains(sw_system *system);

/* Sums the state's axial forces and those of dashpots. */
void sw_system_add_up_pull(sw_system *system);

/* For a stage with strain rates. begin_stage, end_stage: it begins and ends. place: its holds were
 * placed. finish: it was solved, with nodes at y. */
void sw_strain_begin_stage(sw_system *system, const sw_stage *stage);
void sw_strain_place(sw_system *system);
void sw_strain_finish(sw_system *system, const double *y);
void sw_strain_end_stage(sw_system *system);

/* Sets the velocities of held nodes in v (nodes x 3) by the method's formula for all other nodes.
 * show_held: in a stage, with nodes at y and this rate, for the bodies of the present part [1/s].
 * show_held_rates: at a state. */
void sw_strain_show_held(const sw_system *system, const double *y, double rate, double *v);
void sw_strain_show_held_rates(const sw_system *system, double *v);

/* Sets the edges at clamps in a body's field. past: in a stage. rates: at a state. */
void sw_strain_show_past(const sw_system *system, sw_body *body);
void sw_strain_show_rates(sw_system *system, sw_body *body);

/* Computes the body's strains after its update, which has just set tension_new. */
void sw_strain_advance(sw_system *system, const sw_body *body);

/* Adds this share of the update to the strains of the bodies of the present part. */
void sw_strain_take(sw_system *system, double share);

#endif
