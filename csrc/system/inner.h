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

#endif
