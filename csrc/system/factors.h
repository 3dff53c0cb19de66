/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Use of factors for several solves. The matrices of both stages of a step differ only by the
 * motion between them. If that is small, the second stage begins with the first one's factors. This
 * pays for meshes of solid elements, where the matrix is most of the work. Private to this room. */
#ifndef SW_SYSTEM_FACTORS_H
#define SW_SYSTEM_FACTORS_H

#include "system/system.h"

/* Returns how many numbers the test for reuse needs; 0 if the system never reuses factors. */
size_t sw_factors_room(const sw_system *system);

/* Before the solve of an iterate: out = 1 if it takes this step's old factors. */
sw_status sw_factors_serve(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                           const sw_stage_report *report, int *out, sw_error *err);

/* New factors were made at the stage's y. */
void sw_factors_keep(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                     const sw_stage_report *report);

/* After a solve with the reported turns of edges: 1 if old factors left a larger error than a
 * Newton step would. */
int sw_factors_stale(sw_system *system, const sw_stage_report *report);

#endif
