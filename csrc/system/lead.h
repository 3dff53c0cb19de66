/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics: moves held nodes together with the wires that follow them. Placing held nodes first
 * would kink the wire within its last edge, more so on finer meshes. Instead the distance left to
 * go is part of the first solve. Meshes of particles are not treated like this. Private to this
 * room. */
#ifndef SW_SYSTEM_LEAD_H
#define SW_SYSTEM_LEAD_H

#include "system/system.h"

/* After the held nodes are placed: puts them back in stage->y to where they come from. */
void sw_lead_begin(sw_system *system, const sw_stage *stage);

/* After held rows are taken out of the equations: adds the effect of the held nodes' remaining
 * distance on their neighbours. */
void sw_lead_rows(sw_system *system, const double *y);

/* After the solve: puts the held nodes' remaining distance into the update. */
void sw_lead_update(sw_system *system, const double *y);

/* 1 if the update must not be made yet. It may be too large because the touches' states are wrong;
 * touches learn from it and the solve is repeated, a limited number of times in a row (counted in
 * waits). If the update is small (share 1), the touches decide whether they wait. */
int sw_lead_waits(sw_system *system, const sw_newton *newton, const double *y, double share,
                  int *waits);

/* 1 if statics should give up: the updates of touching wires were too large `far` times and
 * shortened `shortened` times. */
int sw_lead_fails(const sw_system *system, const sw_newton *newton, int far, int shortened);

#endif
