/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A limit on the number of steps that runs of all scenes may try. It bounds the cost of an
 * evaluation in the same way on every machine. */
#ifndef SW_BASE_QUOTA_H
#define SW_BASE_QUOTA_H

#include "base/status.h"

/* Sets the limit and starts the count at 0. steps: 0 = any number. */
void sw_quota_set(long steps);

/* Counts one more tried step. SW_ELIMIT if that exceeds the limit. */
sw_status sw_quota_take(sw_error *err);

/* 1 if more steps than the limit were asked for. */
int sw_quota_over(void);

#endif
