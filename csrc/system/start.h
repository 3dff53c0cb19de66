/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a stage's iterations begin. Private to this room. */
#ifndef SW_SYSTEM_START_H
#define SW_SYSTEM_START_H

#include "system/system.h"

/* Newton starts from the free flight y. Returns SW_ENOCONV if an edge turns over or halves its
 * length on the way there: the start may then lie on the wrong side of the edge's length, and the
 * solve may end in a wire folded through itself. */
sw_status sw_start_check(const sw_system *system, const double *y, sw_error *err);

#endif
