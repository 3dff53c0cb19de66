/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Start of a stage's iterations. Private to this room. */
#ifndef SW_SYSTEM_START_H
#define SW_SYSTEM_START_H

#include "system/system.h"

/* Newton starts from the free flight y. Returns SW_ENOCONV if an edge turns over or halves its
 * length on the way there: from the wrong side of the edge's length, the solve may end in a wire
 * folded through itself. */
sw_status sw_start_check(const sw_system *system, const double *y, sw_error *err);

#endif
