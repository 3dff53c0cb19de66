/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How many steps of runs may be tried from now on, in all scenes: the limit of an evaluation that
 * is the same on every machine. */
#ifndef SW_BASE_QUOTA_H
#define SW_BASE_QUOTA_H

#include "base/status.h"

/* 0 = any number. */
void sw_quota_set(long steps);

/* One more step is tried. SW_ELIMIT when that is more than was set. */
sw_status sw_quota_take(sw_error *err);

/* Has more been asked for than was set? */
int sw_quota_over(void);

#endif
