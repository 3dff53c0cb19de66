/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums the stiffness and forces of a field's edges and the mass into block rows and right-hand
 * sides of nodes. */
#include "system/assemble.h"

#include <string.h>

#include "base/simd.h"
#include "solve/band3.h"

static inline __attribute__((always_inline)) void gather_row(const sw_field *f, size_t i,
                                                             double *restrict row) {
  double *const *own = f->own, *const *next = f->next;
  const double *const *o = (const double *const *)own;
  const double *const *x = (const double *const *)next;
  row[0] += o[0][i] + *(o[0] + i - 1) - 2.0 * x[0][i];
  row[1] += o[1][i] + *(o[1] + i - 1) - x[1][i] - x[3][i];
  row[2] += o[2][i] + *(o[2] + i - 1) - x[2][i] - x[6][i];
  row[3] += o[3][i] + *(o[3] + i - 1) - 2.0 * x[4][i];
  row[4] += o[4][i] + *(o[4] + i - 1) - x[5][i] - x[7][i];
  row[5] += o[5][i] + *(o[5] + i - 1) - 2.0 * x[8][i];
  static const int upper[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (int k = 0; k < 9; k++) {
    row[SW_ROW_NEXT + k] += x[k][i] + x[k][i + 1] - o[upper[k]][i];
    row[SW_ROW_SECOND + k] -= x[k][i + 1];
  }
}

SW_HOT
void sw_gather_rows(const sw_field *f, double rate2, double *rows) {
  const sw_plan *p = f->plan;
  for (size_t i = 0; i < p->nodes; i++) {
    double *row = rows + SW_ROW_SIZE * i;
    gather_row(f, i, row);
    const double own = p->mass_own[i] * rate2, next = p->mass_next[i] * rate2;
    row[0] += own, row[3] += own, row[5] += own;
    row[SW_ROW_NEXT] += next, row[SW_ROW_NEXT + 4] += next, row[SW_ROW_NEXT + 8] += next;
  }
}

SW_HOT
void sw_gather_residual(const sw_field *f, double rate2, const double *restrict y,
                        const double *restrict yhat, double *restrict right) {
  const sw_plan *p = f->plan;
  const size_t n = p->nodes;
  double before[3] = {0, 0, 0}; /* M_next of the previous edge times its shift */
  for (size_t i = 0; i < n; i++) {
    const double own = p->mass_own[i] * rate2, next = i + 1 < n ? p->mass_next[i] * rate2 : 0.0;
    const size_t j = i + 1 < n ? i + 1 : i;
    for (size_t k = 0; k < 3; k++) {
      const double shift = y[3 * i + k] - yhat[3 * i + k];
      const double after = next * (y[3 * j + k] - yhat[3 * j + k]);
      right[3 * i + k] = f->force[3 * i + k] + f->gradient[k][i] - *(f->gradient[k] + i - 1) -
                         own * shift - before[k] - after;
      before[k] = next * shift;
    }
  }
}

void sw_drop_row(double *rows, size_t i) {
  double *row = rows + SW_ROW_SIZE * i;
  if (i >= 2) memset(row - 2 * SW_ROW_SIZE + SW_ROW_SECOND, 0, 9 * sizeof *row);
  if (i >= 1) memset(row - SW_ROW_SIZE + SW_ROW_NEXT, 0, 9 * sizeof *row);
  memset(row, 0, SW_ROW_SIZE * sizeof *row);
  row[0] = row[3] = row[5] = 1.0;
}
