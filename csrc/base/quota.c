/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts the steps of all scenes against their limit. */
#include "base/quota.h"

static long most, taken; /* steps allowed (0 = any number), steps tried [-] */

void sw_quota_set(long steps) {
  most = steps;
  taken = 0;
}

sw_status sw_quota_take(sw_error *err) {
  if (most <= 0) return SW_OK;
  if (taken++ < most) return SW_OK;
  return sw_fail(err, SW_ELIMIT, "took more than %ld steps", most);
}

int sw_quota_over(void) { return most > 0 && taken > most; }
