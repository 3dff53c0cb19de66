/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds in an inner stage of first order (sw_stage.inner). Wires move in it by its length times
 * their velocity at its end. With the pose of an accelerating hold at the stage's time a wire would
 * have half its velocity, and 1.35 times the force in the step. So holds and obstacles go likewise.
 */
#ifndef SW_SYSTEM_INNER_H
#define SW_SYSTEM_INNER_H

#include "system/system.h"

/* Call when the holds have been placed for the stage's time t. Holds of a taut wire that accelerate
 * towards or away from each other are placed anew, at their poses at t: their wire's inertia
 * matters less than the force by which the difference would stretch it. */
sw_status sw_inner_check(sw_system *system, double t, sw_error *err);

/* Call when a body's edges were measured at the iterate. In an inner stage an edge that turns becomes
 * shorter by half of its turn squared, if the velocities at its ends are those of turning. This is
 * no strain, and the field's lengths become those without it. Only for lines that an obstacle turns
 * (sw_body.carried): friction would be at its limit from the false axial forces. For other wires
 * see integrate/turning.h. */
void sw_inner_felt_lengths(const sw_system *system, sw_body *body);

#endif
