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

/* Where between both stages' axial forces of a step those are that hold: their share of the last
 * stage's, NAN where these hold as they are, and how long before the step's end [-], [s]. */
typedef struct sw_between {
  double share, behind;
  double first; /* time of the first stage, of the step [-] */
} sw_between;

/* Force and moment about point that hold k puts on its wire with nodes at x, of the last stage or
 * the state it became: sw_system_reaction, but with the axial forces that are read out [N], [N m].
 */
void sw_system_bears(const sw_system *system, int hold, const double *x, sw_vec point,
                     sw_vec *force, sw_vec *moment);
/* Read-outs of the state, after a step h, are between the first stage's forces (edges) and those
 * of the state now, and go on from there as they changed in the last step, if that was evened out
 * too [s], [N]. */
void sw_system_even_out(sw_system *system, double h, const double *first, sw_between at);
/* The same at the end of a trial step, before it becomes the state: what the last stage's forces,
 * with these rates of dashpots or NULL, are beyond those that would be read out; until the next
 * stage. */
void sw_system_find_excess(sw_system *system, double h, const double *first, const double *first_x,
                           const double *rate, sw_between at);

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
/* The same of held nodes and of edges at clamps, with the holds as last placed. */
void sw_system_held_from_velocity(sw_system *system);
/* A step starts anew at time t: where these are. */
sw_status sw_system_held_anew(sw_system *system, double t, sw_error *err);

/* Set the axial forces to what the state's edge lengths give: for explicit
 * methods, which do not solve for them. */
void sw_system_axial_from_state(sw_system *system);

#endif
