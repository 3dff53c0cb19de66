/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial forces and strains of a system, for read-outs and for setting them. The state's axial
 * forces belong to its strains and to the method. In wires that turn they may be several times the
 * true force (integrate/turning.h). */
#ifndef SW_SYSTEM_AXIAL_H
#define SW_SYSTEM_AXIAL_H

#include "system/system.h"

/* Places in sw_system.turning; these values last from step to step. The first three are of wires
 * that turn, per unit of acceleration towards the centre: error of the method's velocity against
 * steady turning, at the state and one step before [s]; axial force of the last stage over the true
 * one, minus one [-]. The others are for read-outs: 1 if they show `even` [-]; time from `between`
 * to the state [s]. */
enum {
  SW_TURN_LAG,
  SW_TURN_LAG_BEFORE,
  SW_TURN_EXCESS,
  SW_TURN_EVEN,
  SW_TURN_BEHIND,
  SW_TURN_SIZE
};

/* Returns the axial forces of a body's edges or springs at the refreshed state. They include
 * dashpots (sw_plan_axial) and the forces of system/borne.h. Valid until the next call [N]. */
const double *sw_system_pull(const sw_system *system, const sw_body *body);
/* The same without the dashpots' forces [N]. */
const double *sw_system_elastic(const sw_system *system, const sw_body *body);
/* Returns `mean`, the axial forces of a body's edges or slices over the last step, plus the mean of
 * the forces of system/borne.h. Valid until the next call [N]. */
const double *sw_system_mean_pull(const sw_system *system, const sw_body *body, const double *mean);
/* A run begins, perhaps at a state from a file, with its holds placed: computes the forces of
 * system/borne.h there. */
void sw_system_begin_borne(sw_system *system);
/* out = tension plus the dashpots' forces at these strain rates (NULL: no dashpots), for all edges
 * or springs; all arrays: (edges) [N], [1/s], [N]. */
void sw_system_sum_pull(const sw_system *system, const double *tension, const double *rate,
                        double *out);

/* Number of axial forces of wires: of the edges of lines, and of the slices of meshes, between two
 * rings [-]; place of a body's first one. */
size_t sw_system_pulls(const sw_system *system);
size_t sw_system_first_pull(const sw_system *system, const sw_body *body);
/* sum (pulls) += share * (axial force with dashpots), for nodes at x [m], [s]. tension, rate: of
 * edges and springs [N], [1/s]. */
void sw_system_add_pull(const sw_system *system, const double *x, const double *tension,
                        const double *rate, double share, double *sum);

/* The mix of both stages' axial forces that gives the true force in a step. share: weight of the
 * last stage's force, NAN where the last stage's forces need no mix [-]; behind: time from the mix
 * to the step's end [s]. */
typedef struct sw_between {
  double share, behind;
  double first; /* time of the first stage over the step [-] */
} sw_between;

/* Force and moment about point of hold k on its wire with nodes at x [N], [N m], at the last stage
 * or the state made from it. Like sw_system_reaction, but with the axial forces of read-outs. */
void sw_system_bears(const sw_system *system, int hold, const double *x, sw_vec point,
                     sw_vec *force, sw_vec *moment);
/* After a step h: sets the axial forces of read-outs. They are a mix of the first stage's forces
 * (edges) and the state's, extrapolated to the state's time by their change in the last step, if
 * that step had a mix too [s], [N]. */
void sw_system_even_out(sw_system *system, double h, const double *first, sw_between at);
/* At the end of a trial step, before it becomes the state: keeps the last stage's forces (rate: of
 * dashpots, or NULL) minus those that sw_system_even_out would set. Valid until the next stage. */
void sw_system_find_excess(sw_system *system, double h, const double *first, const double *first_x,
                           const double *rate, sw_between at);

/* Adds room for even, between and turning to the state, after the last term. SW_ENOMEM. */
sw_status sw_system_add_even(sw_system *system);
/* Read-outs show the state's own axial forces again. */
void sw_system_uneven(sw_system *system);
/* Also takes velocities as exact, no longer as a method's result. */
void sw_system_forget_turning(sw_system *system);

/* The state was just filled or came to rest: computes strains from its axial forces and lengths,
 * and sets their rates to zero. */
void sw_system_strain_from_state(sw_system *system);
/* The velocities are given and exact: computes a body's strain rates from them. */
void sw_system_rate_from_velocity(sw_system *system, size_t body);
/* Does this for held nodes and for edges at clamps, with the holds as last placed. */
void sw_system_held_from_velocity(sw_system *system);
/* A step starts anew at time t: places the holds and stores the places of held nodes and the
 * directions of edges at clamps. */
sw_status sw_system_held_anew(sw_system *system, double t, sw_error *err);

/* Sets the axial forces from the state's edge lengths. For explicit methods, which do not solve for
 * them. */
void sw_system_axial_from_state(sw_system *system);

#endif
