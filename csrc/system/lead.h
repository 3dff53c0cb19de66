/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics: held nodes go their way together with all that follows them. Put where they are to be
 * before the rest has moved, they would kink the wire within its last edge, the more the finer the
 * mesh. Instead the way left to go is part of the first solve. Meshes of particles are not led. Of
 * this room only. */
#ifndef SW_SYSTEM_LEAD_H
#define SW_SYSTEM_LEAD_H

#include "system/system.h"

/* Held nodes are placed, in stage->y: back to where they come from. */
void sw_lead_begin(sw_system *system, const sw_stage *stage);

/* Held rows are out of the equations: what the way left does to their neighbours. */
void sw_lead_rows(sw_system *system, const double *y);

/* The system is solved: the way left, as part of the update. */
void sw_lead_update(sw_system *system, const double *y);

/* An update too large to be made whole may be so because other touches press than was assumed.
 * 1: they are told of it and it is not made; so many times in a row at most, which this counts.
 * Of one that is not too large they say whether they would rather have it not made. */
int sw_lead_waits(sw_system *system, const sw_newton *newton, const double *y, double share,
                  int *waits);

/* Updates of wires that touch something were too large so often, far, and made shortened so often:
 * is it hopeless? */
int sw_lead_fails(const sw_system *system, const sw_newton *newton, int far, int shortened);

#endif
