/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of a sparse matrix, its factors and its solutions, by the lists of its analysis. */
#include <string.h>

#include "base/interrupt.h"
#include "base/simd.h"
#include "solve/sparse_inner.h"

typedef sw_two two;

void sw_sparse_clear(sw_sparse *s) {
  if (s->fronts)
    sw_blocks_clear(s->fronts);
  else
    memset(s->own, 0, s->block * s->block * (s->n + s->fill) * sizeof *s->own);
}

double *sw_sparse_own(sw_sparse *s, size_t node) {
  if (s->fronts) return sw_blocks_values(s->fronts) + sw_blocks_slot(s->fronts, node, node);
  return s->own + s->block * s->block * s->place[node];
}

void sw_sparse_add(sw_sparse *s, size_t pair, const double *values) {
  const size_t b = s->block;
  double *to = s->fronts ? sw_blocks_values(s->fronts) + s->slot[pair] / 2
                         : s->off + b * b * (s->slot[pair] / 2);
  const int turned = s->slot[pair] % 2;
  if (b == 3 && turned) { /* the usual ones, unrolled */
    static const int column[9] = {0, 3, 6, 1, 4, 7, 2, 5, 8};
    for (int k = 0; k < 9; k++) to[k] += values[column[k]];
  } else if (b == 3) {
    for (int k = 0; k < 9; k++) to[k] += values[k];
  } else if (turned) {
    for (size_t i = 0; i < b; i++)
      for (size_t j = 0; j < b; j++) to[b * j + i] += values[b * i + j];
  } else {
    for (size_t k = 0; k < b * b; k++) to[k] += values[k];
  }
}

/* --- factorisation --------------------------------------------------------------- */

#define ALWAYS static inline __attribute__((always_inline))

/* Factorises a symmetric block as L D L' from its lower half: L below the diagonal, the inverse of
 * D on it; counts negative pivots. Returns 0 if a pivot vanishes or is not finite. (With the
 * block's inverse instead, a wire that is oblique to the axes would lose the square of the ratio of
 * its axial to its bending stiffness; with a block whose halves differ by rounding, everything
 * would be lost.) */
ALWAYS int split(double *m, const int b, size_t *negative) {
  double product = 1.0;
  for (int k = 0; k < b; k++) {
    const double pivot = m[b * k + k], r = 1.0 / pivot;
    double below[SW_SPARSE_BLOCK_MAX];
    *negative += pivot < 0;
    product *= r * pivot; /* NaN if a pivot vanished */
    for (int i = k + 1; i < b; i++) below[i] = m[b * i + k];
    for (int i = k + 1; i < b; i++) {
      const double l = below[i] * r;
      for (int j = k + 1; j <= i; j++) m[b * i + j] -= l * below[j];
      m[b * i + k] = l;
    }
    m[b * k + k] = r;
  }
  return product > 0;
}

/* a becomes a L'^-1, and w that times D^-1. */
ALWAYS void divide(double *restrict a, const double *restrict d, double *restrict w, const int b) {
  for (int i = 0; i < b; i++)
    for (int j = 0; j < b; j++) {
      double sum = a[b * i + j];
      for (int k = 0; k < j; k++) sum -= a[b * i + k] * d[b * j + k];
      a[b * i + j] = sum;
      w[b * i + j] = sum * d[b * j + j];
    }
}

/* to -= w a' */
ALWAYS void subtract(const double *restrict w, const double *restrict a, double *restrict to,
                     const int b) {
  for (int i = 0; i < b; i++)
    for (int j = 0; j < b; j++) {
      double sum = to[b * i + j];
      for (int k = 0; k < b; k++) sum -= w[b * i + k] * a[b * j + k];
      to[b * i + j] = sum;
    }
}

ALWAYS sw_status factor(sw_sparse *s, size_t *negative, const int b) {
  const size_t bb = (size_t)b * (size_t)b;
  const uint32_t *target = s->target;
  for (size_t k = 0; k < s->n; k++) {
    double *own = s->own + bb * k;
    if (sw_interrupted()) return SW_EINTR;
    if (!split(own, b, negative)) return SW_ESINGULAR;
    const uint32_t begin = s->start[k], p = s->start[k + 1] - begin;
    double *off = s->off + bb * begin;
    for (uint32_t a = 0; a < p; a++) divide(off + bb * a, own, s->column + bb * a, b);
    for (uint32_t a = 0; a < p; a++) {
      const double *pivot = off + bb * a;
      subtract(s->column + bb * a, pivot, s->own + bb * s->row[begin + a], b);
      for (uint32_t r = a + 1; r < p; r++)
        subtract(s->column + bb * r, pivot, s->off + bb * *target++, b);
    }
    memcpy(off, s->column, bb * p * sizeof *off);
  }
  return SW_OK;
}

SW_HOT
static sw_status factor3(sw_sparse *s, size_t *negative) { return factor(s, negative, 3); }
SW_HOT
static sw_status factor4(sw_sparse *s, size_t *negative) { return factor(s, negative, 4); }

sw_status sw_sparse_factor(sw_sparse *s, size_t *negative) {
  size_t count = 0;
  if (s->fronts) return sw_blocks_factor(s->fronts, NULL, negative);
  const sw_status status = s->block == 3 ? factor3(s, &count) : factor4(s, &count);
  if (negative) *negative = count;
  return status;
}

ALWAYS int is_zero(const two *x, const int b) {
  two sum = x[0] * x[0];
  for (int i = 1; i < b; i++) sum += x[i] * x[i];
  return sum[0] + sum[1] == 0;
}

ALWAYS void solve(const sw_sparse *s, two *restrict x, const int b) {
  const size_t bb = (size_t)b * (size_t)b, bs = (size_t)b;
  for (size_t k = 0; k < s->n; k++) {
    const double *d = s->own + bb * k;
    two *xk = x + bs * k;
    if (is_zero(xk, b)) continue; /* slopes of twist are so at most nodes */
    for (int i = 1; i < b; i++)
      for (int j = 0; j < i; j++) xk[i] -= d[b * i + j] * xk[j];
    for (uint32_t e = s->start[k]; e < s->start[k + 1]; e++) {
      const double *l = s->off + bb * e;
      two *to = x + bs * s->row[e];
      for (int i = 0; i < b; i++) {
        two sum = l[b * i] * xk[0];
        for (int j = 1; j < b; j++) sum += l[b * i + j] * xk[j];
        to[i] -= sum;
      }
    }
  }
  for (size_t k = s->n; k-- > 0;) {
    const double *d = s->own + bb * k;
    two *xk = x + bs * k, sum[SW_SPARSE_BLOCK_MAX];
    for (int i = 0; i < b; i++) sum[i] = d[b * i + i] * xk[i];
    for (uint32_t e = s->start[k]; e < s->start[k + 1]; e++) {
      const double *l = s->off + bb * e;
      const two *from = x + bs * s->row[e];
      for (int j = 0; j < b; j++) {
        two part = l[j] * from[0];
        for (int i = 1; i < b; i++) part += l[b * i + j] * from[i];
        sum[j] -= part;
      }
    }
    for (int i = b - 1; i >= 0; i--) {
      for (int j = i + 1; j < b; j++) sum[i] -= d[b * j + i] * xk[j];
      xk[i] = sum[i];
    }
  }
}

SW_HOT
static void solve3(const sw_sparse *s, two *x) { solve(s, x, 3); }
SW_HOT
static void solve4(const sw_sparse *s, two *x) { solve(s, x, 4); }

void sw_sparse_solve_two(sw_sparse *s, double *one, double *other) {
  const size_t m = s->block;
  if (s->fronts) {
    sw_blocks_solve(s->fronts, one);
    if (other) sw_blocks_solve(s->fronts, other);
    return;
  }
  for (size_t i = 0; i < s->n; i++)
    for (size_t c = 0; c < m; c++)
      s->x[m * s->place[i] + c] = (two){one[m * i + c], other ? other[m * i + c] : 0.0};
  if (m == 3)
    solve3(s, s->x);
  else
    solve4(s, s->x);
  for (size_t i = 0; i < s->n; i++)
    for (size_t c = 0; c < m; c++) {
      const two v = s->x[m * s->place[i] + c];
      one[m * i + c] = v[0];
      if (other) other[m * i + c] = v[1];
    }
}

void sw_sparse_solve(sw_sparse *s, double *b) { sw_sparse_solve_two(s, b, NULL); }
