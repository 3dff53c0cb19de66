/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenvalues of the second derivative of mu/2 F.F + f(J), from the singular values of F = U S V'.
 * With dF = U M V', d2J = 2 sum over pairs of s_k (M_ii M_jj - M_ij M_ji), k being the third index.
 * Turn and shear of a pair are therefore eigenvectors with mu + f' s_k and mu - f' s_k; the three
 * stretches are coupled. (Smith, de Goes, Kim 2019.) */
#include <math.h>

#include "base/vec.h"
#include "force/solid_inner.h"

enum { SWEEPS = 12 }; /* most sweeps of Jacobi rotations; 3 to 5 are usual [-] */

/* Finds the eigenvectors of the symmetric matrix a (columns of v); a becomes diagonal. */
static void jacobi(double a[3][3], double v[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) v[i][j] = i == j;
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    const double off = fabs(a[0][1]) + fabs(a[0][2]) + fabs(a[1][2]);
    if (!(off > 1e-15 * (fabs(a[0][0]) + fabs(a[1][1]) + fabs(a[2][2])))) return;
    for (int p = 0; p < 2; p++)
      for (int q = p + 1; q < 3; q++) {
        if (a[p][q] == 0) continue;
        const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
        const double t = copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
        const double c = 1 / sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; k++) {
          const double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 3; k++) {
          const double x = a[p][k], y = a[q][k], u = v[k][p], w = v[k][q];
          a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
          v[k][p] = c * u - s * w, v[k][q] = s * u + c * w;
        }
      }
  }
}

/* F = U S V' with proper rotations U and V: the last singular value has the sign of J. */
static void singular(const double F[3][3], sw_vec u[3], sw_vec v[3], double sigma[3]) {
  double C[3][3], V[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) C[i][j] = sw_dot(sw_load(F[i]), sw_load(F[j]));
  jacobi(C, V);
  int large = 0, small = 0;
  for (int i = 1; i < 3; i++) {
    if (C[i][i] > C[large][large]) large = i;
    if (C[i][i] <= C[small][small]) small = i;
  }
  if (small == large) small = (large + 2) % 3;
  const int order[2] = {large, 3 - large - small};
  for (int t = 0; t < 2; t++) v[t] = sw_v(V[0][order[t]], V[1][order[t]], V[2][order[t]]);
  v[2] = sw_cross(v[0], v[1]);
  sw_vec Fv[3];
  for (int t = 0; t < 3; t++) {
    Fv[t] = sw_scale(sw_load(F[0]), v[t].x);
    Fv[t] = sw_madd(Fv[t], sw_load(F[1]), v[t].y);
    Fv[t] = sw_madd(Fv[t], sw_load(F[2]), v[t].z);
  }
  u[0] = sw_unit_or(Fv[0], sw_v(1, 0, 0));
  u[1] = sw_unit_or(sw_madd(Fv[1], u[0], -sw_dot(Fv[1], u[0])), sw_perpendicular(u[0]));
  u[2] = sw_cross(u[0], u[1]);
  for (int t = 0; t < 3; t++) sigma[t] = sw_dot(u[t], Fv[t]);
}

/* out += m u v', stored by columns */
static void outer(double out[3][3], double m, sw_vec u, sw_vec v) {
  const double along[3] = {v.x, v.y, v.z};
  for (int i = 0; i < 3; i++) {
    out[i][0] += m * along[i] * u.x;
    out[i][1] += m * along[i] * u.y;
    out[i][2] += m * along[i] * u.z;
  }
}

static void clear(double m[3][3]) {
  for (int i = 0; i < 9; i++) m[i / 3][i % 3] = 0;
}

int sw_solid_convexify(const double F[3][3], double mu, double slope, double curve,
                       double direction[SW_SOLID_CONVEX][3][3], double amount[SW_SOLID_CONVEX]) {
  sw_vec u[3], v[3];
  double s[3], stretch[3][3], mix[3][3];
  int n = 0;
  singular(F, u, v, s);
  for (int k = 0; k < 3; k++)
    for (int sign = -1; sign <= 1; sign += 2) { /* shear, turn */
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double value = mu + sign * slope * s[k];
      if (!(value < 0)) continue;
      clear(direction[n]);
      outer(direction[n], sqrt(0.5), u[i], v[j]);
      outer(direction[n], -sign * sqrt(0.5), u[j], v[i]);
      amount[n++] = -value;
    }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const double ci = s[(i + 1) % 3] * s[(i + 2) % 3], cj = s[(j + 1) % 3] * s[(j + 2) % 3];
      stretch[i][j] = curve * ci * cj + (i == j ? mu : slope * s[3 - i - j]);
    }
  jacobi(stretch, mix);
  for (int t = 0; t < 3; t++) {
    if (!(stretch[t][t] < 0)) continue;
    clear(direction[n]);
    for (int i = 0; i < 3; i++) outer(direction[n], mix[i][t], u[i], v[i]);
    amount[n++] = -stretch[t][t];
  }
  return n;
}
