/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A block's row of four is one vector. Each diagonal block is inverted by
 * Gauss-Jordan steps, whose pivots are those of the factorisation. */
#include "solve/band4.h"

#include <math.h>

#include "base/simd.h"

typedef double quad __attribute__((vector_size(32), aligned(8)));

static inline quad *at(double *p) { return (quad *)(void *)p; }
static inline const quad *look(const double *p) { return (const quad *)(const void *)p; }

/* d = inverse of d; counts negative pivots, returns 0 when one is no number. */
static inline int invert(quad d[4], size_t *negative) {
  int good = 1;
  for (int p = 0; p < 4; p++) {
    const double pivot = d[p][p], r = 1.0 / pivot;
    good &= fabs(pivot) > 0 && fabs(r) > 0;
    *negative += pivot < 0;
    quad row = d[p] * r;
    row[p] = r;
    for (int i = 0; i < 4; i++) {
      if (i == p) continue;
      const double f = d[i][p];
      quad own = d[i];
      own[p] = 0;
      d[i] = own - f * row;
    }
    d[p] = row;
  }
  return good;
}

/* The lower half becomes the upper one's mirror image. Rounding that is not
 * symmetric would grow from node to node. */
static inline void mirror(quad d[4]) {
  for (int i = 1; i < 4; i++)
    for (int j = 0; j < i; j++) d[i][j] = d[j][i];
}

/* w = s u */
static inline void times(const quad s[4], const quad u[4], quad w[4]) {
  for (int i = 0; i < 4; i++)
    w[i] = s[i][0] * u[0] + s[i][1] * u[1] + s[i][2] * u[2] + s[i][3] * u[3];
}

/* m -= u' w */
static inline void subtract_product(quad m[4], const quad u[4], const quad w[4]) {
  for (int i = 0; i < 4; i++)
    m[i] -= u[0][i] * w[0] + u[1][i] * w[1] + u[2][i] * w[2] + u[3][i] * w[3];
}

SW_HOT
sw_status sw_band4_factor(double *a, size_t n, size_t *negative) {
  size_t count = 0;
  int good = 1;
  for (size_t i = 0; i < n; i++) {
    double *row = a + SW_ROW4_SIZE * i;
    quad d[4], u1[4], u2[4], w1[4], w2[4];
    for (int k = 0; k < 4; k++) {
      d[k] = look(row)[k];
      u1[k] = look(row + SW_ROW4_NEXT)[k];
      u2[k] = look(row + SW_ROW4_SECOND)[k];
    }
    mirror(d);
    good &= invert(d, &count);
    mirror(d);
    times(d, u1, w1);
    times(d, u2, w2);
    if (i + 1 < n) {
      subtract_product(at(row + SW_ROW4_SIZE), u1, w1);
      subtract_product(at(row + SW_ROW4_SIZE + SW_ROW4_NEXT), u1, w2);
    }
    if (i + 2 < n) subtract_product(at(row + 2 * SW_ROW4_SIZE), u2, w2);
    for (int k = 0; k < 4; k++) {
      at(row)[k] = d[k];
      at(row + SW_ROW4_NEXT)[k] = w1[k];
      at(row + SW_ROW4_SECOND)[k] = w2[k];
    }
  }
  if (negative) *negative = count;
  return good ? SW_OK : SW_ESINGULAR;
}

/* out = m' x */
static inline void combine(const quad m[4], const quad *x, quad *out) {
  *out = m[0] * (*x)[0] + m[1] * (*x)[1] + m[2] * (*x)[2] + m[3] * (*x)[3];
}

static inline double dot(const quad *a, const quad *b) {
  const quad p = *a * *b;
  return (p[0] + p[1]) + (p[2] + p[3]);
}

SW_HOT
void sw_band4_solve(const double *factor, size_t n, double *b) {
  for (size_t i = 0; i < n; i++) {
    const double *row = factor + SW_ROW4_SIZE * i;
    const quad z = *look(b + 4 * i);
    quad push;
    combine(look(row + SW_ROW4_NEXT), &z, &push);
    if (i + 1 < n) *at(b + 4 * i + 4) -= push;
    combine(look(row + SW_ROW4_SECOND), &z, &push);
    if (i + 2 < n) *at(b + 4 * i + 8) -= push;
  }
  quad x1 = {0}, x2 = {0};
  for (size_t i = n; i-- > 0;) {
    const double *row = factor + SW_ROW4_SIZE * i;
    quad x;
    combine(look(row), look(b + 4 * i), &x);
    for (int k = 0; k < 4; k++)
      x[k] -= dot(look(row + SW_ROW4_NEXT) + k, &x1) + dot(look(row + SW_ROW4_SECOND) + k, &x2);
    x2 = x1;
    x1 = x;
    *at(b + 4 * i) = x;
  }
}
