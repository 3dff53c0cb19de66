/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a stage's iterations begin. Of this room only. */
#ifndef SW_SYSTEM_START_H
#define SW_SYSTEM_START_H

#include "system/system.h"

/* Newton starts from the free flight y. If that turns an edge over or halves it, the start may lie
 * on the wrong side of the edge's length, and the solve may end in a wire folded through itself:
 * SW_ENOCONV. */
sw_status sw_start_check(const sw_system *system, const double *y, sw_error *err);

#endif
