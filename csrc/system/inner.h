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

/* 1 in an inner stage, for a body that lies flat on what carries it round, kept by no hold. What
 * goes round with the obstacle is then moved, as the wire is, by the stage's length times its
 * velocity at the end: to a place inside its path, by half of its turn squared times the radius. */
int sw_inner_goes_inside(const sw_system *system, const sw_body *body);

/* Call when a body's edges were measured at the iterate. Edges of such a body become shorter by
 * half of their turn squared. This is no strain, and the field's lengths become those without it.
 * Otherwise false axial forces would load friction up to its limit. Only for lines that lie flat: a
 * curved surface keeps them from going inside. For other wires see integrate/turning.h. */
void sw_inner_felt_lengths(const sw_system *system, sw_body *body);

#endif
