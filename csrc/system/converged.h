/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When a stage's iteration ends. Of this room only. */
#ifndef SW_SYSTEM_CONVERGED_H
#define SW_SYSTEM_CONVERGED_H

#include "system/system.h"

/* Is the last update, made in full, small and smooth enough, and does contact agree? rate2: what
 * multiplies the mass [1/s2]. */
int sw_stage_converged(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                       const sw_stage_report *report, double rate2);

#endif
