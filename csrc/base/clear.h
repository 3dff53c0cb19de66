/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Large arrays of numbers set to zero. Memory that is seen for the first time may take a second in
 * a million nodes: given up half way when the user wants to stop, so look at sw_interrupted before
 * what follows is believed. */
#ifndef SW_BASE_CLEAR_H
#define SW_BASE_CLEAR_H

#include <stddef.h>
#include <string.h>

#include "base/interrupt.h"

enum { SW_CLEAR_PIECE = 0x20000 }; /* numbers between two looks [-] */

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
