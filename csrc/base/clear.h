/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sets large arrays of numbers to zero. For a million nodes the first touch of their memory may
 * take a second. So the clearing ends early when the user wants to stop: check sw_interrupted
 * before you use results computed from the array. */
#ifndef SW_BASE_CLEAR_H
#define SW_BASE_CLEAR_H

#include <stddef.h>
#include <string.h>

#include "base/interrupt.h"

enum { SW_CLEAR_PIECE = 0x20000 }; /* numbers between two polls for Ctrl-C [-] */

static inline void sw_clear(double *numbers, size_t count) {
  const size_t piece = SW_CLEAR_PIECE;
  if (count <= piece) {
    memset(numbers, 0, count * sizeof *numbers);
    return;
  }
  for (size_t at = 0; at < count && !sw_interrupted(); at += piece)
    memset(numbers + at, 0, (count - at < piece ? count - at : piece) * sizeof *numbers);
}

#endif
