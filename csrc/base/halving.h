/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef SW_BASE_HALVING_H
#define SW_BASE_HALVING_H

#include <stddef.h>

/* Binary search in a sorted list: sets the size_t i to the first index in [from, to) for which the
 * condition before (in terms of i) is false; to `to` if it is true for all. To find the last item
 * at or before a place, search for the first item after the place and take the one ahead of it. */
/* NOLINTBEGIN(bugprone-macro-parentheses): a condition and an assignment need none */
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
/* NOLINTEND(bugprone-macro-parentheses) */

#endif
