/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eliminates from both ends of the chain at once: lane 0 of each pair goes up from node 0, lane 1
 * down from node n - 1; the two middle nodes come last. One vector holds both chains. This halves
 * the work, and neither chain waits for the other's divisions. */
#include "solve/band3.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/simd.h"

typedef double pair __attribute__((vector_size(16)));
typedef long long mask __attribute__((vector_size(16)));

/* Updates left by eliminated nodes for the next two nodes of each chain. */
typedef struct pending {
  pair own[6], own_after[6], next[9];
} pending;

/* An eliminated pair. Its own block as L D L': the inverse of D in the places of the diagonal, L in
 * those of xy xz yz; then (L D)^-1 times next and second. */
typedef struct kept {
  pair split[6], v1[9], v2[9];
} kept;

typedef struct signs {
  mask negative; /* minus the count in each lane */
  mask bad;
} signs;

/* Pairs before the middle two nodes; n >= 2. */
static size_t pairs_of(size_t n) { return (n - 1) / 2; }

/* 1 if the first pair has no lane 1. */
static size_t odd_of(size_t n) { return n % 2; }

static inline pair of(double a, double b) { return (pair){a, b}; }

/* L D L' of symmetric blocks. (Updates with inverses of blocks would lose the square of the ratio
 * of axial to bending stiffness.) */
static inline void split(const pair d[6], pair out[6], signs *s) {
  const pair r0 = 1.0 / d[0], l1 = d[1] * r0, l2 = d[2] * r0;
  const pair s3 = d[3] - l1 * d[1], s4 = d[4] - l1 * d[2], s5 = d[5] - l2 * d[2];
  const pair r1 = 1.0 / s3, l3 = s4 * r1, s6 = s5 - l3 * s4, r2 = 1.0 / s6;
  out[0] = r0, out[1] = l1, out[2] = l2, out[3] = r1, out[4] = l3, out[5] = r2;
  s->negative += (d[0] < 0.0) + (s3 < 0.0) + (s6 < 0.0);
  const pair all = r0 * r1 * r2;
  s->bad |= ~(((all > 0.0) | (all < 0.0)) & (all < HUGE_VAL) & (all > -HUGE_VAL));
}

/* w = L^-1 u, v = D^-1 w. */
static inline void divide(const pair s[6], const pair u[9], pair w[9], pair v[9]) {
  for (int j = 0; j < 3; j++) {
    w[j] = u[j];
    w[3 + j] = u[3 + j] - s[1] * w[j];
    w[6 + j] = u[6 + j] - s[2] * w[j] - s[4] * w[3 + j];
    v[j] = s[0] * w[j], v[3 + j] = s[3] * w[3 + j], v[6 + j] = s[5] * w[6 + j];
  }
}

/* d -= w' v, upper half; the product is known to be symmetric. */
static inline void subtract_symmetric(pair d[6], const pair w[9], const pair v[9]) {
  d[0] -= w[0] * v[0] + w[3] * v[3] + w[6] * v[6];
  d[1] -= w[0] * v[1] + w[3] * v[4] + w[6] * v[7];
  d[2] -= w[0] * v[2] + w[3] * v[5] + w[6] * v[8];
  d[3] -= w[1] * v[1] + w[4] * v[4] + w[7] * v[7];
  d[4] -= w[1] * v[2] + w[4] * v[5] + w[7] * v[8];
  d[5] -= w[2] * v[2] + w[5] * v[5] + w[8] * v[8];
}

/* m -= w' v. */
static inline void subtract_product(pair m[9], const pair w[9], const pair v[9]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      m[3 * i + j] -= w[i] * v[j] + w[3 + i] * v[3 + j] + w[6 + i] * v[6 + j];
}

static const int TRANSPOSED[9] = {0, 3, 6, 1, 4, 7, 2, 5, 8};

/* Loads the blocks of the pair (i, j): node i as seen upwards, node j downwards. Without a lane 1
 * (j >= n) that lane is the identity. */
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

/* Stores a pair's factor in the place of its two rows, half in each. */
static inline void store(double *factor, size_t n, size_t i, size_t j, const kept *f) {
  const pair *p = f->split;
  double *up = factor + SW_ROW_SIZE * i;
  if (j < n) {
    memcpy(up, p, SW_ROW_SIZE * sizeof(double));
    memcpy(factor + SW_ROW_SIZE * j, p + SW_ROW_SIZE / 2, SW_ROW_SIZE * sizeof(double));
  } else {
    for (int k = 0; k < SW_ROW_SIZE; k++) up[k] = p[k][0];
  }
}

static inline void recall(const double *factor, size_t n, size_t i, size_t j, kept *f) {
  pair *p = f->split;
  const double *up = factor + SW_ROW_SIZE * i;
  if (j < n) {
    memcpy(p, up, SW_ROW_SIZE * sizeof(double));
    memcpy(p + SW_ROW_SIZE / 2, factor + SW_ROW_SIZE * j, SW_ROW_SIZE * sizeof(double));
  } else {
    for (int k = 0; k < SW_ROW_SIZE; k++) p[k] = of(up[k], 0.0);
  }
}

/* Factorises the two middle nodes, with the updates of both chains. */
static void factor_middle(const double *a, size_t p, const pending *left, double *factor,
                          signs *s) {
  const double *ra = a + SW_ROW_SIZE * p, *rb = ra + SW_ROW_SIZE;
  double *fa = factor + SW_ROW_SIZE * p, *fb = fa + SW_ROW_SIZE;
  pair first[6], second[6], next[9], d[6], w[9], v[9];
  for (int k = 0; k < 6; k++) {
    first[k] = of(ra[k] + left->own[k][0] + left->own_after[k][1], k == 0 || k == 3 || k == 5);
    second[k] = of(rb[k] + left->own_after[k][0] + left->own[k][1], k == 0 || k == 3 || k == 5);
  }
  for (int k = 0; k < 9; k++)
    next[k] = of(ra[SW_ROW_NEXT + k] + left->next[k][0] + left->next[TRANSPOSED[k]][1], 0.0);
  split(first, d, s);
  divide(d, next, w, v);
  subtract_symmetric(second, w, v);
  for (int k = 0; k < 6; k++) fa[k] = d[k][0];
  for (int k = 0; k < 9; k++) fa[SW_ROW_NEXT + k] = v[k][0];
  split(second, d, s);
  for (int k = 0; k < 6; k++) fb[k] = d[k][0];
}

enum { SELDOM = 0xffff }; /* nodes between two checks for an interrupt [-] */

SW_HOT
sw_status sw_band3_factor(const double *a, size_t n, double *factor, size_t *negative) {
  const size_t odd = odd_of(n), count = pairs_of(n);
  pending left;
  signs s = {{0, 0}, {0, 0}};
  kept f;
  memset(&left, 0, sizeof left);
  for (size_t k = 0; k < count; k++) {
    const size_t j = odd && k == 0 ? n : n - 1 - (k - odd);
    pair own[6], u1[9], u2[9], w1[9], w2[9];
    if (!(k & SELDOM) && sw_interrupted()) return SW_EINTR;
    load(a, n, k, j, own, u1, u2);
    for (int c = 0; c < 6; c++) own[c] += left.own[c];
    for (int c = 0; c < 9; c++) u1[c] += left.next[c];
    split(own, f.split, &s);
    divide(f.split, u1, w1, f.v1);
    divide(f.split, u2, w2, f.v2);
    memcpy(left.own, left.own_after, sizeof left.own);
    subtract_symmetric(left.own, w1, f.v1);
    memset(left.own_after, 0, sizeof left.own_after);
    subtract_symmetric(left.own_after, w2, f.v2);
    memset(left.next, 0, sizeof left.next);
    subtract_product(left.next, w1, f.v2);
    store(factor, n, k, j, &f);
  }
  factor_middle(a, count, &left, factor, &s);
  if (negative) *negative = (size_t)(-s.negative[0] - s.negative[1]);
  return s.bad[0] | s.bad[1] ? SW_ESINGULAR : SW_OK;
}

/* A pair's factor in the place of its two rows. */
typedef double loose __attribute__((vector_size(16), aligned(8), may_alias));
typedef struct rows {
  const double *up, *down;
} rows;

enum { SPLIT = 0, V1 = 6, V2 = 15 }; /* as in kept */

static inline pair part(rows f, int k) {
  const int half = SW_ROW_SIZE / 2;
  return *(const loose *)(k < half ? f.up + 2 * k : f.down + 2 * (k - half));
}

/* Each pair waits for the previous one, so terms are subtracted one by one, in the order of their
 * computation. */

/* b -= w' z, z[2] known last */
static inline void subtract_transposed(pair b[3], rows f, int w, const pair z[3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) b[j] -= part(f, w + 3 * i + j) * z[i];
}

/* b -= w z, z[0] known last */
static inline void subtract_times(pair b[3], rows f, int w, const pair z[3]) {
  for (int i = 2; i >= 0; i--)
    for (int j = 0; j < 3; j++) b[j] -= part(f, w + 3 * j + i) * z[i];
}

/* Eliminates a pair: z becomes the rest of its right-hand side; first and second are the updates of
 * the next two pairs. */
static inline void forward(rows f, pair z[3], pair first[3], pair second[3]) {
  for (int c = 0; c < 3; c++) z[c] += first[c], first[c] = second[c], second[c] = of(0.0, 0.0);
  z[2] -= part(f, SPLIT + 2) * z[0];
  z[1] -= part(f, SPLIT + 1) * z[0];
  z[2] -= part(f, SPLIT + 4) * z[1];
  subtract_transposed(first, f, V1, z);
  subtract_transposed(second, f, V2, z);
}

/* Back substitution: x1 and x2 are the solution at the next two nodes of each chain, and then at
 * this one and the next. */
static inline void backward(rows f, pair z[3], pair x1[3], pair x2[3]) {
  z[0] *= part(f, SPLIT), z[1] *= part(f, SPLIT + 3), z[2] *= part(f, SPLIT + 5);
  subtract_times(z, f, V2, x2);
  subtract_times(z, f, V1, x1);
  z[0] -= part(f, SPLIT + 2) * z[2];
  z[1] -= part(f, SPLIT + 4) * z[2];
  z[0] -= part(f, SPLIT + 1) * z[1];
  for (int c = 0; c < 3; c++) x2[c] = x1[c], x1[c] = z[c];
}

static void solve_middle(const double *factor, double *b, size_t p, const pair first[3],
                         const pair second[3]) {
  const double *fa = factor + SW_ROW_SIZE * p, *fb = fa + SW_ROW_SIZE, *v = fa + SW_ROW_NEXT;
  double *x = b + 3 * p, *y = x + 3;
  for (int k = 0; k < 3; k++) {
    x[k] += first[k][0] + second[k][1];
    y[k] += second[k][0] + first[k][1];
  }
  x[1] -= fa[1] * x[0];
  x[2] -= fa[2] * x[0] + fa[4] * x[1];
  for (int k = 0; k < 3; k++) y[k] -= v[k] * x[0] + v[3 + k] * x[1] + v[6 + k] * x[2];
  y[1] -= fb[1] * y[0];
  y[2] = fb[5] * (y[2] - fb[2] * y[0] - fb[4] * y[1]);
  y[1] = fb[3] * y[1] - fb[4] * y[2];
  y[0] = fb[0] * y[0] - fb[1] * y[1] - fb[2] * y[2];
  x[0] *= fa[0], x[1] *= fa[3], x[2] *= fa[5];
  for (int k = 0; k < 3; k++) x[k] -= v[3 * k] * y[0] + v[3 * k + 1] * y[1] + v[3 * k + 2] * y[2];
  x[1] -= fa[4] * x[2];
  x[0] -= fa[1] * x[1] + fa[2] * x[2];
}

/* Loads the first pair of an odd number of nodes, which has no lane 1. */
static rows alone(const double *factor, kept *room) {
  const double *flat = (const double *)room;
  recall(factor, 3, 0, 3, room);
  return (rows){flat, flat + SW_ROW_SIZE};
}

static inline rows rows_of(const double *factor, size_t k, size_t j) {
  return (rows){factor + SW_ROW_SIZE * k, factor + SW_ROW_SIZE * j};
}

static inline void take(const double *up, const double *down, pair z[3]) {
  for (int c = 0; c < 3; c++) z[c] = of(up[c], down[c]);
}

static inline void give(double *up, double *down, const pair z[3]) {
  for (int c = 0; c < 3; c++) up[c] = z[c][0], down[c] = z[c][1];
}

SW_HOT
void sw_band3_solve(const double *factor, size_t n, double *b) {
  const size_t odd = n > 2 ? odd_of(n) : 0, count = pairs_of(n);
  double nothing[3] = {0};
  kept room;
  pair first[3] = {{0}}, second[3] = {{0}}, z[3], x1[3], x2[3];
  if (odd) {
    take(b, nothing, z);
    forward(alone(factor, &room), z, first, second);
    give(b, nothing, z);
  }
  for (size_t k = odd, j = n - 1; k < count; k++, j--) {
    take(b + 3 * k, b + 3 * j, z);
    forward(rows_of(factor, k, j), z, first, second);
    give(b + 3 * k, b + 3 * j, z);
  }
  solve_middle(factor, b, count, first, second);
  take(b + 3 * count, b + 3 * count + 3, x1);
  take(b + 3 * count + 3, b + 3 * count, x2);
  for (size_t k = count, j = n - (count - odd); k-- > odd; j++) {
    take(b + 3 * k, b + 3 * j, z);
    backward(rows_of(factor, k, j), z, x1, x2);
    give(b + 3 * k, b + 3 * j, z);
  }
  if (!odd) return;
  nothing[0] = nothing[1] = nothing[2] = 0;
  take(b, nothing, z);
  backward(alone(factor, &room), z, x1, x2);
  give(b, nothing, z);
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
