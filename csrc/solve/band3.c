/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/band3.h"

#include <math.h>
#include <string.h>

#include "base/simd.h"

/* Inverse of a symmetric 3 x 3 block: the first row is eliminated, the rest is
 * inverted by cofactors. (Cofactors of the whole block would lose the square of
 * the ratio of axial to bending stiffness.) The leading minors tell the signs of
 * the pivots. Returns the determinant. */
static inline double invert(const double d[6], double inverse[6], size_t *negative) {
  const double r0 = 1.0 / d[0], l1 = d[1] * r0, l2 = d[2] * r0;
  const double s3 = d[3] - l1 * d[1], s4 = d[4] - l1 * d[2], s5 = d[5] - l2 * d[2];
  const double minor = s3 * s5 - s4 * s4, r = 1.0 / minor;
  inverse[3] = s5 * r;
  inverse[4] = -s4 * r;
  inverse[5] = s3 * r;
  inverse[1] = -(l1 * inverse[3] + l2 * inverse[4]);
  inverse[2] = -(l1 * inverse[4] + l2 * inverse[5]);
  inverse[0] = r0 - (l1 * inverse[1] + l2 * inverse[2]);
  *negative += (size_t)(d[0] < 0) + (size_t)(s3 < 0) + (size_t)(s3 < 0 ? minor > 0 : minor < 0);
  return d[0] * minor;
}

/* w = S u for symmetric S. */
static inline void symmetric_times(const double s[6], const double u[9], double w[9]) {
  for (int j = 0; j < 3; j++) {
    w[j] = s[0] * u[j] + s[1] * u[3 + j] + s[2] * u[6 + j];
    w[3 + j] = s[1] * u[j] + s[3] * u[3 + j] + s[4] * u[6 + j];
    w[6 + j] = s[2] * u[j] + s[4] * u[3 + j] + s[5] * u[6 + j];
  }
}

/* d -= u' w, upper half of a product known to be symmetric. */
static inline void subtract_symmetric(double d[6], const double u[9], const double w[9]) {
  d[0] -= u[0] * w[0] + u[3] * w[3] + u[6] * w[6];
  d[1] -= u[0] * w[1] + u[3] * w[4] + u[6] * w[7];
  d[2] -= u[0] * w[2] + u[3] * w[5] + u[6] * w[8];
  d[3] -= u[1] * w[1] + u[4] * w[4] + u[7] * w[7];
  d[4] -= u[1] * w[2] + u[4] * w[5] + u[7] * w[8];
  d[5] -= u[2] * w[2] + u[5] * w[5] + u[8] * w[8];
}

/* m -= u' w. */
static inline void subtract_product(double m[9], const double u[9], const double w[9]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      m[3 * i + j] -= u[i] * w[j] + u[3 + i] * w[3 + j] + u[6 + i] * w[6 + j];
}

SW_HOT
sw_status sw_band3_factor(const double *a, size_t n, double *factor, size_t *negative) {
  double own[6] = {0}, own_next[6] = {0}, own_second[6] = {0}; /* pending updates */
  double next[9] = {0}, next_next[9] = {0};
  size_t negatives = 0;
  int bad = 0;
  for (size_t i = 0; i < n; i++) {
    const double *row = a + SW_ROW_SIZE * i;
    double *out = factor + SW_ROW_SIZE * i;
    double u1[9], u2[9], inverse[6], w1[9], w2[9];
    for (int k = 0; k < 6; k++) own[k] = row[SW_ROW_OWN + k] + own_next[k];
    for (int k = 0; k < 9; k++) u1[k] = next[k] = row[SW_ROW_NEXT + k] + next_next[k];
    for (int k = 0; k < 9; k++) u2[k] = row[SW_ROW_SECOND + k];
    const double det = invert(own, inverse, &negatives);
    bad |= !(fabs(det) > 0 && fabs(det) < HUGE_VAL);
    symmetric_times(inverse, u1, w1);
    symmetric_times(inverse, u2, w2);
    memcpy(own_next, own_second, sizeof own_next);
    subtract_symmetric(own_next, u1, w1);
    memset(own_second, 0, sizeof own_second);
    subtract_symmetric(own_second, u2, w2);
    memset(next_next, 0, sizeof next_next);
    subtract_product(next_next, u1, w2);
    memcpy(out + SW_ROW_OWN, inverse, sizeof inverse);
    memcpy(out + SW_ROW_NEXT, w1, sizeof w1);
    memcpy(out + SW_ROW_SECOND, w2, sizeof w2);
  }
  if (negative) *negative = negatives;
  return bad ? SW_ESINGULAR : SW_OK;
}

static inline void subtract_transposed(double *b, const double w[9], const double z[3]) {
  for (int j = 0; j < 3; j++) b[j] -= w[j] * z[0] + w[3 + j] * z[1] + w[6 + j] * z[2];
}

static inline void subtract_times(double *b, const double w[9], const double z[3]) {
  for (int j = 0; j < 3; j++) b[j] -= w[3 * j] * z[0] + w[3 * j + 1] * z[1] + w[3 * j + 2] * z[2];
}

SW_HOT
void sw_band3_solve(const double *factor, size_t n, double *b) {
  for (size_t i = 0; i < n; i++) {
    const double *f = factor + SW_ROW_SIZE * i;
    const double z[3] = {b[3 * i], b[3 * i + 1], b[3 * i + 2]};
    if (i + 1 < n) subtract_transposed(b + 3 * i + 3, f + SW_ROW_NEXT, z);
    if (i + 2 < n) subtract_transposed(b + 3 * i + 6, f + SW_ROW_SECOND, z);
  }
  for (size_t i = n; i-- > 0;) {
    const double *f = factor + SW_ROW_SIZE * i;
    double *z = b + 3 * i;
    const double r[3] = {z[0], z[1], z[2]};
    z[0] = f[0] * r[0] + f[1] * r[1] + f[2] * r[2];
    z[1] = f[1] * r[0] + f[3] * r[1] + f[4] * r[2];
    z[2] = f[2] * r[0] + f[4] * r[1] + f[5] * r[2];
    if (i + 1 < n) subtract_times(z, f + SW_ROW_NEXT, b + 3 * i + 3);
    if (i + 2 < n) subtract_times(z, f + SW_ROW_SECOND, b + 3 * i + 6);
  }
}

void sw_band3_multiply(const double *a, size_t n, const double *x, double *y) {
  memset(y, 0, 3 * n * sizeof *y);
  for (size_t i = 0; i < n; i++) {
    const double *r = a + SW_ROW_SIZE * i, *p = x + 3 * i;
    double *q = y + 3 * i;
    q[0] += r[0] * p[0] + r[1] * p[1] + r[2] * p[2];
    q[1] += r[1] * p[0] + r[3] * p[1] + r[4] * p[2];
    q[2] += r[2] * p[0] + r[4] * p[1] + r[5] * p[2];
    for (size_t k = 1; k <= 2 && i + k < n; k++) {
      const double *u = r + (k == 1 ? SW_ROW_NEXT : SW_ROW_SECOND);
      const double *pk = x + 3 * (i + k);
      double *qk = y + 3 * (i + k);
      for (int j = 0; j < 3; j++) {
        q[j] += u[3 * j] * pk[0] + u[3 * j + 1] * pk[1] + u[3 * j + 2] * pk[2];
        qk[j] += u[j] * p[0] + u[3 + j] * p[1] + u[6 + j] * p[2];
      }
    }
  }
}
