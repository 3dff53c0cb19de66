/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses in which no equilibrium is found. Private to this room. */
#ifndef SW_STEP_UNSETTLED_H
#define SW_STEP_UNSETTLED_H

#include "step/ladder.h"

/* 1 if the wires still move up to time t, so that no equilibrium is looked for [s]. */
int sw_unsettled_moves(const sw_ladder *p, double t);
/* Call when an equilibrium was found. */
void sw_unsettled_ends(sw_ladder *p);
/* Call when the equilibrium of a pose was not found, for the reason *err. If the run allows it, the
 * wires move up to time t; else, or if that fails too, returns the status with that reason. */
sw_status sw_unsettled_begin(sw_ladder *p, double t, sw_status status, sw_error *err);
/* Moves the wires up to time t. */
sw_status sw_unsettled_go(sw_ladder *p, double t, sw_error *err);

#endif
