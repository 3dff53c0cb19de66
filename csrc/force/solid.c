/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluation of a solid element in the reduced coordinates y: the three columns of F and the
 * amplitudes q, each a sum over the particles. The derivatives with respect to y are small and
 * dense; two products with the rows transfer them to the particles. Eight numbers, one per particle
 * or per y, form a vector. */
#include "force/solid.h"

#include <math.h>
#include <string.h>

#include "base/simd.h"
#include "base/vec.h"
#include "force/solid_inner.h"

#pragma GCC diagnostic ignored "-Wpsabi"
#define FLAT static inline __attribute__((always_inline))
typedef double lane __attribute__((vector_size(32), aligned(8)));
typedef struct row8 { /* in two halves: compilers spill vectors wider than registers */
  lane a, b;
} row8;

static const double CONTINUED = 0.1; /* J below which the energy is a polynomial [-] */

enum { PAIRS = 6 }; /* pairs of components: xx xy xz yy yz zz */
static const int first[PAIRS] = {0, 0, 0, 1, 1, 2}, second[PAIRS] = {0, 1, 2, 1, 2, 2};

FLAT lane load4(const double *p) { return *(const lane *)(const void *)p; }
FLAT row8 load8(const double *p) { return (row8){load4(p), load4(p + 4)}; }
FLAT row8 times8(double s, row8 v) { return (row8){s * v.a, s * v.b}; }
FLAT row8 madd8(row8 u, double s, row8 v) { return (row8){u.a + s * v.a, u.b + s * v.b}; }
FLAT void store8(double *p, row8 v) {
  *(lane *)(void *)p = v.a;
  *(lane *)(void *)(p + 4) = v.b;
}

/* Not inlined: in SW_HOT it would have other bits than for its other callers. */
#define APART __attribute__((noinline))
APART sw_solid_volumetric sw_solid_of_J(double mu, double lambda, double J) {
  const double at = fmax(J, CONTINUED), log_J = log(at), d = J - at;
  sw_solid_volumetric f = {(0.5 * lambda * log_J - mu) * log_J, (lambda * log_J - mu) / at,
                           (lambda * (1 - log_J) + mu) / (at * at)};
  f.value += d * (f.slope + 0.5 * f.curve * d);
  f.slope += d * f.curve;
  return f;
}

/* State of one element. */
typedef struct work {
  sw_vec F[3], A[3];                     /* columns of F; derivatives of J by these [-] */
  sw_vec q[SW_SOLID_MODES];              /* [m] */
  double e[SW_SOLID_STIFF];              /* [m] */
  double s[SW_SOLID_STIFF];              /* K e [N] */
  sw_vec pull[3];                        /* sum over the patterns of s_i q [N m] */
  sw_solid_volumetric f;                 /* times volume [J] */
  double h[PAIRS][SW_SOLID_ROWS][8];     /* second derivatives by y, for each pair of components */
  double by[SW_SOLID_STIFF][3][8];       /* derivatives of e by y */
  double stressed[SW_SOLID_STIFF][3][8]; /* K times by */
} work;

FLAT void reduce(const sw_solid *e, const double *x, int nodes, int modes, work *w) {
  sw_vec y[SW_SOLID_ROWS] = {{0, 0, 0}};
  const sw_vec origin = sw_load(x); /* rows sum to 0: a local origin keeps digits */
  for (int a = 1; a < nodes; a++) {
    const sw_vec p = sw_sub(sw_load(x + 3 * a), origin);
    for (int m = 0; m < 3 + modes; m++) y[m] = sw_madd(y[m], p, e->rows[m][a]);
  }
  for (int i = 0; i < 3; i++) w->F[i] = y[i];
  for (int m = 0; m < modes; m++) w->q[m] = y[3 + m];
  for (int i = 0; i < 3; i++) w->A[i] = sw_cross(w->F[(i + 1) % 3], w->F[(i + 2) % 3]);
}

/* Fills e and s; returns the energy of both parts. */
FLAT double energy_of(const sw_solid *e, int modes, work *w) {
  const double J = sw_dot(w->F[0], w->A[0]);
  double F2 = 0, bent = 0;
  for (int i = 0; i < 3; i++) F2 += sw_norm2(w->F[i]);
  w->f = sw_solid_of_J(e->mu, e->lambda, J);
  for (int m = 0; m < modes; m++)
    for (int i = 0; i < 3; i++) w->e[3 * m + i] = sw_dot(w->A[i], w->q[m]);
  for (int r = 0; r < 3 * modes; r++) {
    double sum = 0;
    for (int c = 0; c < 3 * modes; c++) sum += e->K[r][c] * w->e[c];
    w->s[r] = sum;
    bent += sum * w->e[r];
  }
  const double energy = e->volume * (0.5 * e->mu * (F2 - 3) + w->f.value) + 0.5 * bent;
  w->f.slope *= e->volume;
  w->f.curve *= e->volume;
  return energy;
}

FLAT void pull_of(int modes, work *w) {
  for (int i = 0; i < 3; i++) {
    w->pull[i] = sw_v(0, 0, 0);
    for (int m = 0; m < modes; m++) w->pull[i] = sw_madd(w->pull[i], w->q[m], w->s[3 * m + i]);
  }
}

/* e_i = det(F with column i replaced by q), so its derivative with respect to column j is eps_ijk
 * F_k x q. */
FLAT void gradient_of(const sw_solid *e, int nodes, int modes, const work *w, double *g) {
  sw_vec r[SW_SOLID_ROWS];
  for (int j = 0; j < 3; j++) {
    const int k = (j + 1) % 3, i = (j + 2) % 3; /* eps_ijk = 1 */
    r[j] = sw_madd(sw_scale(w->F[j], e->mu * e->volume), w->A[j], w->f.slope);
    r[j] = sw_add(r[j], sw_cross(w->F[k], w->pull[i]));
    r[j] = sw_sub(r[j], sw_cross(w->F[i], w->pull[k]));
  }
  for (int m = 0; m < modes; m++) {
    r[3 + m] = sw_v(0, 0, 0);
    for (int i = 0; i < 3; i++) r[3 + m] = sw_madd(r[3 + m], w->A[i], w->s[3 * m + i]);
  }
  for (int a = 0; a < nodes; a++) {
    sw_vec sum = sw_v(0, 0, 0);
    for (int m = 0; m < 3 + modes; m++) sum = sw_madd(sum, r[m], e->rows[m][a]);
    sw_store(g + 3 * a, sum);
  }
}

/* --- second derivative ------------------------------------------------------------ */

FLAT void set_by(double by[3][8], int m, sw_vec v) {
  by[0][m] = v.x;
  by[1][m] = v.y;
  by[2][m] = v.z;
}

/* Adds de'K de. */
FLAT void add_bending(const sw_solid *e, int modes, work *w) {
  memset(w->by, 0, sizeof w->by);
  for (int m = 0; m < modes; m++)
    for (int i = 0; i < 3; i++) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      double(*by)[8] = w->by[3 * m + i];
      set_by(by, j, sw_cross(w->F[k], w->q[m]));
      set_by(by, k, sw_cross(w->q[m], w->F[j]));
      set_by(by, 3 + m, w->A[i]);
    }
  for (int r = 0; r < 3 * modes; r++)
    for (int j = 0; j < 3; j++) {
      row8 sum = times8(e->K[r][0], load8(w->by[0][j]));
      for (int c = 1; c < 3 * modes; c++) sum = madd8(sum, e->K[r][c], load8(w->by[c][j]));
      store8(w->stressed[r][j], sum);
    }
  for (int p = 0; p < PAIRS; p++)
    for (int m = 0; m < modes; m++)
      for (int i = 0; i < 3; i++) {
        const int at[3] = {(i + 1) % 3, (i + 2) % 3, 3 + m};
        const row8 t = load8(w->stressed[3 * m + i][second[p]]);
        for (int k = 0; k < 3; k++) {
          double *h = w->h[p][at[k]];
          store8(h, madd8(load8(h), w->by[3 * m + i][first[p]][at[k]], t));
        }
      }
}

/* Adds -[v]x to block (m, n) and its transpose to block (n, m). */
FLAT void add_turning(work *w, int m, int n, sw_vec v) {
  w->h[1][m][n] += v.z, w->h[1][n][m] -= v.z;
  w->h[2][m][n] -= v.y, w->h[2][n][m] += v.y;
  w->h[4][m][n] += v.x, w->h[4][n][m] -= v.x;
}

/* Adds s'd2e and the same term of J: d2 det(F) by columns i and j is -eps_ijk [F_k]x. */
FLAT void add_geometric(int modes, int bending, work *w) {
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sw_vec v = sw_scale(w->F[k], w->f.slope);
    if (bending) v = sw_add(v, w->pull[k]);
    add_turning(w, i, j, v);
    for (int m = 0; bending && m < modes; m++)
      add_turning(w, i, 3 + m,
                  sw_sub(sw_scale(w->F[k], w->s[3 * m + j]), sw_scale(w->F[j], w->s[3 * m + k])));
  }
}

/* Adds the second derivative of 1/2 mu F.F + f(J) without its geometric part. */
FLAT void add_material(const sw_solid *e, work *w) {
  double a[3][3];
  for (int i = 0; i < 3; i++) sw_store(a[i], w->A[i]);
  for (int p = 0; p < PAIRS; p++)
    for (int m = 0; m < 3; m++) {
      for (int n = 0; n < 3; n++) w->h[p][m][n] += w->f.curve * a[m][first[p]] * a[n][second[p]];
      if (first[p] == second[p]) w->h[p][m][m] += e->mu * e->volume;
    }
}

static void make_semidefinite(const sw_solid *e, work *w) {
  double F[3][3], d[SW_SOLID_CONVEX][3][3], amount[SW_SOLID_CONVEX];
  for (int i = 0; i < 3; i++) sw_store(F[i], w->F[i]);
  const int n = sw_solid_convexify(F, e->mu * e->volume, w->f.slope, w->f.curve, d, amount);
  for (int t = 0; t < n; t++)
    for (int p = 0; p < PAIRS; p++)
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
          w->h[p][i][j] += amount[t] * d[t][i][first[p]] * d[t][j][second[p]];
}

FLAT void to_nodes(const sw_solid *e, int nodes, int modes, const work *w, double *H) {
  const int n = 3 * nodes, rows = 3 + modes;
  for (int p = 0; p < PAIRS; p++) {
    row8 t[SW_SOLID_ROWS];
    for (int m = 0; m < rows; m++) {
      t[m] = times8(w->h[p][m][0], load8(e->rows[0]));
      for (int k = 1; k < rows; k++) t[m] = madd8(t[m], w->h[p][m][k], load8(e->rows[k]));
    }
    for (int a = 0; a < nodes; a++) {
      row8 v = times8(e->rows[0][a], t[0]);
      for (int m = 1; m < rows; m++) v = madd8(v, e->rows[m][a], t[m]);
      double sum[8];
      store8(sum, v);
      double *right = H + (3 * a + first[p]) * n + second[p];
      double *below = H + second[p] * n + 3 * a + first[p];
      for (int b = 0; b < nodes; b++) right[3 * b] = sum[b];
      if (first[p] != second[p])
        for (int b = 0; b < nodes; b++) below[3 * b * n] = sum[b];
    }
  }
}

FLAT double evaluate(const sw_solid *e, const double *x, unsigned want, double *g, double *H,
                     int nodes, int modes) {
  work w;
  reduce(e, x, nodes, modes, &w);
  const double energy = energy_of(e, modes, &w);
  if (want & (SW_WANT_FORCE | SW_WANT_STIFFNESS)) pull_of(modes, &w);
  if (want & SW_WANT_FORCE) gradient_of(e, nodes, modes, &w, g);
  if (want & SW_WANT_STIFFNESS) {
    memset(w.h, 0, sizeof w.h);
    add_bending(e, modes, &w);
    add_material(e, &w);
    add_geometric(modes, !(want & SW_SOLID_SEMIDEFINITE), &w);
    if (want & SW_SOLID_SEMIDEFINITE) make_semidefinite(e, &w);
    to_nodes(e, nodes, modes, &w, H);
  }
  return energy;
}

SW_HOT static double prism(const sw_solid *e, const double *x, unsigned want, double *g,
                           double *H) {
  return evaluate(e, x, want, g, H, SW_SOLID_PRISM, SW_SOLID_PRISM - 4);
}

SW_HOT static double hexahedron(const sw_solid *e, const double *x, unsigned want, double *g,
                                double *H) {
  return evaluate(e, x, want, g, H, SW_SOLID_HEX, SW_SOLID_HEX - 4);
}

double sw_solid_eval(const sw_solid *e, const double *x, unsigned want, double *g, double *H) {
  return e->nodes == SW_SOLID_HEX ? hexahedron(e, x, want, g, H) : prism(e, x, want, g, H);
}
