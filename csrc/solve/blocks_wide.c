/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fronts with vectors of 8 numbers. SW_HOT cannot make these loops: its variants share the types of
 * their vectors, and vectors longer than the processor's go through memory. */
#include "solve/blocks_wide.h"

#include "base/simd.h"

#ifdef SW_CLONES
#pragma GCC target("arch=x86-64-v4")
#define SW_FRONT_LANES 8
#include "solve/blocks_tile.h"

static void eliminate_wide(sw_front *f) { eliminate_all(f); }
static void take_wide(const sw_front *f, size_t first, double *to, size_t stride, size_t count) {
  take_all(f, first, to, stride, count);
}
static void forward_wide(const sw_front *f, double *own, double *before) {
  forward_all(f, own, before);
}
static void backward_wide(const sw_front *f, double *own, const double *before) {
  backward_all(f, own, before);
}
#pragma GCC reset_options

const sw_front_loops *sw_front_wide(void) {
  static const sw_front_loops wide = {eliminate_wide, take_wide, forward_wide, backward_wide};
  return __builtin_cpu_supports("x86-64-v4") ? &wide : NULL;
}
#else
const sw_front_loops *sw_front_wide(void) { return NULL; }
#endif
