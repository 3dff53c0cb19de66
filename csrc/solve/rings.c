/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Block-tridiagonal matrix of rings: storage, slots, products. */
#include "solve/rings.h"

#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/simd.h"
#include "solve/blocks_front.h"

typedef double quad __attribute__((vector_size(32), aligned(8)));
static inline quad *at(double *p) { return (quad *)(void *)p; }
static inline const quad *look(const double *p) { return (const quad *)(const void *)p; }

void sw_rings_free(sw_rings *r) {
  if (!r) return;
  SW_FREE_ALL(r->values, r->factor, r->kept, r->scaled, r->x, r);
}

static sw_status allocate(sw_rings *r) {
  const size_t one = r->n * r->stride;
  if (r->rings > SIZE_MAX / 16 / one) return SW_ENOMEM;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(r->values, r->rings * one), SW_ROOM(r->factor, r->rings * one),
                      SW_ROOM(r->kept, r->rings * r->n * SW_FRONT_KEPT),
                      SW_ROOM(r->scaled, 3 * one), SW_ROOM(r->x, 2 * r->rings * r->padded)));
  r->masked = r->scaled + 2 * one;
  r->y = r->x + r->rings * r->padded;
  return SW_OK;
}

sw_status sw_rings_new(size_t rings, size_t per_ring, sw_rings **out) {
  if (rings < 1 || per_ring < 1) return SW_EINVAL;
  if (per_ring > 1 << 14) return SW_ENOMEM; /* one ring would fill all memory */
  sw_rings *r = sw_alloc(1, sizeof *r);
  if (!r) return SW_ENOMEM;
  r->rings = rings, r->per_ring = per_ring, r->n = 3 * per_ring;
  r->padded = sw_front_pad(r->n);
  r->stride = 2 * r->padded + SW_FRONT_TILE;
  const sw_status status = allocate(r);
  if (status == SW_OK)
    *out = r;
  else
    sw_rings_free(r);
  return status;
}

size_t sw_rings_slot(const sw_rings *r, size_t i, size_t j) {
  const size_t ring = i / r->per_ring, other = j / r->per_ring;
  if (j > i || ring - other > 1 || ring >= r->rings) return SIZE_MAX;
  return 3 * i * r->stride + (ring == other) * r->padded + 3 * (j - other * r->per_ring);
}

void sw_rings_pad(const sw_rings *r, const double *x, double *padded) {
  for (size_t k = 0; k < r->rings; k++, padded += r->padded) {
    memcpy(padded, x + k * r->n, r->n * sizeof *x);
    memset(padded + r->n, 0, (r->padded - r->n) * sizeof *x); /* else a NaN would stay for good */
  }
}

void sw_rings_unpad(const sw_rings *r, const double *padded, double *x) {
  for (size_t k = 0; k < r->rings; k++)
    memcpy(x + k * r->n, padded + k * r->padded, r->n * sizeof *x);
}

/* Multiplies three rows, columns 0 to columns, and their mirror image: sum += rows x, y += rows'
 * own. */
static inline void mirror(const double *row, size_t stride, size_t columns, const double own[3],
                          const double *x, double *y, double sum[3]) {
  const double *a = row, *b = row + stride, *c = b + stride;
  quad sa = {0}, sb = {0}, sc = {0};
  size_t j = 0;
  for (; j + 4 <= columns; j += 4) {
    const quad va = *look(a + j), vb = *look(b + j), vc = *look(c + j), vx = *look(x + j);
    sa += va * vx, sb += vb * vx, sc += vc * vx;
    *at(y + j) += va * own[0] + vb * own[1] + vc * own[2];
  }
  sum[0] += sa[0] + sa[1] + sa[2] + sa[3];
  sum[1] += sb[0] + sb[1] + sb[2] + sb[3];
  sum[2] += sc[0] + sc[1] + sc[2] + sc[3];
  for (; j < columns; j++) {
    sum[0] += a[j] * x[j], sum[1] += b[j] * x[j], sum[2] += c[j] * x[j];
    y[j] += a[j] * own[0] + b[j] * own[1] + c[j] * own[2];
  }
}

/* sum += a node's own block, of which only the lower half is read, times x. */
static inline void add_own(const double *block, size_t stride, const double x[3], double sum[3]) {
  const double *second = block + stride, *third = second + stride;
  sum[0] += block[0] * x[0] + second[0] * x[1] + third[0] * x[2];
  sum[1] += second[0] * x[0] + second[1] * x[1] + third[1] * x[2];
  sum[2] += third[0] * x[0] + third[1] * x[1] + third[2] * x[2];
}

SW_HOT
void sw_rings_multiply(const sw_rings *r, const double *x, double *y) {
  sw_rings_pad(r, x, r->x);
  memset(r->y, 0, r->rings * r->padded * sizeof *r->y);
  for (size_t k = 0; k < r->rings; k++) {
    double *xk = r->x + k * r->padded, *yk = r->y + k * r->padded;
    for (size_t p = 0; p < r->n; p += 3) {
      const double *row = r->values + (k * r->n + p) * r->stride;
      double sum[3] = {0, 0, 0};
      if (k > 0) mirror(row, r->stride, r->padded, xk + p, xk - r->padded, yk - r->padded, sum);
      mirror(row + r->padded, r->stride, p, xk + p, xk, yk, sum);
      add_own(row + r->padded + p, r->stride, xk + p, sum);
      for (int c = 0; c < 3; c++) yk[p + (size_t)c] += sum[c];
    }
  }
  sw_rings_unpad(r, r->y, y);
}

/* sum += the transposes of blocks below one another times x. */
static void add_below(const double *column, size_t stride, size_t rows, const double *x,
                      double sum[3]) {
  for (size_t k = 0; k < rows; k++)
    for (size_t c = 0; c < 3; c++) sum[c] += column[k * stride + c] * x[k];
}

void sw_rings_row_times(const sw_rings *r, size_t node, const double *x, double y[3]) {
  const size_t n = r->n, k = node / r->per_ring, p = 3 * (node % r->per_ring);
  const double *row = r->values + (k * n + p) * r->stride, *own = row + r->padded + p;
  const double *xk = x + k * n;
  double sum[3] = {0, 0, 0};
  for (size_t c = 0; c < 3; c++) {
    const double *a = row + c * r->stride;
    for (size_t j = 0; k > 0 && j < n; j++) sum[c] += a[j] * (xk - n)[j];
    for (size_t j = 0; j < p; j++) sum[c] += a[r->padded + j] * xk[j];
  }
  add_own(own, r->stride, xk + p, sum);
  add_below(own + 3 * r->stride, r->stride, n - p - 3, xk + p + 3, sum);
  if (k + 1 < r->rings)
    add_below(r->values + (k + 1) * n * r->stride + p, r->stride, n, xk + n, sum);
  memcpy(y, sum, sizeof sum);
}
