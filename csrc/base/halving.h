/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef SW_BASE_HALVING_H
#define SW_BASE_HALVING_H

#include <stddef.h>

/* In a list in order: sets the size_t i to the first number of [from, to) that is not before what
 * is looked for, to where all are; before: a condition in terms of i. The last one that is at or
 * before a place is the one ahead of the first after it. */
#define SW_FIRST_NOT(before, i, from, to)     \
  do {                                        \
    size_t sw_low_ = (from), sw_high_ = (to); \
    while (sw_low_ < sw_high_) {              \
      i = sw_low_ + (sw_high_ - sw_low_) / 2; \
      if (before)                             \
        sw_low_ = i + 1;                      \
      else                                    \
        sw_high_ = i;                         \
    }                                         \
    i = sw_low_;                              \
  } while (0)

#endif
