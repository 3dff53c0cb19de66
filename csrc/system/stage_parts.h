/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a stage's solve, a file for each. Private to this room. */
#ifndef SW_SYSTEM_STAGE_PARTS_H
#define SW_SYSTEM_STAGE_PARTS_H

#include "system/system.h"

/* --- start.c: start of the iterations --------------------------------------------- */

/* Newton starts from the free flight y. Returns SW_ENOCONV if an edge turns over or halves its
 * length on the way there: from the wrong side of the edge's length, the solve may end in a wire
 * folded through itself. */
sw_status sw_start_check(const sw_system *system, const double *y, sw_error *err);

/* --- held.c: held nodes in a body's equations ------------------------------------- */

/* Takes the body's held nodes out of its gathered equations and keeps their couplings. */
void sw_held_take_out(sw_system *system, const sw_body *body);
/* Computes the reaction after the last update, with the solve's linearisation. */
void sw_held_react(sw_system *system, sw_held_node *held);

/* --- lead.c ------------------------------------------------------------------------
 * Statics: moves held nodes together with their wires. Placing held nodes first would kink the wire
 * within its last edge, more so on finer meshes. Instead the remaining distance is part of the
 * first solve. Meshes of particles are not treated like this. */

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

/* --- converged.c: end of the iterations ------------------------------------------- */

/* 1 if the last update was made in full, is small and smooth enough, and contact agrees. rate2:
 * factor of the mass [1/s2]. */
int sw_stage_converged(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                       const sw_stage_report *report, double rate2);

#endif
