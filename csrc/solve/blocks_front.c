/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fronts: chooses the loops for this processor. */
#include "base/interrupt.h"
#include "base/simd.h"
#include "solve/blocks_tile.h"
#include "solve/blocks_wide.h"

SW_HOT
static void eliminate_narrow(sw_front *f) { eliminate_all(f); }
SW_HOT
static void take_narrow(const sw_front *f, size_t first, double *to, size_t stride, size_t count) {
  take_all(f, first, to, stride, count);
}
SW_HOT
static void forward_narrow(const sw_front *f, double *own, double *before) {
  forward_all(f, own, before);
}
SW_HOT
static void backward_narrow(const sw_front *f, double *own, const double *before) {
  backward_all(f, own, before);
}

static const sw_front_loops *loops(void) {
  static const sw_front_loops narrow = {eliminate_narrow, take_narrow, forward_narrow,
                                        backward_narrow};
  const sw_front_loops *wide = sw_front_wide();
  return wide ? wide : &narrow;
}

void sw_front_eliminate(sw_front *f) { loops()->eliminate(f); }

void sw_front_forward(const sw_front *f, double *own, double *before) {
  loops()->forward(f, own, before);
}

void sw_front_backward(const sw_front *f, double *own, const double *before) {
  loops()->backward(f, own, before);
}

void sw_front_reduce(sw_front *f, double *rest, size_t rows) {
  const sw_front_loops *l = loops();
  for (size_t begin, end = f->n; end > 0; end = begin) {
    if (sw_interrupted()) return; /* the caller checks too */
    begin = (end - 1) / SW_FRONT_ROWS * SW_FRONT_ROWS;
    sw_front part = *f;
    part.n = end - begin;
    part.before = part.place = f->place + begin;
    part.factor += begin * f->stride, part.a = part.factor;
    part.kept += begin * KEPT;
    l->eliminate(&part);
    l->take(&part, f->place, f->factor, f->stride, begin);
    l->take(&part, 0, rest, f->before, rows);
    f->negative = part.negative, f->bad = part.bad;
  }
}
