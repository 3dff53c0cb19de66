/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial strains and their rates, kept in the state where forces have axial dashpots. The change
 * of length of an edge that turns cannot be told from its nodes' velocities over a step: an edge
 * of length l that turns by theta seems to get l theta^2/2 longer, which with a cable's axial
 * stiffness is a force that is not there. The strain of the mixed Newton knows better.
 *
 * And so of edges at clamps with dashpots in bending: how fast an edge turns within a step is not
 * how fast its hold turns, though they turn as one. What a stiff wire is bent in truth is less than
 * the difference. So its direction is kept as the hold sees it. */
#ifndef SW_SYSTEM_STRAIN_H
#define SW_SYSTEM_STRAIN_H

#include "system/system.h"

/* After the last term: room for strains in the state and beside it, if any body needs them.
 * SW_ENOMEM. */
sw_status sw_system_add_strains(sw_system *system);

/* The state's axial forces with those of dashpots. */
void sw_system_add_up_pull(sw_system *system);

/* A stage begins, and ends, that has rates of strain. In it its holds are placed, and it is solved
 * with nodes at y. */
void sw_strain_begin_stage(sw_system *system, const sw_stage *stage);
void sw_strain_place(sw_system *system);
void sw_strain_finish(sw_system *system, const double *y);
void sw_strain_end_stage(sw_system *system);

/* Velocities of held nodes as the method has those of all others, into v (nodes x 3): in a stage,
 * with nodes at y, at this rate, of the bodies that are solved now; at a state [1/s]. */
void sw_strain_show_held(const sw_system *system, const double *y, double rate, double *v);
void sw_strain_show_held_rates(const sw_system *system, double *v);

/* Show the field of a body what is known of edges at its clamps: in a stage, and at a state. */
void sw_strain_show_past(const sw_system *system, sw_body *body);
void sw_strain_show_rates(sw_system *system, sw_body *body);

/* The body's strains after its update, which has just given it its axial forces tension_new. */
void sw_strain_advance(sw_system *system, const sw_body *body);

/* All bodies take this share of the update. */
void sw_strain_take(sw_system *system, double share);

#endif
