/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elimination from both ends of the chain at once, as in band3: neither chain waits for
 * the other's divisions. A block's row of four is one vector. Each diagonal block is
 * inverted by Gauss-Jordan steps, whose pivots are those of the factorisation. An
 * eliminated node keeps its inverse and inverse times its blocks to the next two nodes
 * of its chain, which are downwards the two before it. */
#include "solve/band4.h"

#include <math.h>
#include <string.h>

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

/* The lower half becomes the upper one's mirror image. Rounding that is not
 * symmetric would grow from node to node. */
static inline void mirror(quad d[4]) {
  quad t[4];
  transpose(d, t);
  d[1] = MIX(t[1], d[1], 0, 5, 6, 7);
  d[2] = MIX(t[2], d[2], 0, 1, 6, 7);
  d[3] = MIX(t[3], d[3], 0, 1, 2, 7);
}

typedef struct signs {
  lanes negative; /* minus the count of each step's pivots */
  lanes bad;      /* a pivot vanished or was no number */
} signs;

/* All lanes but one, and that one alone. */
static const lanes BUT[4] = {{0, -1, -1, -1}, {-1, 0, -1, -1}, {-1, -1, 0, -1}, {-1, -1, -1, 0}};
static const lanes ONE[4] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, -1}};

static inline quad only(quad x, lanes which) { return (quad)((lanes)x & which); }
static inline quad either(quad x, quad y) { return (quad)((lanes)x | (lanes)y); }

/* d = inverse of d */
static inline void invert(quad d[4], signs *s) {
  quad inverses = {0};
  mirror(d);
  for (int p = 0; p < 4; p++) {
    const double r = 1.0 / d[p][p];
    const quad own = {r, r, r, r}, row = either(only(d[p] * r, BUT[p]), only(own, ONE[p]));
    for (int i = 0; i < 4; i++)
      if (i != p) d[i] = only(d[i], BUT[p]) - d[i][p] * row;
    d[p] = row;
    inverses = either(inverses, only(own, ONE[p]));
  }
  s->negative += inverses < 0.0;
  s->bad |=
      ~(((inverses > 0.0) | (inverses < 0.0)) & (inverses < HUGE_VAL) & (inverses > -HUGE_VAL));
  mirror(d);
}

static size_t count_of(const lanes *minus) {
  return (size_t)(-(*minus)[0] - (*minus)[1] - (*minus)[2] - (*minus)[3]);
}

/* w = s u */
static inline void times(const double *s, const quad u[4], quad w[4]) {
  for (int i = 0; i < 4; i++)
    w[i] = s[4 * i] * u[0] + s[4 * i + 1] * u[1] + s[4 * i + 2] * u[2] + s[4 * i + 3] * u[3];
}

/* m -= u' w */
static inline void subtract_transposed(double *m, const double *u, const quad w[4]) {
  for (int i = 0; i < 4; i++)
    at(m)[i] -= u[i] * w[0] + u[4 + i] * w[1] + u[8 + i] * w[2] + u[12 + i] * w[3];
}

/* m -= u w */
static inline void subtract(double *m, const double *u, const quad w[4]) {
  for (int i = 0; i < 4; i++)
    at(m)[i] -= u[4 * i] * w[0] + u[4 * i + 1] * w[1] + u[4 * i + 2] * w[2] + u[4 * i + 3] * w[3];
}

static inline void put(double *out, const quad m[4]) {
  for (int k = 0; k < 4; k++) at(out)[k] = m[k];
}

static inline void get(const double *from, quad m[4]) {
  for (int k = 0; k < 4; k++) m[k] = look(from)[k];
}

/* Eliminate the node of this row upwards, after its inverse was put there. */
static inline void go_up(double *row) {
  double *u1 = row + SW_ROW4_NEXT, *u2 = row + SW_ROW4_SECOND, *after = row + SW_ROW4_SIZE;
  quad u[4], w1[4], w2[4];
  get(u1, u);
  times(row, u, w1);
  get(u2, u);
  times(row, u, w2);
  subtract_transposed(after, u1, w1);
  subtract_transposed(after + SW_ROW4_NEXT, u1, w2);
  subtract_transposed(after + SW_ROW4_SIZE, u2, w2);
  put(u1, w1);
  put(u2, w2);
}

/* The same downwards: its blocks to the nodes before it stand in their rows. */
static inline void go_down(double *row) {
  double *before = row - SW_ROW4_SIZE, *u1 = before + SW_ROW4_NEXT;
  double *first = before - SW_ROW4_SIZE, *u2 = first + SW_ROW4_SECOND;
  quad u[4], t1[4], t2[4], w1[4], w2[4];
  get(u1, u);
  transpose(u, t1);
  get(u2, u);
  transpose(u, t2);
  times(row, t1, w1);
  times(row, t2, w2);
  put(row + SW_ROW4_NEXT, w1);
  put(row + SW_ROW4_SECOND, w2);
  subtract(before, u1, w1);
  subtract_transposed(first + SW_ROW4_NEXT, row + SW_ROW4_SECOND, t1);
  subtract(first, u2, w2);
}

/* How many nodes each chain has; what is left are two, and node 0 where n is odd. */
static size_t pairs_of(size_t n) { return (n - 2) / 2; }

/* The two nodes in the middle. */
static void factor_middle(double *row, signs *s) {
  quad d[4], u[4], w[4];
  get(row, d);
  invert(d, s);
  put(row, d);
  get(row + SW_ROW4_NEXT, u);
  times(row, u, w);
  subtract_transposed(row + SW_ROW4_SIZE, row + SW_ROW4_NEXT, w);
  put(row + SW_ROW4_NEXT, w);
  get(row + SW_ROW4_SIZE, d);
  invert(d, s);
  put(row + SW_ROW4_SIZE, d);
}

SW_HOT
sw_status sw_band4_factor(double *a, size_t n, size_t *negative) {
  signs s = {{0}, {0}}, t = {{0}, {0}};
  const size_t odd = n % 2, count = pairs_of(n);
  quad d[4], e[4];
  if (odd) {
    get(a, d);
    invert(d, &s);
    put(a, d);
    go_up(a);
  }
  for (size_t k = 0; k < count; k++) {
    double *up = a + SW_ROW4_SIZE * (k + odd), *down = a + SW_ROW4_SIZE * (n - 1 - k);
    get(up, d);
    get(down, e);
    invert(d, &s);
    invert(e, &t);
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

static void solve_middle(const double *row, double *b) {
  *at(b + 4) -= combine(row + SW_ROW4_NEXT, b);
  *at(b + 4) = combine(row + SW_ROW4_SIZE, b + 4);
  *at(b) = combine(row, b) - apply(row + SW_ROW4_NEXT, *at(b + 4), row, (quad){0});
}

SW_HOT
void sw_band4_solve(const double *factor, size_t n, double *b) {
  const size_t odd = n % 2, count = pairs_of(n), middle = count + odd;
  for (size_t k = 0; k < middle; k++) {
    const double *up = factor + SW_ROW4_SIZE * k;
    double *to = b + 4 * k;
    *at(to + 4) -= combine(up + SW_ROW4_NEXT, to);
    *at(to + 8) -= combine(up + SW_ROW4_SECOND, to);
    if (k < odd) continue;
    const double *down = factor + SW_ROW4_SIZE * (n - 1 - (k - odd));
    to = b + 4 * (n - 1 - (k - odd));
    *at(to - 4) -= combine(down + SW_ROW4_NEXT, to);
    *at(to - 8) -= combine(down + SW_ROW4_SECOND, to);
  }
  solve_middle(factor + SW_ROW4_SIZE * middle, b + 4 * middle);
  for (size_t k = middle; k-- > 0;) {
    const double *up = factor + SW_ROW4_SIZE * k;
    double *to = b + 4 * k;
    *at(to) =
        combine(up, to) - apply(up + SW_ROW4_NEXT, *at(to + 4), up + SW_ROW4_SECOND, *at(to + 8));
    if (k < odd) continue;
    const double *down = factor + SW_ROW4_SIZE * (n - 1 - (k - odd));
    to = b + 4 * (n - 1 - (k - odd));
    *at(to) = combine(down, to) -
              apply(down + SW_ROW4_NEXT, *at(to - 4), down + SW_ROW4_SECOND, *at(to - 8));
  }
}
