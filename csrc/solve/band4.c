/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eliminates from both ends of the chain at once, as in band3. A block's row of four is one vector.
 * An eliminated node keeps L D L' of its own block: L' in the first three rows right of the
 * diagonal of ones, the inverse of D in the last row. It also keeps (L D)^-1 times its blocks to
 * the next two nodes of its chain; downwards these are the two nodes before it. (Inverses of blocks
 * would lose the square of the ratio of axial to bending stiffness.) */
#include "solve/band4.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/simd.h"

#pragma GCC diagnostic ignored "-Wpsabi" /* vectors stay inside this file */
typedef double quad __attribute__((vector_size(32), aligned(8)));
typedef long long lanes __attribute__((vector_size(32)));
#define MIX __builtin_shufflevector

static inline quad *at(double *p) { return (quad *)(void *)p; }
static inline const quad *look(const double *p) { return (const quad *)(const void *)p; }

static inline void transpose(const quad a[4], quad out[4]) {
  const quad even0 = MIX(a[0], a[1], 0, 4, 2, 6), odd0 = MIX(a[0], a[1], 1, 5, 3, 7);
  const quad even2 = MIX(a[2], a[3], 0, 4, 2, 6), odd2 = MIX(a[2], a[3], 1, 5, 3, 7);
  out[0] = MIX(even0, even2, 0, 1, 4, 5);
  out[1] = MIX(odd0, odd2, 0, 1, 4, 5);
  out[2] = MIX(even0, even2, 2, 3, 6, 7);
  out[3] = MIX(odd0, odd2, 2, 3, 6, 7);
}

typedef struct signs {
  lanes negative; /* minus the count of each step's pivots */
  lanes bad;      /* a pivot vanished or was not a number */
} signs;

/* The lanes after lane k. */
static const lanes AFTER[4] = {{0, -1, -1, -1}, {0, 0, -1, -1}, {0, 0, 0, -1}, {0, 0, 0, 0}};

static inline quad only(quad x, lanes which) { return (quad)((lanes)x & which); }

/* Factorises a symmetric block's upper half as L D L'. */
static inline void split(quad d[4], signs *s) {
  quad inverses = {0};
  for (int p = 0; p < 4; p++) {
    const double r = 1.0 / d[p][p];
    const quad l = only(d[p] * r, AFTER[p]);
    for (int i = p + 1; i < 4; i++) d[i] -= d[p][i] * l;
    inverses[p] = r;
    d[p] = l;
  }
  d[3] = inverses;
  s->negative += inverses < 0.0;
  s->bad |=
      ~(((inverses > 0.0) | (inverses < 0.0)) & (inverses < HUGE_VAL) & (inverses > -HUGE_VAL));
}

static size_t count_of(const lanes *minus) {
  return (size_t)(-(*minus)[0] - (*minus)[1] - (*minus)[2] - (*minus)[3]);
}

/* u becomes L^-1 u, and v D^-1 times that. */
static inline void divide(const double *s, quad u[4], quad v[4]) {
  u[1] -= s[1] * u[0];
  u[2] -= s[2] * u[0] + s[6] * u[1];
  u[3] -= s[3] * u[0] + s[7] * u[1] + s[11] * u[2];
  for (int i = 0; i < 4; i++) v[i] = s[12 + i] * u[i];
}

/* m -= u' w */
static inline void subtract_transposed(double *m, const double *u, const quad w[4]) {
  for (int i = 0; i < 4; i++)
    at(m)[i] -= u[i] * w[0] + u[4 + i] * w[1] + u[8 + i] * w[2] + u[12 + i] * w[3];
}

static inline void put(double *out, const quad m[4]) {
  for (int k = 0; k < 4; k++) at(out)[k] = m[k];
}

static inline void get(const double *from, quad m[4]) {
  for (int k = 0; k < 4; k++) m[k] = look(from)[k];
}

/* Eliminates the node of this row upwards, after its own block was split. */
static inline void go_up(double *row) {
  double *u1 = row + SW_ROW4_NEXT, *u2 = row + SW_ROW4_SECOND, *after = row + SW_ROW4_SIZE;
  quad w1[4], w2[4], v1[4], v2[4];
  get(u1, w1);
  get(u2, w2);
  divide(row, w1, v1);
  divide(row, w2, v2);
  put(u1, w1);
  put(u2, w2);
  subtract_transposed(after, u1, v1);
  subtract_transposed(after + SW_ROW4_NEXT, u1, v2);
  subtract_transposed(after + SW_ROW4_SIZE, u2, v2);
  put(u1, v1);
  put(u2, v2);
}

/* The same downwards: its blocks to the nodes before it are stored in their rows. */
static inline void go_down(double *row) {
  double *before = row - SW_ROW4_SIZE, *first = before - SW_ROW4_SIZE;
  double *u1 = row + SW_ROW4_NEXT, *u2 = row + SW_ROW4_SECOND;
  quad u[4], w1[4], w2[4], v1[4], v2[4];
  get(before + SW_ROW4_NEXT, u);
  transpose(u, w1);
  get(first + SW_ROW4_SECOND, u);
  transpose(u, w2);
  divide(row, w1, v1);
  divide(row, w2, v2);
  put(u1, w1);
  put(u2, w2);
  subtract_transposed(before, u1, v1);
  subtract_transposed(first + SW_ROW4_NEXT, u2, v1);
  subtract_transposed(first, u2, v2);
  put(u1, v1);
  put(u2, v2);
}

/* Number of nodes of each chain; two are left, and node 0 if n is odd. */
static size_t pairs_of(size_t n) { return (n - 2) / 2; }

/* Factorises the two nodes in the middle. */
static void factor_middle(double *row, signs *s) {
  double *next = row + SW_ROW4_NEXT;
  quad d[4], w[4], v[4];
  get(row, d);
  split(d, s);
  put(row, d);
  get(next, w);
  divide(row, w, v);
  put(next, w);
  subtract_transposed(row + SW_ROW4_SIZE, next, v);
  put(next, v);
  get(row + SW_ROW4_SIZE, d);
  split(d, s);
  put(row + SW_ROW4_SIZE, d);
}

enum { SELDOM = 0xffff }; /* nodes between two checks for an interrupt [-] */

SW_HOT
sw_status sw_band4_factor(double *a, size_t n, size_t *negative) {
  signs s = {{0}, {0}}, t = {{0}, {0}};
  const size_t odd = n % 2, count = pairs_of(n);
  quad d[4], e[4];
  if (odd) {
    get(a, d);
    split(d, &s);
    put(a, d);
    go_up(a);
  }
  for (size_t k = 0; k < count; k++) {
    double *up = a + SW_ROW4_SIZE * (k + odd), *down = a + SW_ROW4_SIZE * (n - 1 - k);
    if (!(k & SELDOM) && sw_interrupted()) return SW_EINTR;
    get(up, d);
    get(down, e);
    split(d, &s);
    split(e, &t);
    put(up, d);
    put(down, e);
    go_up(up);
    go_down(down);
  }
  factor_middle(a + SW_ROW4_SIZE * (count + odd), &s);
  s.negative += t.negative;
  s.bad |= t.bad;
  if (negative) *negative = count_of(&s.negative);
  return count_of(&s.bad) ? SW_ESINGULAR : SW_OK;
}

/* m' x */
static inline quad combine(const double *m, const double *x) {
  const quad *row = look(m);
  return row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3] * x[3];
}

/* m x + k y */
static inline quad apply(const double *m, quad x, const double *k, quad y) {
  const quad *f = look(m), *g = look(k);
  const quad a = f[0] * x + g[0] * y, b = f[1] * x + g[1] * y;
  const quad c = f[2] * x + g[2] * y, d = f[3] * x + g[3] * y;
  const quad ab = MIX(a, b, 0, 4, 2, 6) + MIX(a, b, 1, 5, 3, 7);
  const quad cd = MIX(c, d, 0, 4, 2, 6) + MIX(c, d, 1, 5, 3, 7);
  return MIX(ab, cd, 0, 1, 4, 5) + MIX(ab, cd, 2, 3, 6, 7);
}

/* L^-1 x */
static inline quad forward(const double *m, quad x) {
  const quad *row = look(m);
  x -= row[0] * x[0];
  x -= row[1] * x[1];
  return x - row[2] * x[2];
}

/* L'^-1 x */
static inline quad backward(const double *m, quad x) {
  const double z = x[2] - m[11] * x[3];
  const double y = x[1] - m[7] * x[3] - m[6] * z;
  return (quad){x[0] - m[3] * x[3] - m[2] * z - m[1] * y, y, z, x[3]};
}

/* D^-1 x */
static inline quad scale(const double *m, quad x) { return look(m)[3] * x; }

static void solve_middle(const double *row, double *b) {
  const double *next = row + SW_ROW4_NEXT, *last = row + SW_ROW4_SIZE;
  const quad none = {0};
  *at(b) = forward(row, *at(b));
  *at(b + 4) -= combine(next, b);
  *at(b + 4) = backward(last, scale(last, forward(last, *at(b + 4))));
  *at(b) = backward(row, scale(row, *at(b)) - apply(next, *at(b + 4), next, none));
}

SW_HOT
void sw_band4_solve(const double *factor, size_t n, double *b) {
  const size_t odd = n % 2, count = pairs_of(n), middle = count + odd;
  for (size_t k = 0; k < middle; k++) {
    const double *up = factor + SW_ROW4_SIZE * k;
    double *to = b + 4 * k;
    *at(to) = forward(up, *at(to));
    *at(to + 4) -= combine(up + SW_ROW4_NEXT, to);
    *at(to + 8) -= combine(up + SW_ROW4_SECOND, to);
    if (k < odd) continue;
    const double *down = factor + SW_ROW4_SIZE * (n - 1 - (k - odd));
    to = b + 4 * (n - 1 - (k - odd));
    *at(to) = forward(down, *at(to));
    *at(to - 4) -= combine(down + SW_ROW4_NEXT, to);
    *at(to - 8) -= combine(down + SW_ROW4_SECOND, to);
  }
  solve_middle(factor + SW_ROW4_SIZE * middle, b + 4 * middle);
  for (size_t k = middle; k-- > 0;) {
    const double *up = factor + SW_ROW4_SIZE * k;
    double *to = b + 4 * k;
    *at(to) = backward(up, scale(up, *at(to)) - apply(up + SW_ROW4_NEXT, *at(to + 4),
                                                      up + SW_ROW4_SECOND, *at(to + 8)));
    if (k < odd) continue;
    const double *down = factor + SW_ROW4_SIZE * (n - 1 - (k - odd));
    to = b + 4 * (n - 1 - (k - odd));
    *at(to) = backward(down, scale(down, *at(to)) - apply(down + SW_ROW4_NEXT, *at(to - 4),
                                                          down + SW_ROW4_SECOND, *at(to - 8)));
  }
}
