/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial forces and strains of a system as they are read out and given. Those of the state belong to
 * its strains and to the method: in wires that turn they may be several times what a wire bears
 * (integrate/turning.h). */
#ifndef SW_SYSTEM_AXIAL_H
#define SW_SYSTEM_AXIAL_H

#include "system/system.h"

/* What is kept from step to step of how a method sees wires that turn, for a unit acceleration
 * towards the centre: how far the velocity is from that of steady turning, now and a step ago [s];
 * the axial force of the last stage over what it should be, less one [-]. And of read-outs: 1 if
 * they are of `even` [-], how far `between` is behind the state [s]. */
enum {
  SW_TURN_LAG,
  SW_TURN_LAG_BEFORE,
  SW_TURN_EXCESS,
  SW_TURN_EVEN,
  SW_TURN_BEHIND,
  SW_TURN_SIZE
};

/* Axial forces of a body's edges or springs at the refreshed state, those of dashpots included
 * (sw_plan_axial) [N]. */
const double *sw_system_pull(const sw_system *system, const sw_body *body);
/* The same without dashpots' [N]. */
const double *sw_system_elastic(const sw_system *system, const sw_body *body);
/* Axial forces of edges or springs, (edges): tension and what dashpots add at these rates (NULL
 * where there are none) [N], [1/s], [N]. */
void sw_system_sum_pull(const sw_system *system, const double *tension, const double *rate,
                        double *out);

/* Add share times these, of wires that are lines [-]. */
void sw_system_add_pull(const sw_system *system, const double *tension, const double *rate,
                        double share, double *sum);

/* Read-outs of the state, after a step h, are between the first stage's forces (edges) and those
 * of the state now, with this share of the latter, which is how it was `behind` ago, and go on
 * from there as they changed in the last step, if that was evened out too [s], [N], [-], [s]. */
void sw_system_even_out(sw_system *system, double h, const double *first, double share,
                        double behind);

/* Room in the state for them, after the last term. SW_ENOMEM. */
sw_status sw_system_add_even(sw_system *system);
/* Read-outs are those of the state. */
void sw_system_uneven(sw_system *system);
/* And velocities are what they are said to be, of no method. */
void sw_system_forget_turning(sw_system *system);

/* The state has just been filled, or has come to rest: strains as its axial forces and lengths
 * have them, and their rates, which are zero then. */
void sw_system_strain_from_state(sw_system *system);
/* The velocities were given and are exact: rates of strain of a body as they have them. */
void sw_system_rate_from_velocity(sw_system *system, size_t body);

/* Set the axial forces to what the state's edge lengths give: for explicit
 * methods, which do not solve for them. */
void sw_system_axial_from_state(sw_system *system);

#endif
