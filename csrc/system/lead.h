/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics: held nodes move together with the wires that follow them. If they were placed first,
 * they would kink the wire within its last edge, more so on finer meshes. Instead the way left to
 * go is part of the first solve. Meshes of particles are not led. Of this room only. */
#ifndef SW_SYSTEM_LEAD_H
#define SW_SYSTEM_LEAD_H

#include "system/system.h"

/* Held nodes are placed: put them back in stage->y, to where they come from. */
void sw_lead_begin(sw_system *system, const sw_stage *stage);

/* Held rows are out of the equations: add the effect of the way left on their neighbours. */
void sw_lead_rows(sw_system *system, const double *y);

/* The system is solved: the way left, as part of the update. */
void sw_lead_update(sw_system *system, const double *y);

/* An update may be too large because the touches' states are wrong. 1: touches are told, and the
 * update is not made; at most this often in a row, which is counted here. For smaller updates
 * touches say whether they would rather wait. */
int sw_lead_waits(sw_system *system, const sw_newton *newton, const double *y, double share,
                  int *waits);

/* Updates of touching wires were too large this often, and shortened this often: is it hopeless? */
int sw_lead_fails(const sw_system *system, const sw_newton *newton, int far, int shortened);

#endif
