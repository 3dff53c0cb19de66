/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial forces and strains of a system, as they are read out and as they are set. The state's axial
 * forces belong to its strains and to the method. In wires that turn, they may be several times the
 * true force (integrate/turning.h). */
#ifndef SW_SYSTEM_AXIAL_H
#define SW_SYSTEM_AXIAL_H

#include "system/system.h"

/* Places in sw_system.turning, kept from step to step. For wires that turn with a unit acceleration
 * towards the centre: error of the method's velocity against steady turning, at the state and a
 * step before [s]; axial force of the last stage over the true one, minus one [-]. For read-outs: 1
 * if they show `even` [-]; time from `between` to the state [s]. */
enum {
  SW_TURN_LAG,
  SW_TURN_LAG_BEFORE,
  SW_TURN_EXCESS,
  SW_TURN_EVEN,
  SW_TURN_BEHIND,
  SW_TURN_SIZE
};

/* Returns the axial forces of a body's edges or springs at the refreshed state, with those of
 * dashpots (sw_plan_axial) and those that other forces bear (system/borne.h). Valid until the next
 * call [N]. */
const double *sw_system_pull(const sw_system *system, const sw_body *body);
/* The same without the dashpots' forces [N]. */
const double *sw_system_elastic(const sw_system *system, const sw_body *body);
/* Returns the axial forces `mean` of a body's springs over the last step plus the mean of what
 * other forces bear. Valid until the next call [N]. */
const double *sw_system_mean_pull(const sw_system *system, const sw_body *body, const double *mean);
/* A run begins, perhaps at a state that was read from a file; holds are placed there: finds what
 * other forces bear there. */
void sw_system_begin_borne(sw_system *system);
/* out = axial forces of all edges or springs: tension plus the dashpots' forces at these rates
 * (NULL where there are none); all (edges) [N], [1/s], [N]. */
void sw_system_sum_pull(const sw_system *system, const double *tension, const double *rate,
                        double *out);

/* sum += share times these forces, for wires that are lines (no webs) [-]. */
void sw_system_add_pull(const sw_system *system, const double *tension, const double *rate,
                        double share, double *sum);

/* The mix of both stages' axial forces in a step that is right. share: of the last stage's force,
 * NAN where the last stage's forces are right as they are [-]; behind: time from the mix to the
 * step's end [s]. */
typedef struct sw_between {
  double share, behind;
  double first; /* time of the first stage over the step [-] */
} sw_between;

/* Force and moment about point that hold k puts on its wire with nodes at x, at the last stage or
 * the state made from it. Like sw_system_reaction, but with the axial forces that are read out [N],
 * [N m]. */
void sw_system_bears(const sw_system *system, int hold, const double *x, sw_vec point,
                     sw_vec *force, sw_vec *moment);
/* After a step h: sets the axial forces that read-outs show. They lie between the first stage's
 * forces (edges) and the state's. From there they continue to the state's time as they changed in
 * the last step, if that step was evened out too [s], [N]. */
void sw_system_even_out(sw_system *system, double h, const double *first, sw_between at);
/* The same at the end of a trial step, before it becomes the state: keeps by how much the last
 * stage's forces (rate: of dashpots, or NULL) exceed those that would be read out. Valid until the
 * next stage. */
void sw_system_find_excess(sw_system *system, double h, const double *first, const double *first_x,
                           const double *rate, sw_between at);

/* Adds room for even, between and turning to the state, after the last term. SW_ENOMEM. */
sw_status sw_system_add_even(sw_system *system);
/* Read-outs show the state's own axial forces again. */
void sw_system_uneven(sw_system *system);
/* The same, and velocities count as exact, not as a method's result. */
void sw_system_forget_turning(sw_system *system);

/* The state has just been filled or has come to rest: computes strains from its axial forces and
 * lengths, and sets their rates to zero. */
void sw_system_strain_from_state(sw_system *system);
/* The velocities were given and are exact: computes a body's strain rates from them. */
void sw_system_rate_from_velocity(sw_system *system, size_t body);
/* The same for held nodes and for edges at clamps, with the holds as last placed. */
void sw_system_held_from_velocity(sw_system *system);
/* A step starts anew at time t: stores the places of held nodes and the directions of edges at
 * clamps, as the holds place them at t. */
sw_status sw_system_held_anew(sw_system *system, double t, sw_error *err);

/* Sets the axial forces from the state's edge lengths, for explicit methods, which do not solve for
 * them. */
void sw_system_axial_from_state(sw_system *system);

#endif
