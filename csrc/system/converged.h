/* SPDX-License-Identifier: GPL-3.0-or-later */
/* End of a stage's iteration. Private to this room. */
#ifndef SW_SYSTEM_CONVERGED_H
#define SW_SYSTEM_CONVERGED_H

#include "system/system.h"

/* 1 if the last update was made in full, is small and smooth enough, and contact agrees. rate2:
 * factor of the mass [1/s2]. */
int sw_stage_converged(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                       const sw_stage_report *report, double rate2);

#endif
