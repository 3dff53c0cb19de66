/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elimination from both ends of the chain at once: lane 0 of each pair goes up
 * from node 0, lane 1 down from node n - 1, and the two middle nodes are solved
 * last. Both chains run in one vector, which halves the work, and neither waits
 * for the other's divisions. */
#include "solve/band3.h"

#include <math.h>
#include <string.h>

#include "base/simd.h"

typedef double pair __attribute__((vector_size(16)));
typedef long long mask __attribute__((vector_size(16)));

/* Updates that eliminated nodes left for the next two of each chain. */
typedef struct pending {
  pair own[6], own_after[6], next[9];
} pending;

/* What is kept of an eliminated pair: inverse, inverse * next, inverse * second. */
typedef struct kept {
  pair inverse[6], w1[9], w2[9];
} kept;

typedef struct signs {
  mask negative; /* minus the count in each lane */
  mask bad;
} signs;

/* Pairs before the middle two nodes; n >= 2. */
static size_t pairs_of(size_t n) { return (n - 1) / 2; }

/* 1 when the first pair has no lane 1. */
static size_t odd_of(size_t n) { return n % 2; }

static inline pair of(double a, double b) { return (pair){a, b}; }

/* Inverse of symmetric blocks: the first row is eliminated, the rest is inverted
 * by cofactors. (Cofactors of the whole block would lose the square of the ratio
 * of axial to bending stiffness.) Signs of the pivots from the minors. */
static inline void invert(const pair d[6], pair inverse[6], signs *s) {
  const pair r0 = 1.0 / d[0], l1 = d[1] * r0, l2 = d[2] * r0;
  const pair s3 = d[3] - l1 * d[1], s4 = d[4] - l1 * d[2], s5 = d[5] - l2 * d[2];
  const pair minor = s3 * s5 - s4 * s4, r = 1.0 / minor;
  inverse[3] = s5 * r;
  inverse[4] = -s4 * r;
  inverse[5] = s3 * r;
  inverse[1] = -(l1 * inverse[3] + l2 * inverse[4]);
  inverse[2] = -(l1 * inverse[4] + l2 * inverse[5]);
  inverse[0] = r0 - (l1 * inverse[1] + l2 * inverse[2]);
  const mask n0 = d[0] < 0.0, n1 = s3 < 0.0, n2 = minor < 0.0;
  s->negative += n0 + n1 + (n1 ^ n2);
  const pair both = r0 * r;
  s->bad |= ~(((both > 0.0) | (both < 0.0)) & (both < HUGE_VAL) & (both > -HUGE_VAL));
}

/* w = S u for symmetric S. */
static inline void symmetric_times(const pair s[6], const pair u[9], pair w[9]) {
  for (int j = 0; j < 3; j++) {
    w[j] = s[0] * u[j] + s[1] * u[3 + j] + s[2] * u[6 + j];
    w[3 + j] = s[1] * u[j] + s[3] * u[3 + j] + s[4] * u[6 + j];
    w[6 + j] = s[2] * u[j] + s[4] * u[3 + j] + s[5] * u[6 + j];
  }
}

/* d -= u' w, upper half of a product known to be symmetric. */
static inline void subtract_symmetric(pair d[6], const pair u[9], const pair w[9]) {
  d[0] -= u[0] * w[0] + u[3] * w[3] + u[6] * w[6];
  d[1] -= u[0] * w[1] + u[3] * w[4] + u[6] * w[7];
  d[2] -= u[0] * w[2] + u[3] * w[5] + u[6] * w[8];
  d[3] -= u[1] * w[1] + u[4] * w[4] + u[7] * w[7];
  d[4] -= u[1] * w[2] + u[4] * w[5] + u[7] * w[8];
  d[5] -= u[2] * w[2] + u[5] * w[5] + u[8] * w[8];
}

/* m -= u' w. */
static inline void subtract_product(pair m[9], const pair u[9], const pair w[9]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      m[3 * i + j] -= u[i] * w[j] + u[3 + i] * w[3 + j] + u[6 + i] * w[6 + j];
}

static const int TRANSPOSED[9] = {0, 3, 6, 1, 4, 7, 2, 5, 8};

/* Blocks of the pair (i, j): node i seen upwards, node j downwards. Without a
 * lane 1 (j >= n) that lane is the identity. */
static inline void load(const double *a, size_t n, size_t i, size_t j, pair own[6], pair u1[9],
                        pair u2[9]) {
  static const double identity[6] = {1, 0, 0, 1, 0, 1};
  static const double nothing[SW_ROW_SIZE] = {0};
  const double *up = a + SW_ROW_SIZE * i;
  const double *down = j < n ? a + SW_ROW_SIZE * j : identity;
  const double *next = j < n ? a + SW_ROW_SIZE * (j - 1) + SW_ROW_NEXT : nothing;
  const double *second = j < n ? a + SW_ROW_SIZE * (j - 2) + SW_ROW_SECOND : nothing;
  for (int k = 0; k < 6; k++) own[k] = of(up[k], down[k]);
  for (int k = 0; k < 9; k++) u1[k] = of(up[SW_ROW_NEXT + k], next[TRANSPOSED[k]]);
  for (int k = 0; k < 9; k++) u2[k] = of(up[SW_ROW_SECOND + k], second[TRANSPOSED[k]]);
}

/* A pair's factor goes where its two rows were: half to each. */
static inline void store(double *factor, size_t n, size_t i, size_t j, const kept *f) {
  const pair *p = f->inverse;
  double *up = factor + SW_ROW_SIZE * i;
  if (j < n) {
    memcpy(up, p, SW_ROW_SIZE * sizeof(double));
    memcpy(factor + SW_ROW_SIZE * j, p + SW_ROW_SIZE / 2, SW_ROW_SIZE * sizeof(double));
  } else {
    for (int k = 0; k < SW_ROW_SIZE; k++) up[k] = p[k][0];
  }
}

static inline void recall(const double *factor, size_t n, size_t i, size_t j, kept *f) {
  pair *p = f->inverse;
  const double *up = factor + SW_ROW_SIZE * i;
  if (j < n) {
    memcpy(p, up, SW_ROW_SIZE * sizeof(double));
    memcpy(p + SW_ROW_SIZE / 2, factor + SW_ROW_SIZE * j, SW_ROW_SIZE * sizeof(double));
  } else {
    for (int k = 0; k < SW_ROW_SIZE; k++) p[k] = of(up[k], 0.0);
  }
}

/* The two middle nodes, with what both chains left for them. */
static void factor_middle(const double *a, size_t p, const pending *left, double *factor,
                          signs *s) {
  const double *ra = a + SW_ROW_SIZE * p, *rb = ra + SW_ROW_SIZE;
  double *fa = factor + SW_ROW_SIZE * p, *fb = fa + SW_ROW_SIZE;
  pair first[6], second[6], next[9], inverse[6], w[9];
  for (int k = 0; k < 6; k++) {
    first[k] = of(ra[k] + left->own[k][0] + left->own_after[k][1], k == 0 || k == 3 || k == 5);
    second[k] = of(rb[k] + left->own_after[k][0] + left->own[k][1], k == 0 || k == 3 || k == 5);
  }
  for (int k = 0; k < 9; k++)
    next[k] = of(ra[SW_ROW_NEXT + k] + left->next[k][0] + left->next[TRANSPOSED[k]][1], 0.0);
  invert(first, inverse, s);
  symmetric_times(inverse, next, w);
  subtract_symmetric(second, next, w);
  for (int k = 0; k < 6; k++) fa[k] = inverse[k][0];
  for (int k = 0; k < 9; k++) fa[SW_ROW_NEXT + k] = w[k][0];
  invert(second, inverse, s);
  for (int k = 0; k < 6; k++) fb[k] = inverse[k][0];
}

SW_HOT
sw_status sw_band3_factor(const double *a, size_t n, double *factor, size_t *negative) {
  const size_t odd = odd_of(n), count = pairs_of(n);
  pending left;
  signs s = {{0, 0}, {0, 0}};
  kept f;
  memset(&left, 0, sizeof left);
  for (size_t k = 0; k < count; k++) {
    const size_t j = odd && k == 0 ? n : n - 1 - (k - odd);
    pair own[6], u1[9], u2[9];
    load(a, n, k, j, own, u1, u2);
    for (int c = 0; c < 6; c++) own[c] += left.own[c];
    for (int c = 0; c < 9; c++) u1[c] += left.next[c];
    invert(own, f.inverse, &s);
    symmetric_times(f.inverse, u1, f.w1);
    symmetric_times(f.inverse, u2, f.w2);
    memcpy(left.own, left.own_after, sizeof left.own);
    subtract_symmetric(left.own, u1, f.w1);
    memset(left.own_after, 0, sizeof left.own_after);
    subtract_symmetric(left.own_after, u2, f.w2);
    memset(left.next, 0, sizeof left.next);
    subtract_product(left.next, u1, f.w2);
    store(factor, n, k, j, &f);
  }
  factor_middle(a, count, &left, factor, &s);
  if (negative) *negative = (size_t)(-s.negative[0] - s.negative[1]);
  return s.bad[0] | s.bad[1] ? SW_ESINGULAR : SW_OK;
}

static inline void subtract_transposed(pair b[3], const pair w[9], const pair z[3]) {
  for (int j = 0; j < 3; j++) b[j] -= w[j] * z[0] + w[3 + j] * z[1] + w[6 + j] * z[2];
}

static inline void subtract_times(pair b[3], const pair w[9], const pair z[3]) {
  for (int j = 0; j < 3; j++) b[j] -= w[3 * j] * z[0] + w[3 * j + 1] * z[1] + w[3 * j + 2] * z[2];
}

static inline void inverse_times(const pair s[6], const pair r[3], pair z[3]) {
  z[0] = s[0] * r[0] + s[1] * r[1] + s[2] * r[2];
  z[1] = s[1] * r[0] + s[3] * r[1] + s[4] * r[2];
  z[2] = s[2] * r[0] + s[4] * r[1] + s[5] * r[2];
}

static void solve_middle(const double *factor, double *b, size_t p, const pair first[3],
                         const pair second[3]) {
  const double *fa = factor + SW_ROW_SIZE * p, *fb = fa + SW_ROW_SIZE, *w = fa + SW_ROW_NEXT;
  double *x = b + 3 * p, *y = x + 3, u[3], v[3];
  for (int k = 0; k < 3; k++) {
    u[k] = x[k] + first[k][0] + second[k][1];
    v[k] = y[k] + second[k][0] + first[k][1];
  }
  for (int k = 0; k < 3; k++) v[k] -= w[k] * u[0] + w[3 + k] * u[1] + w[6 + k] * u[2];
  y[0] = fb[0] * v[0] + fb[1] * v[1] + fb[2] * v[2];
  y[1] = fb[1] * v[0] + fb[3] * v[1] + fb[4] * v[2];
  y[2] = fb[2] * v[0] + fb[4] * v[1] + fb[5] * v[2];
  x[0] = fa[0] * u[0] + fa[1] * u[1] + fa[2] * u[2];
  x[1] = fa[1] * u[0] + fa[3] * u[1] + fa[4] * u[2];
  x[2] = fa[2] * u[0] + fa[4] * u[1] + fa[5] * u[2];
  for (int k = 0; k < 3; k++) x[k] -= w[3 * k] * y[0] + w[3 * k + 1] * y[1] + w[3 * k + 2] * y[2];
}

SW_HOT
void sw_band3_solve(const double *factor, size_t n, double *b) {
  const size_t odd = odd_of(n), count = pairs_of(n);
  kept f;
  pair first[3] = {{0}}, second[3] = {{0}}; /* what is to be added to the next two */
  for (size_t k = 0; k < count; k++) {
    const int alone = odd && k == 0;
    const size_t j = alone ? n : n - 1 - (k - odd);
    double *up = b + 3 * k, *down = alone ? NULL : b + 3 * j;
    pair z[3];
    recall(factor, n, k, j, &f);
    for (int c = 0; c < 3; c++) z[c] = of(up[c], alone ? 0.0 : down[c]) + first[c];
    memcpy(first, second, sizeof first);
    memset(second, 0, sizeof second);
    subtract_transposed(first, f.w1, z);
    subtract_transposed(second, f.w2, z);
    for (int c = 0; c < 3; c++) up[c] = z[c][0];
    for (int c = 0; c < 3 && !alone; c++) down[c] = z[c][1];
  }
  solve_middle(factor, b, count, first, second);
  pair x1[3], x2[3]; /* solution at the next two of each chain */
  for (int c = 0; c < 3; c++) {
    x1[c] = of(b[3 * count + (size_t)c], b[3 * count + 3 + (size_t)c]);
    x2[c] = of(b[3 * count + 3 + (size_t)c], b[3 * count + (size_t)c]);
  }
  for (size_t k = count; k-- > 0;) {
    const int alone = odd && k == 0;
    const size_t j = alone ? n : n - 1 - (k - odd);
    double *up = b + 3 * k, *down = alone ? NULL : b + 3 * j;
    pair r[3], z[3];
    recall(factor, n, k, j, &f);
    for (int c = 0; c < 3; c++) r[c] = of(up[c], alone ? 0.0 : down[c]);
    inverse_times(f.inverse, r, z);
    subtract_times(z, f.w1, x1);
    subtract_times(z, f.w2, x2);
    memcpy(x2, x1, sizeof x2);
    memcpy(x1, z, sizeof x1);
    for (int c = 0; c < 3; c++) up[c] = z[c][0];
    for (int c = 0; c < 3 && !alone; c++) down[c] = z[c][1];
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
