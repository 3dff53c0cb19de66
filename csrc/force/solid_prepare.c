/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solid element at rest: mean gradients, patterns of displacement with zero mean gradient, and
 * the patterns' stiffness, from which enhanced strains are condensed (Simo and Rifai 1990). The
 * enhanced strains have mean 0 over the element, so homogeneous strains do no work on them. */
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "force/solid.h"

enum { POINTS = 8, ENHANCED = 12, STRAINS = 6, MODES = SW_SOLID_MODES, NODES = SW_SOLID_NODES };
static const double FLATTEST = 1e-9; /* volume over the cube of the size [-] */

/* An integration point of an element in its own coordinates (r, s, t), t along the wire. */
typedef struct point {
  double at[3], weight; /* [-] */
  sw_vec slope[NODES];  /* of the shape functions by r, s, t; then by x, y, z [1/m] */
  double volume;        /* weight times Jacobian [m3] */
} point;

typedef struct shape {
  int nodes, modes, points, enhanced; /* [-] */
  point p[POINTS];
  sw_vec middle[NODES];           /* slopes by r, s, t at the middle [-] */
  double pattern[MODES][NODES];   /* at the particles [-] */
  double displaced[MODES][NODES]; /* displacements with zero mean gradient [-] */
} shape;

/* Slopes by r, s, t of the prism's shape functions: (1 -+ t)/2 times (1 - r - s, r, s). */
static void prism_slopes(const double at[3], sw_vec *slope) {
  const double area[3] = {1 - at[0] - at[1], at[0], at[1]};
  const double dr[3] = {-1, 1, 0}, ds[3] = {-1, 0, 1};
  for (int a = 0; a < 6; a++) {
    const double end = a < 3 ? -1 : 1, along = 0.5 * (1 + end * at[2]);
    slope[a] = sw_v(along * dr[a % 3], along * ds[a % 3], 0.5 * end * area[a % 3]);
  }
}

static const double corner_r[4] = {-1, 1, 1, -1}, corner_s[4] = {-1, -1, 1, 1};

static void hex_slopes(const double at[3], sw_vec *slope) {
  for (int a = 0; a < 8; a++) {
    const double r = corner_r[a % 4], s = corner_s[a % 4], t = a < 4 ? -1 : 1;
    const double R = 1 + r * at[0], S = 1 + s * at[1], T = 1 + t * at[2];
    slope[a] = sw_v(0.125 * r * S * T, 0.125 * s * R * T, 0.125 * t * R * S);
  }
}

/* Three points in the triangle times two along: exact for the prism's volume and linear strains.
 * The patterns are linear across the triangle and odd along the wire. */
static void make_prism(shape *s) {
  static const double a[3] = {1.0 / 6, 2.0 / 3, 1.0 / 6}, b[3] = {1.0 / 6, 1.0 / 6, 2.0 / 3};
  static const double across[2][3] = {{-1, 1, 0}, {-1, -1, 2}};
  const double middle[3] = {1.0 / 3, 1.0 / 3, 0};
  *s = (shape){.nodes = 6, .modes = 2, .points = 6, .enhanced = 9};
  for (int k = 0; k < 6; k++) {
    s->p[k] = (point){{a[k % 3], b[k % 3], (k < 3 ? -1 : 1) / sqrt(3)}, 1.0 / 6, {{0, 0, 0}}, 0};
    prism_slopes(s->p[k].at, s->p[k].slope);
  }
  prism_slopes(middle, s->middle);
  for (int m = 0; m < 2; m++)
    for (int n = 0; n < 6; n++) s->pattern[m][n] = (n < 3 ? -1 : 1) * across[m][n % 3];
}

static void make_hex(shape *s) {
  const double middle[3] = {0, 0, 0};
  *s = (shape){.nodes = 8, .modes = 4, .points = 8, .enhanced = 12};
  for (int k = 0; k < 8; k++) {
    const double r = corner_r[k % 4], c = corner_s[k % 4], t = k < 4 ? -1 : 1;
    const double pattern[MODES] = {c * t, t * r, r * c, r * c * t};
    s->p[k] = (point){{r / sqrt(3), c / sqrt(3), t / sqrt(3)}, 1, {{0, 0, 0}}, 0};
    hex_slopes(s->p[k].at, s->p[k].slope);
    for (int m = 0; m < MODES; m++) s->pattern[m][k] = pattern[m];
  }
  hex_slopes(middle, s->middle);
}

/* Computes the gradients G of the coordinates r, s, t in space; returns the Jacobian. */
static double coordinates(const double *rest, const sw_vec *slope, int nodes, sw_vec G[3]) {
  sw_vec t[3] = {{0, 0, 0}};
  for (int a = 0; a < nodes; a++) {
    const sw_vec p = sw_sub(sw_load(rest + 3 * a), sw_load(rest));
    t[0] = sw_madd(t[0], p, slope[a].x);
    t[1] = sw_madd(t[1], p, slope[a].y);
    t[2] = sw_madd(t[2], p, slope[a].z);
  }
  const double jacobian = sw_dot(t[0], sw_cross(t[1], t[2]));
  for (int k = 0; k < 3; k++)
    G[k] = sw_scale(sw_cross(t[(k + 1) % 3], t[(k + 2) % 3]), 1 / jacobian);
  return jacobian;
}

/* Computes slopes in space, volumes of the points and mean gradients. */
static sw_status integrate(shape *s, const double *rest, sw_solid *e) {
  double size = 0;
  for (int a = 1; a < s->nodes; a++)
    size = fmax(size, sw_dist(sw_load(rest + 3 * a), sw_load(rest)));
  e->volume = 0;
  for (int k = 0; k < s->points; k++) {
    point *p = s->p + k;
    sw_vec G[3];
    const double jacobian = coordinates(rest, p->slope, s->nodes, G);
    if (!(jacobian > FLATTEST * size * size * size) || !isfinite(jacobian)) return SW_EINVAL;
    p->volume = p->weight * jacobian;
    e->volume += p->volume;
    for (int a = 0; a < s->nodes; a++) {
      const sw_vec d = p->slope[a];
      p->slope[a] = sw_madd(sw_madd(sw_scale(G[0], d.x), G[1], d.y), G[2], d.z);
      e->rows[0][a] += p->volume * p->slope[a].x;
      e->rows[1][a] += p->volume * p->slope[a].y;
      e->rows[2][a] += p->volume * p->slope[a].z;
    }
  }
  for (int i = 0; i < 3; i++)
    for (int a = 0; a < s->nodes; a++) e->rows[i][a] /= e->volume;
  return SW_OK;
}

static double sum_of(const double *a, const double *b, int n) {
  double sum = 0;
  for (int k = 0; k < n; k++) sum += a[k] * b[k];
  return sum;
}

/* Solves a x = b for m right-hand sides by elimination with pivoting; x replaces b (n rows of m).
 * 0: a is singular. */
static int solve(double *a, int n, double *b, int m) {
  for (int k = 0; k < n; k++) {
    int pivot = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) pivot = i;
    if (!(fabs(a[pivot * n + k]) > 0)) return 0;
    for (int j = 0; j < n && pivot != k; j++) {
      const double swap = a[k * n + j];
      a[k * n + j] = a[pivot * n + j], a[pivot * n + j] = swap;
    }
    for (int j = 0; j < m && pivot != k; j++) {
      const double swap = b[k * m + j];
      b[k * m + j] = b[pivot * m + j], b[pivot * m + j] = swap;
    }
    for (int i = 0; i < n; i++) {
      if (i == k) continue;
      const double factor = a[i * n + k] / a[k * n + k];
      for (int j = k; j < n; j++) a[i * n + j] -= factor * a[k * n + j];
      for (int j = 0; j < m; j++) b[i * m + j] -= factor * b[k * m + j];
    }
  }
  for (int k = 0; k < n; k++)
    for (int j = 0; j < m; j++) b[k * m + j] /= a[k * n + k];
  return 1;
}

/* Makes displacements without mean gradient, and rows that measure their amplitudes and ignore
 * homogeneous strain: c = pattern - sum_i (pattern.x_i) mean_i ignores linear displacements, p =
 * pattern - sum_i (mean_i.pattern) x_i has no mean gradient, and the rows are the c mixed so that
 * rows.p = 1. 0: singular. */
static int make_patterns(shape *s, const double *rest, sw_solid *e) {
  const int n = s->nodes, m = s->modes;
  double x[3][NODES], c[MODES * NODES], mixed[MODES * MODES];
  for (int i = 0; i < 3; i++)
    for (int a = 0; a < n; a++) x[i][a] = rest[3 * a + i] - rest[i];
  for (int p = 0; p < m; p++)
    for (int a = 0; a < n; a++) {
      c[p * n + a] = s->displaced[p][a] = s->pattern[p][a];
      for (int i = 0; i < 3; i++) {
        c[p * n + a] -= sum_of(s->pattern[p], x[i], n) * e->rows[i][a];
        s->displaced[p][a] -= sum_of(e->rows[i], s->pattern[p], n) * x[i][a];
      }
    }
  for (int p = 0; p < m; p++)
    for (int k = 0; k < m; k++) mixed[k * m + p] = sum_of(c + p * n, s->displaced[k], n);
  if (!solve(mixed, m, c, n)) return 0;
  for (int p = 0; p < m; p++)
    for (int a = 0; a < n; a++) e->rows[3 + p][a] = c[p * n + a];
  return 1;
}

/* --- stiffness of the patterns ------------------------------------------------------- */

/* Strain xx yy zz xy yz zx of the displacement gradient a b' times factor. */
static void strain(double out[STRAINS], sw_vec a, sw_vec b, double factor) {
  out[0] = factor * a.x * b.x;
  out[1] = factor * a.y * b.y;
  out[2] = factor * a.z * b.z;
  out[3] = factor * (a.x * b.y + a.y * b.x);
  out[4] = factor * (a.y * b.z + a.z * b.y);
  out[5] = factor * (a.z * b.x + a.x * b.z);
}

static const sw_vec unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* Enhanced strains at a point. G: gradients of the coordinates at the element's middle; ratio: the
 * Jacobian there over that at the point, which gives strains across the section zero mean. Strains
 * along the wire are not scaled by it: a bent prism's shear is uniform over its section, whatever
 * the section's shape. */
static void enhance(const shape *s, const point *p, const sw_vec G[3], double ratio,
                    double out[ENHANCED][STRAINS]) {
  const double r = p->at[0], c = p->at[1], t = p->at[2];
  if (s->nodes == SW_SOLID_PRISM) {
    const double linear[2] = {r - 1.0 / 3, c - 1.0 / 3};
    for (int k = 0; k < 2; k++)
      for (int j = 0; j < 3; j++)
        strain(out[3 * k + j], G[j / 2], G[(j + 1) / 2], ratio * linear[k]);
    for (int i = 0; i < 3; i++) strain(out[6 + i], unit[i], G[2], t);
    return;
  }
  const double product[3] = {c * t, t * r, r * c};
  for (int k = 0; k < 3; k++) {
    for (int i = 0; i < 3; i++)
      strain(out[3 * k + i], unit[i], G[k], (k == 2 ? 1 : ratio) * p->at[k]);
    for (int j = 0; j < STRAINS; j++) out[9 + k][j] = j < 3 ? ratio * product[k] : 0;
  }
}

/* Returns a'D b of two strains [Pa]. */
static double work_of(const double a[STRAINS], const double b[STRAINS], double mu, double lambda) {
  const double volume = lambda * (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2]);
  const double normal = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return volume + mu * (2 * normal + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

enum { ALL = SW_SOLID_STIFF + ENHANCED };

/* Computes the strains of patterns and the enhanced strains at each point; the mean of the enhanced
 * strains is subtracted. 0: inverted at the middle. */
static int strains(const shape *s, const double *rest, const sw_solid *e,
                   double B[POINTS][ALL][STRAINS]) {
  const int own = 3 * s->modes, n = own + s->enhanced;
  sw_vec G[3];
  const double middle = coordinates(rest, s->middle, s->nodes, G);
  if (!(middle > 0)) return 0;
  for (int k = 0; k < s->points; k++) {
    const point *p = s->p + k;
    for (int m = 0; m < s->modes; m++) {
      sw_vec slope = sw_v(0, 0, 0);
      for (int a = 0; a < s->nodes; a++) slope = sw_madd(slope, p->slope[a], s->displaced[m][a]);
      for (int i = 0; i < 3; i++) strain(B[k][3 * m + i], unit[i], slope, 1);
    }
    enhance(s, p, G, middle * p->weight / p->volume, B[k] + own);
  }
  for (int i = own; i < n; i++)
    for (int j = 0; j < STRAINS; j++) {
      double mean = 0;
      for (int k = 0; k < s->points; k++) mean += s->p[k].volume / e->volume * B[k][i][j];
      for (int k = 0; k < s->points; k++) B[k][i][j] -= mean;
    }
  return 1;
}

static int stiffness(const shape *s, const double *rest, sw_solid *e) {
  const int own = 3 * s->modes, extra = s->enhanced, n = own + extra;
  double whole[ALL * ALL] = {0}, inner[ENHANCED * ENHANCED], mixed[ENHANCED * SW_SOLID_STIFF];
  double B[POINTS][ALL][STRAINS];
  if (!strains(s, rest, e, B)) return 0;
  for (int k = 0; k < s->points; k++)
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++)
        whole[i * n + j] += s->p[k].volume * work_of(B[k][i], B[k][j], e->mu, e->lambda);
  for (int i = 0; i < extra; i++) {
    for (int j = 0; j < extra; j++) inner[i * extra + j] = whole[(own + i) * n + own + j];
    for (int j = 0; j < own; j++) mixed[i * own + j] = whole[(own + i) * n + j];
  }
  if (!solve(inner, extra, mixed, own)) return 0;
  for (int i = 0; i < own; i++)
    for (int j = 0; j < own; j++) {
      e->K[i][j] = whole[i * n + j];
      for (int k = 0; k < extra; k++) e->K[i][j] -= whole[i * n + own + k] * mixed[k * own + j];
    }
  for (int i = 0; i < own; i++) /* symmetric to the last digit */
    for (int j = 0; j < i; j++) e->K[i][j] = e->K[j][i] = 0.5 * (e->K[i][j] + e->K[j][i]);
  return 1;
}

sw_status sw_solid_prepare(int nodes, const double *rest, double mu, double lambda, sw_solid *e) {
  shape s;
  memset(e, 0, sizeof *e);
  if (nodes != SW_SOLID_PRISM && nodes != SW_SOLID_HEX) return SW_EINVAL;
  if (!(mu > 0) || !(3 * lambda + 2 * mu > 0) || !isfinite(mu + lambda)) return SW_EINVAL;
  e->nodes = nodes;
  e->mu = mu;
  e->lambda = lambda;
  if (nodes == SW_SOLID_PRISM)
    make_prism(&s);
  else
    make_hex(&s);
  SW_TRY(integrate(&s, rest, e));
  return make_patterns(&s, rest, e) && stiffness(&s, rest, e) ? SW_OK : SW_EINVAL;
}
