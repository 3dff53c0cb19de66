/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops of a front (solve/blocks_front.h), for vectors of SW_FRONT_LANES numbers: 4 or 8.
 * Panels of 6 rows wait until all rows below them are done. Then a tile of 6 x 8 numbers in
 * registers collects everything that these rows subtract, and is divided by its panel's own part
 * before it is stored. So each number is written once. Each number is computed in the same order
 * with vectors of any length, so the bits are equal. */
#ifndef SW_SOLVE_BLOCKS_TILE_H
#define SW_SOLVE_BLOCKS_TILE_H

#include <math.h>
#include <string.h>

#include "solve/blocks_front.h"

#ifndef SW_FRONT_LANES
#define SW_FRONT_LANES 4
#endif

#pragma GCC diagnostic ignored "-Wpsabi" /* vectors stay inside one file */
typedef double quad __attribute__((vector_size(32), aligned(8)));
typedef double lanes __attribute__((vector_size(8 * SW_FRONT_LANES), aligned(8)));
enum { TILE = SW_FRONT_TILE, PANEL = SW_FRONT_PANEL, KEPT = SW_FRONT_KEPT };
enum { PARTS = TILE / SW_FRONT_LANES }; /* of a tile's row [-] */
enum { COLUMNS = 384 }; /* of SW_FRONT_ROWS rows: this many stay in a second-level cache */
#define ALWAYS static inline __attribute__((always_inline))

ALWAYS lanes *at(double *p) { return (lanes *)(void *)p; }
ALWAYS const lanes *look(const double *p) { return (const lanes *)(const void *)p; }
ALWAYS const quad *look_at_four(const double *p) { return (const quad *)(const void *)p; }

/* tile -= (rows of d)' (rows of l), over count rows; d: rows' columns of the panel. */
ALWAYS void subtract(lanes tile[][PARTS], const double *d, const double *l, size_t count,
                     size_t stride, const int rows) {
  for (size_t k = 0; k < count; k++, d += stride, l += stride) {
    const lanes first = look(l)[0], last = look(l)[PARTS - 1];
#pragma GCC unroll 6
    for (int i = 0; i < rows; i++) {
      tile[i][0] -= d[i] * first;
      if (PARTS > 1) tile[i][PARTS - 1] -= d[i] * last;
    }
  }
}

ALWAYS void load(lanes tile[][PARTS], const double *a, size_t stride, const int rows) {
#pragma GCC unroll 6
  for (int i = 0; i < rows; i++, a += stride)
    for (int p = 0; p < PARTS; p++) tile[i][p] = look(a)[p];
}

/* Loads a panel's tile at a column and subtracts the parts of all rows below the panel. */
ALWAYS void gather(const sw_front *f, lanes tile[][PARTS], size_t panel, size_t column,
                   const int own, const int rows) {
  const size_t s = f->stride, below = panel + (size_t)rows;
  load(tile, f->a + panel * s + column, s, rows);
  if (own && f->next_factor)
    subtract(tile, f->next_scaled + panel, f->next_factor + column - f->place, f->n, s, rows);
  subtract(tile, f->scaled + below * s + f->place + panel, f->factor + below * s + column,
           f->n - below, s, rows);
}

/* Factorises the panel's own part: L' D L. */
ALWAYS void split(sw_front *f, size_t panel, const int rows) {
  lanes tile[PANEL][PARTS];
  double m[PANEL][TILE];
  gather(f, tile, panel, f->place + panel, 1, rows);
  for (int i = 0; i < rows; i++)
    for (int p = 0; p < PARTS; p++) at(m[i])[p] = tile[i][p];
  for (int k = rows - 1; k >= 0; k--) {
    const double pivot = m[k][k], r = 1.0 / pivot;
    double *kept = f->kept + KEPT * (panel + (size_t)k);
    f->negative += pivot < 0.0;
    f->bad += !(fabs(r) > 0.0 && fabs(r) < HUGE_VAL);
    for (int i = 0; i < k; i++) {
      const double l = m[k][i] * r;
      for (int j = 0; j <= i; j++) m[i][j] -= l * m[k][j];
      kept[i] = l;
    }
    kept[PANEL] = r;
  }
}

/* Computes one tile of the panel's rows of L and D L. */
ALWAYS void finish(sw_front *f, size_t panel, size_t column, const int own, const int rows) {
  const double *kept = f->kept + KEPT * panel;
  const size_t place = panel * f->stride + column;
  lanes tile[PANEL][PARTS];
  gather(f, tile, panel, column, own, rows);
#pragma GCC unroll 6
  for (int k = rows - 1; k >= 0; k--) {
    double *l = f->factor + place + (size_t)k * f->stride;
    double *d = f->scaled + place + (size_t)k * f->stride;
    const double r = kept[KEPT * k + PANEL];
#pragma GCC unroll 6
    for (int i = 0; i < k; i++)
      for (int p = 0; p < PARTS; p++) tile[i][p] -= kept[KEPT * k + i] * tile[k][p];
    for (int p = 0; p < PARTS; p++) at(d)[p] = tile[k][p], at(l)[p] = tile[k][p] * r;
  }
}

ALWAYS void eliminate(sw_front *f, size_t panel, const int rows) {
  split(f, panel, rows);
  for (size_t j = 0; j < panel; j += TILE) finish(f, panel, f->place + j, 1, rows);
  /* the rest of the last tile, in the panel and beyond, which solving reads */
  const size_t beyond = sw_front_pad(panel) - panel;
  for (size_t k = panel; k < panel + (size_t)rows; k++)
    memset(f->factor + k * f->stride + f->place + panel, 0, beyond * sizeof *f->factor);
}

ALWAYS void finish_before(sw_front *f, size_t panel, size_t begin, size_t end, const int rows) {
  for (size_t j = begin; j < end; j += TILE) finish(f, panel, j, 0, rows);
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

ALWAYS void eliminate_all(sw_front *f) {
  const size_t full = f->n / PANEL, odd = f->n % PANEL;
  if (odd) eliminate(f, full * PANEL, PANEL / 2);
  for (size_t k = full; k-- > 0;) eliminate(f, k * PANEL, PANEL);
  for (size_t begin = 0, end; begin < f->before; begin = end) {
    end = least(begin + COLUMNS, f->before);
    if (odd) finish_before(f, full * PANEL, begin, end, PANEL / 2);
    for (size_t k = full; k-- > 0;) finish_before(f, k * PANEL, begin, end, PANEL);
  }
}

/* Subtracts from some rows of a lower half, in tiles from begin to end. to: the rows; d: the
 * front's columns for these rows. */
ALWAYS void take(const sw_front *f, const double *d, double *to, size_t stride, size_t begin,
                 size_t end, const int rows) {
  for (size_t j = begin; j < end; j += TILE) {
    double *out = to + j;
    lanes tile[PANEL][PARTS];
    load(tile, out, stride, rows);
    for (int i = 0; i < rows; i++) __builtin_prefetch(out + (size_t)i * stride + TILE, 1);
    subtract(tile, d, f->factor + j, f->n, f->stride, rows);
#pragma GCC unroll 6
    for (int i = 0; i < rows; i++, out += stride)
      for (int p = 0; p < PARTS; p++) at(out)[p] = tile[i][p];
  }
}

/* Subtracts the products of the front's rows from count rows of a matrix, which belong to its
 * columns from `first` on: the lower half, up to full tiles. */
ALWAYS void take_all(const sw_front *f, size_t first, double *to, size_t stride, size_t count) {
  for (size_t begin = 0; begin < first + count; begin += COLUMNS) {
    size_t i = begin > first ? (begin - first) / PANEL * PANEL : 0;
    for (; i < count; i += PANEL) {
      const size_t rows = least(PANEL, count - i);
      const size_t end = least(begin + COLUMNS, sw_front_pad(first + i + rows));
      const double *d = f->scaled + first + i;
      if (rows == PANEL)
        take(f, d, to + i * stride, stride, begin, end, PANEL);
      else
        take(f, d, to + i * stride, stride, begin, end, PANEL / 2);
    }
  }
}

/* x -= rows' y, over count columns, a multiple of TILE. */
ALWAYS void scatter(const double *row, size_t stride, size_t count, const double *y, double *x,
                    const int rows) {
  for (size_t j = 0; j < count; j += TILE) {
    lanes first = look(x + j)[0], last = look(x + j)[PARTS - 1];
#pragma GCC unroll 6
    for (int i = 0; i < rows; i++) {
      const lanes *l = look(row + (size_t)i * stride + j);
      first -= y[i] * l[0];
      if (PARTS > 1) last -= y[i] * l[PARTS - 1];
    }
    at(x + j)[0] = first;
    if (PARTS > 1) at(x + j)[PARTS - 1] = last;
  }
}

/* sum -= rows x. Four sums, with vectors of any length. */
ALWAYS void collect(const double *row, size_t stride, size_t count, const double *x, quad sum[],
                    const int rows) {
  for (size_t j = 0; j < count; j += TILE) {
    const quad first = look_at_four(x + j)[0], second = look_at_four(x + j)[1];
#pragma GCC unroll 6
    for (int i = 0; i < rows; i++) {
      const quad *l = look_at_four(row + (size_t)i * stride + j);
      sum[i] -= first * l[0];
      sum[i] -= second * l[1];
    }
  }
}

ALWAYS void forward(const sw_front *f, size_t panel, double *x, double *before, const int rows) {
  const double *row = f->factor + panel * f->stride, *kept = f->kept + KEPT * panel;
  double y[PANEL];
  for (int i = 0; i < rows; i++) y[i] = x[panel + (size_t)i];
  for (int k = rows - 1; k > 0; k--)
    for (int i = 0; i < k; i++) y[i] -= kept[KEPT * k + i] * y[k];
  scatter(row + f->place, f->stride, sw_front_pad(panel), y, x, rows);
  for (int i = 0; i < rows; i++) x[panel + (size_t)i] = y[i];
  scatter(row, f->stride, f->before, y, before, rows);
}

ALWAYS void backward(const sw_front *f, size_t panel, double *x, const double *before,
                     const int rows) {
  const double *row = f->factor + panel * f->stride, *kept = f->kept + KEPT * panel;
  quad sum[PANEL] = {{0}};
  double *y = x + panel;
  collect(row, f->stride, f->before, before, sum, rows);
  collect(row + f->place, f->stride, sw_front_pad(panel), x, sum, rows);
  for (int k = 0; k < rows; k++) {
    double value = y[k] * kept[KEPT * k + PANEL];
    value += (sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3]);
    for (int i = 0; i < k; i++) value -= kept[KEPT * k + i] * y[i];
    y[k] = value;
  }
}

ALWAYS void forward_all(const sw_front *f, double *own, double *before) {
  const size_t full = f->n / PANEL;
  if (f->n % PANEL) forward(f, full * PANEL, own, before, PANEL / 2);
  for (size_t k = full; k-- > 0;) forward(f, k * PANEL, own, before, PANEL);
}

ALWAYS void backward_all(const sw_front *f, double *own, const double *before) {
  const size_t full = f->n / PANEL;
  for (size_t k = 0; k < full; k++) backward(f, k * PANEL, own, before, PANEL);
  if (f->n % PANEL) backward(f, full * PANEL, own, before, PANEL / 2);
}

#endif
