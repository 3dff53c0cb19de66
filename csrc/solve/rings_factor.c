/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elimination in rings, and solving. Panels of 6 rows wait until all rows below them are done;
 * then a tile of 6 x 8 numbers takes up, in registers, all that these rows subtract, and is
 * divided by its panel's own part before it is stored: every number is written once. */
#include <math.h>
#include <string.h>

#include "base/simd.h"
#include "solve/rings.h"

#pragma GCC diagnostic ignored "-Wpsabi" /* vectors stay inside this file */
typedef double quad __attribute__((vector_size(32), aligned(8)));
enum { TILE = SW_RINGS_TILE, PANEL = SW_RINGS_PANEL, OWN = SW_RINGS_OWN };
#define ALWAYS static inline __attribute__((always_inline))

ALWAYS quad *at(double *p) { return (quad *)(void *)p; }
ALWAYS const quad *look(const double *p) { return (const quad *)(const void *)p; }

/* Rows of the ring at work, and of the one eliminated before it: the next one. */
typedef struct work {
  size_t n, padded, stride;
  const double *a;               /* (n x stride) the ring's values */
  double *factor, *own, *scaled; /* the ring's */
  const double *next_l, *next_d; /* the next ring's factor and D L; NULL: there is none */
  int first;                     /* no ring before this one */
  size_t negative, bad;
} work;

/* tile -= (rows of d)' (rows of l), over count rows; d: rows' columns of the panel. */
ALWAYS void subtract(quad tile[][2], const double *d, const double *l, size_t count, size_t stride,
                     const int rows) {
  for (size_t k = 0; k < count; k++, d += stride, l += stride) {
    const quad first = look(l)[0], second = look(l)[1];
#pragma GCC unroll 6
    for (int i = 0; i < rows; i++) {
      tile[i][0] -= d[i] * first;
      tile[i][1] -= d[i] * second;
    }
  }
}

/* A tile of the ring's own columns (column counts from the ring's first), or of those in the
 * ring before, with all that rows below the panel take from it. */
ALWAYS void gather(const work *w, quad tile[][2], size_t panel, size_t column, const int own,
                   const int rows) {
  const size_t s = w->stride, below = panel + (size_t)rows;
  const size_t place = column + (own ? w->padded : 0);
#pragma GCC unroll 6
  for (int i = 0; i < rows; i++) {
    const double *a = w->a + (panel + (size_t)i) * s + place;
    tile[i][0] = look(a)[0], tile[i][1] = look(a)[1];
  }
  if (own && w->next_l) subtract(tile, w->next_d + panel, w->next_l + column, w->n, s, rows);
  subtract(tile, w->scaled + below * s + w->padded + panel, w->factor + below * s + place,
           w->n - below, s, rows);
}

/* The panel's own part: L' D L of it. */
ALWAYS void split(work *w, size_t panel, const int rows) {
  quad tile[PANEL][2];
  double m[PANEL][TILE];
  gather(w, tile, panel, panel, 1, rows);
  for (int i = 0; i < rows; i++) *at(m[i]) = tile[i][0], *at(m[i] + 4) = tile[i][1];
  for (int k = rows - 1; k >= 0; k--) {
    const double pivot = m[k][k], r = 1.0 / pivot;
    double *kept = w->own + OWN * (panel + (size_t)k);
    w->negative += pivot < 0.0;
    w->bad += !(fabs(r) > 0.0 && fabs(r) < HUGE_VAL);
    for (int i = 0; i < k; i++) {
      const double l = m[k][i] * r;
      for (int j = 0; j <= i; j++) m[i][j] -= l * m[k][j];
      kept[i] = l;
    }
    kept[PANEL] = r;
  }
}

/* One tile of the panel's rows of L and D L. */
ALWAYS void finish(work *w, size_t panel, size_t column, const int own, const int rows) {
  const double *kept = w->own + OWN * panel;
  const size_t place = panel * w->stride + column + (own ? w->padded : 0);
  quad tile[PANEL][2];
  gather(w, tile, panel, column, own, rows);
#pragma GCC unroll 6
  for (int k = rows - 1; k >= 0; k--) {
    double *l = w->factor + place + (size_t)k * w->stride;
    double *d = w->scaled + place + (size_t)k * w->stride;
#pragma GCC unroll 6
    for (int i = 0; i < k; i++) {
      tile[i][0] -= kept[OWN * k + i] * tile[k][0];
      tile[i][1] -= kept[OWN * k + i] * tile[k][1];
    }
    at(d)[0] = tile[k][0], at(d)[1] = tile[k][1];
    at(l)[0] = tile[k][0] * kept[OWN * k + PANEL], at(l)[1] = tile[k][1] * kept[OWN * k + PANEL];
  }
}

ALWAYS void eliminate(work *w, size_t panel, const int rows) {
  split(w, panel, rows);
  for (size_t j = 0; j < panel; j += TILE) finish(w, panel, j, 1, rows);
  for (size_t j = 0; j < w->padded && !w->first; j += TILE) finish(w, panel, j, 0, rows);
  /* what the last tile held of the panel itself and beyond: solving runs over it */
  const size_t beyond = (TILE - panel % TILE) % TILE;
  for (size_t k = panel; k < panel + (size_t)rows; k++)
    memset(w->factor + k * w->stride + w->padded + panel, 0, beyond * sizeof *w->factor);
}

SW_HOT
static void eliminate_ring(work *w) {
  const size_t full = w->n / PANEL;
  if (w->n % PANEL) eliminate(w, full * PANEL, PANEL / 2);
  for (size_t k = full; k-- > 0;) eliminate(w, k * PANEL, PANEL);
}

static int any(const unsigned char *flags, size_t n) {
  int found = 0;
  for (size_t i = 0; i < n; i++) found |= flags[i];
  return found;
}

/* The ring's values without the rows and columns of fixed nodes. */
static const double *mask_ring(const sw_rings *r, const unsigned char *fixed, size_t ring) {
  const unsigned char *here = fixed + ring * r->per_ring;
  const double *values = r->values + ring * r->n * r->stride;
  const size_t before = ring > 0 ? r->per_ring : 0;
  if (!any(here - before, before + r->per_ring)) return values;
  memcpy(r->masked, values, r->n * r->stride * sizeof *values);
  for (size_t i = 0; i < r->n; i++) {
    double *row = r->masked + i * r->stride;
    if (here[i / 3]) memset(row, 0, r->stride * sizeof *row);
    for (size_t p = 0; p < r->per_ring; p++) {
      if (ring > 0 && (here - r->per_ring)[p]) memset(row + 3 * p, 0, 3 * sizeof *row);
      if (here[p]) memset(row + r->padded + 3 * p, 0, 3 * sizeof *row);
    }
    if (here[i / 3]) row[r->padded + i] = 1.0;
  }
  return r->masked;
}

sw_status sw_rings_factor(sw_rings *r, const unsigned char *fixed, size_t *negative) {
  const size_t one = r->n * r->stride;
  work w = {.n = r->n, .padded = r->padded, .stride = r->stride};
  for (size_t k = r->rings; k-- > 0;) {
    w.a = fixed ? mask_ring(r, fixed, k) : r->values + k * one;
    w.factor = r->factor + k * one;
    w.own = r->own + k * r->n * OWN;
    w.scaled = r->scaled + k % 2 * one;
    w.first = k == 0;
    eliminate_ring(&w);
    if (w.bad) break;
    w.next_l = w.factor, w.next_d = w.scaled;
  }
  if (negative) *negative = w.negative;
  return w.bad ? SW_ESINGULAR : SW_OK;
}

/* x -= rows' y, over count columns, a multiple of TILE. */
ALWAYS void scatter(const double *row, size_t stride, size_t count, const double *y, double *x,
                    const int rows) {
  for (size_t j = 0; j < count; j += TILE) {
    quad first = look(x + j)[0], second = look(x + j)[1];
#pragma GCC unroll 6
    for (int i = 0; i < rows; i++) {
      const quad *l = look(row + (size_t)i * stride + j);
      first -= y[i] * l[0], second -= y[i] * l[1];
    }
    at(x + j)[0] = first, at(x + j)[1] = second;
  }
}

/* sum -= rows x */
ALWAYS void collect(const double *row, size_t stride, size_t count, const double *x, quad sum[],
                    const int rows) {
  for (size_t j = 0; j < count; j += TILE) {
    const quad first = look(x + j)[0], second = look(x + j)[1];
#pragma GCC unroll 6
    for (int i = 0; i < rows; i++) {
      const quad *l = look(row + (size_t)i * stride + j);
      sum[i] -= first * l[0];
      sum[i] -= second * l[1];
    }
  }
}

static inline size_t up_to_tile(size_t n) { return (n + TILE - 1) / TILE * TILE; }

/* x = L'^-1 x as far as these rows go. */
ALWAYS void forward(const sw_rings *r, size_t ring, size_t panel, double *x, const int rows) {
  const double *row = r->factor + (ring * r->n + panel) * r->stride;
  const double *kept = r->own + OWN * (ring * r->n + panel);
  double y[PANEL];
  for (int i = 0; i < rows; i++) y[i] = x[panel + (size_t)i];
  for (int k = rows - 1; k > 0; k--)
    for (int i = 0; i < k; i++) y[i] -= kept[OWN * k + i] * y[k];
  scatter(row + r->padded, r->stride, up_to_tile(panel), y, x, rows);
  for (int i = 0; i < rows; i++) x[panel + (size_t)i] = y[i];
  if (ring > 0) scatter(row, r->stride, r->padded, y, x - r->padded, rows);
}

/* x = (D L)^-1 x, of these rows. */
ALWAYS void backward(const sw_rings *r, size_t ring, size_t panel, double *x, const int rows) {
  const double *row = r->factor + (ring * r->n + panel) * r->stride;
  const double *kept = r->own + OWN * (ring * r->n + panel);
  quad sum[PANEL] = {{0}};
  double *y = x + panel;
  if (ring > 0) collect(row, r->stride, r->padded, x - r->padded, sum, rows);
  collect(row + r->padded, r->stride, up_to_tile(panel), x, sum, rows);
  for (int k = 0; k < rows; k++) {
    double value = y[k] * kept[OWN * k + PANEL];
    value += (sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3]);
    for (int i = 0; i < k; i++) value -= kept[OWN * k + i] * y[i];
    y[k] = value;
  }
}

SW_HOT
static void solve(const sw_rings *r) {
  const size_t full = r->n / PANEL;
  for (size_t ring = r->rings; ring-- > 0;) {
    double *x = r->x + ring * r->padded;
    if (r->n % PANEL) forward(r, ring, full * PANEL, x, PANEL / 2);
    for (size_t k = full; k-- > 0;) forward(r, ring, k * PANEL, x, PANEL);
  }
  for (size_t ring = 0; ring < r->rings; ring++) {
    double *x = r->x + ring * r->padded;
    for (size_t k = 0; k < full; k++) backward(r, ring, k * PANEL, x, PANEL);
    if (r->n % PANEL) backward(r, ring, full * PANEL, x, PANEL / 2);
  }
}

void sw_rings_solve(const sw_rings *r, double *x) {
  sw_rings_pad(r, x, r->x);
  solve(r);
  sw_rings_unpad(r, r->x, x);
}
