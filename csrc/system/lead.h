/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics: moves held nodes together with their wires. Placing held nodes first would kink the wire
 * within its last edge, more so on finer meshes. Instead the remaining distance is part of the
 * first solve. Meshes of particles are not treated like this. Private to this room. */
#ifndef SW_SYSTEM_LEAD_H
#define SW_SYSTEM_LEAD_H

#include "system/system.h"

/* After the held nodes are placed: puts them back to their start in stage->y. */
void sw_lead_begin(sw_system *system, const sw_stage *stage);

/* After held rows are taken out of the equations: adds the effect of the held nodes' remaining
 * distance on their neighbours. */
void sw_lead_rows(sw_system *system, const double *y);

/* After the solve: adds the held nodes' remaining distance to the update. */
void sw_lead_update(sw_system *system, const double *y);

/* 1 if the update must not be made yet. It may be too large because of wrong states of touches; the
 * touches learn from it and the solve is repeated, a limited number of times in a row (counted in
 * waits). For a small update (share 1) the touches decide. */
int sw_lead_waits(sw_system *system, const sw_newton *newton, const double *y, double share,
                  int *waits);

/* 1 if statics should stop: `far` updates of touching wires were too large, and `shortened` ones
 * were shortened. */
int sw_lead_fails(const sw_system *system, const sw_newton *newton, int far, int shortened);

#endif
