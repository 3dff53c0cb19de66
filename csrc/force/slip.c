/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A spring k between the angle vector beta = s(c) t1 x t2 of a hinge (s = phi/sin phi, c = t1.t2)
 * and the slipped vector p, with kinematic hardening H: |k (beta - p) - H p| <= limit. Backward
 * Euler from the remembered p_o is the minimum over p of
 *   1/2 k |beta - p|^2 + 1/2 H |p|^2 + limit |p - p_o|
 * (radial return; Simo and Hughes 1998). With K = k + H, D = beta.p_o and xi = k beta - K p_o it
 * has the closed form
 *   W = 1/2 k phi^2 - k D + 1/2 K |p_o|^2 - max(0, |xi| - limit)^2 / (2 K).
 * Moment and tangent are W's first and second derivatives, so the tangent is consistent and
 * symmetric. p_o is carried from the old tangent b_o to b = (t1 + t2)/|t1 + t2| by the smallest
 * rotation (time-parallel transport), p_o - (b.p_o)/(1 + b.b_o) (b + b_o); this transport is
 * differentiated too. W depends on t1, t2 through five scalars that are linear or bilinear,
 *   c, N = t1 x t2 . p_o, G = t1 x t2 . b_o, A = (t1 + t2).p_o, B = (t1 + t2).b_o,
 * and D = s(c) (N - A G / (|t1 + t2| + B)). */
#include "force/slip.h"

#include <math.h>
#include <string.h>

enum { C, N, G, A, B, SCALARS };

/* s = phi/sin phi as a series in u = sin^2(phi/2): 4^k (k!)^2 / (2k+1)!. */
static const double SERIES[] = {1.0,
                                2.0 / 3,
                                8.0 / 15,
                                16.0 / 35,
                                128.0 / 315,
                                256.0 / 693,
                                1024.0 / 3003,
                                2048.0 / 6435,
                                32768.0 / 109395,
                                65536.0 / 230945,
                                262144.0 / 969969,
                                524288.0 / 2028117,
                                4194304.0 / 16900975};
enum { TERMS = sizeof SERIES / sizeof SERIES[0] };
static const double SERIES_LIMIT = 0.04; /* range of u; error below 1e-16 [-] */
static const double SHARPEST = 0.999;    /* largest u, as for bending [-] */

/* An accepted hinge that slipped lies on the limit within rounding. From there it may slip on or
 * unload; solves start on the elastic side. */
static const double ON_LIMIT = 1e-10; /* over the limit [-] */

static double excess(const sw_slip_law *law, double xi) {
  const double over = xi - law->limit;
  return over > ON_LIMIT * law->limit ? over : 0.0;
}

/* s and its first and second derivative with respect to c = 1 - 2 u. */
static void angle_factors(double u, double s[3]) {
  if (u < SERIES_LIMIT) {
    double value = 0, slope = 0, half_bend = 0;
    for (int k = TERMS - 1; k >= 0; k--) {
      half_bend = half_bend * u + slope;
      slope = slope * u + value;
      value = value * u + SERIES[k];
    }
    s[0] = value, s[1] = -0.5 * slope, s[2] = 0.5 * half_bend;
    return;
  }
  const double v = u < SHARPEST ? u : SHARPEST;
  const double c = 1.0 - 2.0 * v, sine2 = 4.0 * v * (1.0 - v);
  s[0] = acos(c) / sqrt(sine2);
  s[1] = -(1.0 - s[0] * c) / sine2;
  s[2] = (s[0] + 3.0 * c * s[1]) / sine2;
}

sw_vec sw_slip_carry(sw_vec v, sw_vec a, sw_vec b) {
  if (!(sw_norm2(a) > 0)) return v;
  const double share = sw_dot(b, v) / fmax(1.0 + sw_dot(a, b), 1e-12);
  return sw_madd(v, sw_add(a, b), -share);
}

static double half_angle2(const sw_slip_hinge *h) {
  return 0.25 * sw_norm2(sw_sub(h->t[1], h->t[0]));
}

/* D with its first and second derivatives as functions of the scalars. */
typedef struct product {
  double value, d1[SCALARS], d2[SCALARS][SCALARS];
} product;

static void differentiate(const double s[3], double c, const double z[SCALARS], product *out) {
  const double m = sqrt(fmax(2.0 + 2.0 * c, 1e-12)), m1 = 1.0 / m, m2 = -1.0 / (m * m * m);
  const double r = 1.0 / (m + z[B]), a = z[A], g = z[G];
  const double n = z[N] - a * g * r;
  const double d[SCALARS] = {a * g * r * r * m1, 1.0, -a * r, -g * r, a * g * r * r};
  double h[SCALARS][SCALARS] = {{0}};
  h[C][C] = a * g * r * r * (m2 - 2.0 * r * m1 * m1);
  h[C][G] = a * r * r * m1;
  h[C][A] = g * r * r * m1;
  h[C][B] = -2.0 * a * g * r * r * r * m1;
  h[G][A] = -r;
  h[G][B] = a * r * r;
  h[A][B] = g * r * r;
  h[B][B] = -2.0 * a * g * r * r * r;
  out->value = s[0] * n;
  for (int i = 0; i < SCALARS; i++) {
    out->d1[i] = s[0] * d[i] + (i == C ? s[1] * n : 0.0);
    for (int j = i; j < SCALARS; j++) {
      double x = s[0] * h[i][j];
      if (i == C) x += s[1] * d[j];
      if (j == C) x += s[1] * d[i] + s[2] * n;
      out->d2[i][j] = out->d2[j][i] = x;
    }
  }
}

/* First and second derivatives of W with respect to the scalars. share below 1: slipping reduces
 * the stiffness by this share only. */
static void potential(const sw_slip_law *law, const double s[3], double xi, double share,
                      const product *p, double w1[SCALARS], double w2[SCALARS][SCALARS]) {
  const double K = law->k + law->harden, over = share * excess(law, xi);
  const double rho = over > 0 ? over / (K * xi) : 0.0;
  const double sigma = over > 0 ? share * law->limit / (K * xi * xi * xi) : 0.0;
  const double wq = law->own - rho * law->k * law->k, wd = -law->k * (1.0 - rho * K);
  double turn[SCALARS]; /* half the derivative of xi^2, over k */
  for (int i = 0; i < SCALARS; i++) {
    const double q = i == C ? -s[0] : 0.0; /* of phi^2 / 2 */
    w1[i] = wq * q + wd * p->d1[i];
    turn[i] = law->k * q - K * p->d1[i];
  }
  for (int i = 0; i < SCALARS; i++)
    for (int j = 0; j < SCALARS; j++)
      w2[i][j] = wd * p->d2[i][j] - sigma * law->k * law->k * turn[i] * turn[j];
  w2[C][C] -= wq * s[1];
}

/* Computes the scalars' gradients with respect to t[side]. */
static void scalar_gradients(const sw_slip_hinge *h, sw_vec p, sw_vec b, int side,
                             sw_vec out[SCALARS]) {
  const sw_vec other = h->t[1 - side];
  const double sign = side == 0 ? 1.0 : -1.0;
  out[C] = other;
  out[N] = sw_scale(sw_cross(other, p), sign);
  out[G] = sw_scale(sw_cross(other, b), sign);
  out[A] = p;
  out[B] = b;
}

static sw_vec across(sw_vec v, sw_vec t) { return sw_madd(v, t, -sw_dot(v, t)); }

static void add_upper(const double full[9], double out[6]) {
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++) out[at] += full[3 * i + j];
}

/* Adds one edge's stiffness. g: the scalars' gradients with respect to the edge vectors; total: W's
 * gradient with respect to t[side]. */
static void edge_stiffness(const sw_slip_hinge *h, int side, sw_vec g[2][SCALARS], sw_vec total,
                           double w2[SCALARS][SCALARS], sw_slip_answer *out) {
  const sw_vec t = h->t[side];
  const double r = h->r[side], along = sw_dot(t, total) * r * r;
  const sw_vec bent = sw_scale(across(total, t), r * r);
  double own[9] = {0};
  for (int i = 0; i < SCALARS; i++) {
    sw_vec row = sw_v(0, 0, 0), cross = sw_v(0, 0, 0);
    for (int j = 0; j < SCALARS; j++) {
      row = sw_madd(row, g[side][j], w2[i][j]);
      cross = sw_madd(cross, g[1][j], w2[i][j]);
    }
    sw_add_outer(own, g[side][i], row, 1.0);
    if (side == 0) sw_add_outer(out->next, g[0][i], cross, 1.0);
  }
  sw_add_outer(own, t, bent, -1.0);
  sw_add_outer(own, bent, t, -1.0);
  sw_add_outer(own, t, t, along);
  own[0] -= along, own[4] -= along, own[8] -= along;
  add_upper(own, out->own[side]);
}

/* Adds the second derivative of the bilinear scalars between the edges: w1 I - q x. */
static void mixed_stiffness(const sw_slip_hinge *h, double w, sw_vec q, sw_slip_answer *out) {
  const sw_vec unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double rr = h->r[0] * h->r[1];
  for (int j = 0; j < 3; j++) {
    const sw_vec column = across(unit[j], h->t[1]);
    const sw_vec image = sw_sub(sw_scale(column, w), sw_cross(q, column));
    const sw_vec v = sw_scale(across(image, h->t[0]), rr);
    out->next[j] += v.x, out->next[3 + j] += v.y, out->next[6 + j] += v.z;
  }
}

static void stiffness(const sw_slip_hinge *h, const sw_slip_memory *m, const double w1[SCALARS],
                      double w2[SCALARS][SCALARS], sw_slip_answer *out) {
  sw_vec g[2][SCALARS], total[2];
  for (int side = 0; side < 2; side++) {
    scalar_gradients(h, m->slipped, m->along, side, g[side]);
    total[side] = sw_v(0, 0, 0);
    for (int i = 0; i < SCALARS; i++) {
      total[side] = sw_madd(total[side], g[side][i], w1[i]);
      g[side][i] = sw_scale(across(g[side][i], h->t[side]), h->r[side]);
    }
  }
  for (int side = 0; side < 2; side++) edge_stiffness(h, side, g, total[side], w2, out);
  const sw_vec q = sw_madd(sw_scale(m->slipped, w1[N]), m->along, w1[G]);
  mixed_stiffness(h, w1[C], q, out);
}

static void gradients(const sw_slip_hinge *h, const sw_slip_memory *m, const double w1[SCALARS],
                      sw_slip_answer *out) {
  for (int side = 0; side < 2; side++) {
    sw_vec g[SCALARS], total = sw_v(0, 0, 0);
    scalar_gradients(h, m->slipped, m->along, side, g);
    for (int i = 0; i < SCALARS; i++) total = sw_madd(total, g[i], w1[i]);
    out->gradient[side] = sw_scale(across(total, h->t[side]), h->r[side]);
  }
}

void sw_slip_eval(const sw_slip_law *law, const sw_slip_memory *memory, const sw_slip_hinge *hinge,
                  unsigned want, double share, sw_slip_answer *out) {
  const double u = half_angle2(hinge), K = law->k + law->harden;
  const sw_vec normal = sw_cross(hinge->t[0], hinge->t[1]), sum = sw_add(hinge->t[0], hinge->t[1]);
  const sw_vec p = memory->slipped, b = memory->along;
  const double z[SCALARS] = {[C] = 1.0 - 2.0 * u,
                             [N] = sw_dot(normal, p),
                             [G] = sw_dot(normal, b),
                             [A] = sw_dot(sum, p),
                             [B] = sw_dot(sum, b)};
  double s[3], w1[SCALARS], w2[SCALARS][SCALARS];
  product d;
  memset(out, 0, sizeof *out);
  angle_factors(u, s);
  differentiate(s, z[C], z, &d);
  const sw_vec carried = sw_slip_carry(p, b, sw_unit_or(sum, b));
  const sw_vec beta = sw_scale(normal, s[0]);
  const double xi = sw_norm(sw_sub(sw_scale(beta, law->k), sw_scale(carried, K)));
  const double over = excess(law, xi), p2 = sw_norm2(p);
  out->elastic = law->own > 0 ? 0.0 : 0.5 * law->k * p2 - law->k * d.value;
  out->energy =
      0.5 * law->own * sw_norm2(beta) - law->k * d.value + 0.5 * K * p2 - 0.5 * over * over / K;
  potential(law, s, xi, 1.0, &d, w1, w2);
  gradients(hinge, memory, w1, out);
  if (!(want & SW_WANT_STIFFNESS)) return;
  if (share < 1.0) potential(law, s, xi, share, &d, w1, w2);
  stiffness(hinge, memory, w1, w2, out);
}

double sw_slip_commit(const sw_slip_law *law, const sw_slip_hinge *hinge, sw_slip_memory *memory) {
  const sw_vec b = sw_unit_or(sw_add(hinge->t[0], hinge->t[1]), hinge->t[1]);
  sw_vec p = sw_slip_carry(memory->slipped, memory->along, b);
  double work = 0;
  if (law) {
    double s[3];
    const double K = law->k + law->harden;
    angle_factors(half_angle2(hinge), s);
    const sw_vec beta = sw_scale(sw_cross(hinge->t[0], hinge->t[1]), s[0]);
    const sw_vec xi = sw_sub(sw_scale(beta, law->k), sw_scale(p, K));
    const double size = sw_norm(xi), slip = fmax(0.0, size - law->limit) / K;
    if (slip > 0) p = sw_madd(p, xi, slip / size);
    work = law->limit * slip;
  }
  *memory = (sw_slip_memory){across(p, b), b};
  return work;
}
