/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial forces and strains of a system, as read-outs give them and scripts set them. Those of the
 * state belong to its strains and to the method: in wires that turn they may be several times the
 * true ones (integrate/turning.h). */
#ifndef SW_SYSTEM_AXIAL_H
#define SW_SYSTEM_AXIAL_H

#include "system/system.h"

/* How a method sees wires that turn, kept from step to step, for a unit acceleration towards the
 * centre: the error of the velocity of steady turning, now and a step ago [s]; the relative error
 * of the last stage's axial force [-]. For read-outs: 1 if they use `even` [-], and the delay of
 * `between` behind the state [s]. */
enum {
  SW_TURN_LAG,
  SW_TURN_LAG_BEFORE,
  SW_TURN_EXCESS,
  SW_TURN_EVEN,
  SW_TURN_BEHIND,
  SW_TURN_SIZE
};

/* Axial forces of a body's edges or springs at the refreshed state, with those of dashpots
 * (sw_plan_axial) [N]. */
const double *sw_system_pull(const sw_system *system, const sw_body *body);
/* The same without dashpots' [N]. */
const double *sw_system_elastic(const sw_system *system, const sw_body *body);
/* Axial forces of edges or springs, (edges): tension plus the dashpots' part at these rates (NULL:
 * no dashpots) [N], [1/s], [N]. */
void sw_system_sum_pull(const sw_system *system, const double *tension, const double *rate,
                        double *out);

/* Add share times these, of wires that are lines [-]. */
void sw_system_add_pull(const sw_system *system, const double *tension, const double *rate,
                        double share, double *sum);

/* After a step of h, read-outs mix the first stage's forces (edges) with those of the state, with
 * this share of the latter: the forces `behind` ago. They go on from there at the rate of the last
 * step, if that was evened out too [s], [N], [-], [s]. */
void sw_system_even_out(sw_system *system, double h, const double *first, double share,
                        double behind);

/* Room in the state for them, after the last term. SW_ENOMEM. */
sw_status sw_system_add_even(sw_system *system);
/* Read-outs are those of the state. */
void sw_system_uneven(sw_system *system);
/* And velocities are what they are said to be, of no method. */
void sw_system_forget_turning(sw_system *system);

/* The state is new or has come to rest: strains from its axial forces and lengths; rates zero. */
void sw_system_strain_from_state(sw_system *system);
/* The velocities were given and are exact: rates of strain of a body from them. */
void sw_system_rate_from_velocity(sw_system *system, size_t body);

/* Set the axial forces from the state's edge lengths: for explicit methods, which do not solve for
 * them. */
void sw_system_axial_from_state(sw_system *system);

#endif
