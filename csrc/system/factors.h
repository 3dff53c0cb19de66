/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Both stages of a step have the same matrix but for the motion between them. If that is small, the
 * second stage begins with the first one's factors. It pays for meshes of solid elements, where the
 * matrix is most of the work. Of this room only. */
#ifndef SW_SYSTEM_FACTORS_H
#define SW_SYSTEM_FACTORS_H

#include "system/system.h"

/* Numbers needed for that test; 0: factors never serve again in this system. */
size_t sw_factors_room(const sw_system *system);

/* Before the solve of an iterate: out = 1, the factors of this step serve again. */
sw_status sw_factors_serve(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                           const sw_stage_report *report, int *out, sw_error *err);

/* New ones were made at the stage's y. */
void sw_factors_keep(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                     const sw_stage_report *report);

/* After a solve that turned edges as the report says: did old factors leave a larger error than a
 * Newton step? */
int sw_factors_stale(sw_system *system, const sw_stage_report *report);

#endif
