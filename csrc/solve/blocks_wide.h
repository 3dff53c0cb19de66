/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops of a front for processors with vectors of 8 numbers. */
#ifndef SW_SOLVE_BLOCKS_WIDE_H
#define SW_SOLVE_BLOCKS_WIDE_H

#include "solve/blocks_front.h"

/* See sw_front_eliminate, sw_front_forward and sw_front_backward. take: subtracts the products of
 * the front's rows from count rows of a matrix, which belong to its columns from `first` on. */
typedef struct sw_front_loops {
  void (*eliminate)(sw_front *front);
  void (*take)(const sw_front *front, size_t first, double *to, size_t stride, size_t count);
  void (*forward)(const sw_front *front, double *own, double *before);
  void (*backward)(const sw_front *front, double *own, const double *before);
} sw_front_loops;

/* NULL: the processor, or the build, does not have such vectors. */
const sw_front_loops *sw_front_wide(void);

#endif
