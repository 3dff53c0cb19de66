/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of a solid element: its stress, and how far it may move. */
#include <math.h>

#include "base/vec.h"
#include "force/solid.h"
#include "force/solid_inner.h"

static const double LEFT = 0.2; /* share of J that a move must leave [-] */
enum { HALVINGS = 40 };         /* of the interval that contains the share [-] */

static void columns(const sw_solid *e, const double *x, sw_vec F[3]) {
  for (int i = 0; i < 3; i++) {
    F[i] = sw_v(0, 0, 0);
    for (int a = 1; a < e->nodes; a++)
      F[i] = sw_madd(F[i], sw_sub(sw_load(x + 3 * a), sw_load(x)), e->rows[i][a]);
  }
}

static double triple(sw_vec a, sw_vec b, sw_vec c) { return sw_dot(a, sw_cross(b, c)); }

static double cubic(const double c[4], double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

/* Finds the places, in order, where the cubic's slope changes sign. Returns their number. */
static int turns(const double c[4], double at[2]) {
  const double a = 3 * c[3], b = c[2], d = b * b - a * c[1]; /* a t^2 + 2 b t + c1 */
  if (!(d > 0)) return 0;
  const double root = -(b + copysign(sqrt(d), b));
  const double one = root / a, two = c[1] / root;
  at[0] = fmin(one, two); /* also right if one is infinite (a = 0) */
  at[1] = fmax(one, two);
  return 2;
}

double sw_solid_step(const sw_solid *e, const double *x, const double *dx) {
  sw_vec F[3], D[3];
  double at[4] = {0, 1, 1, 1};
  columns(e, x, F);
  columns(e, dx, D);
  const double J = triple(F[0], F[1], F[2]);
  if (!(J > 0)) return 1;
  const double c[4] = {
      J - LEFT * fmin(J, 1),
      triple(D[0], F[1], F[2]) + triple(F[0], D[1], F[2]) + triple(F[0], F[1], D[2]),
      triple(F[0], D[1], D[2]) + triple(D[0], F[1], D[2]) + triple(D[0], D[1], F[2]),
      triple(D[0], D[1], D[2])};
  const int n = turns(c, at + 1);
  at[1 + n] = 1;
  double low = 0;
  for (int k = 1; k <= 1 + n; k++) {
    if (!(at[k] > low) || at[k] > 1) continue;
    if (!(cubic(c, at[k]) > 0)) {
      double high = at[k]; /* the cubic is monotone here */
      for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        if (cubic(c, middle) > 0)
          low = middle;
        else
          high = middle;
      }
      return fmax(low, ldexp(1, -HALVINGS));
    }
    low = at[k];
  }
  return 1;
}

void sw_solid_stress(const sw_solid *e, const double *x, double stress[6], double *mises,
                     double *J) {
  sw_vec F[3];
  double f[3][3], s[6];
  columns(e, x, F);
  const double det = triple(F[0], F[1], F[2]);
  const double slope = sw_solid_of_J(e->mu, e->lambda, det).slope;
  for (int i = 0; i < 3; i++) sw_store(f[i], F[i]);
  for (int i = 0, p = 0; i < 3; i++)
    for (int j = i; j < 3; j++, p++) {
      s[p] = i == j ? slope : 0;
      for (int k = 0; k < 3; k++) s[p] += e->mu / det * f[k][i] * f[k][j];
    }
  const double a = s[0] - s[3], b = s[3] - s[5], d = s[5] - s[0];
  const double shear = s[1] * s[1] + s[2] * s[2] + s[4] * s[4];
  for (int p = 0; stress && p < 6; p++) stress[p] = s[p];
  if (mises) *mises = sqrt(0.5 * (a * a + b * b + d * d) + 3 * shear);
  if (J) *J = det;
}
