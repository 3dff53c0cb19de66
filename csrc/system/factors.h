/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Both stages of a step have the same matrix but for what the motion between them changes. Where
 * that is little, the second one begins with the factors of the first: of meshes of solid elements,
 * whose matrix is most of the work. Of this room only. */
#ifndef SW_SYSTEM_FACTORS_H
#define SW_SYSTEM_FACTORS_H

#include "system/system.h"

/* How many numbers it takes to know whether they do; 0: in such a system they never do. */
size_t sw_factors_room(const sw_system *system);

/* Before the solve of an iterate: out = 1, the factors of this step serve again. */
sw_status sw_factors_serve(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                           const sw_stage_report *report, int *out, sw_error *err);

/* New ones were made at the stage's y. */
void sw_factors_keep(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                     const sw_stage_report *report);

/* After a solve that turned edges by as much as the report says: did factors of before leave an
 * error above that of a Newton step? */
int sw_factors_stale(sw_system *system, const sw_stage_report *report);

#endif
