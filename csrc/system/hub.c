/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An arm of a hub is the vector a with direction p; r = R d. Its energy k (1 - p.r) has the
 * derivative -k u/|a| with u = r - (p.r) p, and the second derivative
 *   k (p u' + u p' + (p.r)(I - p p'))/|a|^2.
 * A further turn w of the hub has the coupling k (I - p p')[r x]/|a| with the arm, and with itself
 * the sum of k ((p.r) I - (p r' + r p')/2). It is eliminated, since it has no inertia. */
#include "system/hub.h"

#include <math.h>
#include <string.h>

/* --- matrices of three by three --------------------------------------------------- */

static void add_unit(double out[9], double f) { out[0] += f, out[4] += f, out[8] += f; }

static void multiply(const double a[9], const double b[9], double out[9]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

static void transpose(const double a[9], double out[9]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out[3 * i + j] = a[3 * j + i];
}

/* Inverts a regular symmetric matrix. */
static void invert(const double a[9], double out[9]) {
  const double c0 = a[4] * a[8] - a[5] * a[7], c1 = a[5] * a[6] - a[3] * a[8];
  const double c2 = a[3] * a[7] - a[4] * a[6];
  const double r = 1.0 / (a[0] * c0 + a[1] * c1 + a[2] * c2);
  out[0] = r * c0, out[1] = out[3] = r * c1, out[2] = out[6] = r * c2;
  out[4] = r * (a[0] * a[8] - a[2] * a[6]), out[8] = r * (a[0] * a[4] - a[1] * a[3]);
  out[5] = out[7] = r * (a[2] * a[3] - a[0] * a[5]);
}

/* --- hubs ------------------------------------------------------------------------ */

void sw_hub_measure(const sw_join_hub *h, const double *x, sw_hub_arm *arms) {
  const sw_quat q = sw_join_hub_turn(h, x);
  for (size_t a = 0; a < h->count; a++) {
    const sw_vec edge = sw_join_edge(&h->arms[a], x);
    arms[a].inverse = 1.0 / sw_norm(edge);
    arms[a].p = sw_scale(edge, arms[a].inverse);
    arms[a].r = sw_rotate(q, h->arms[a].rest);
    arms[a].c = sw_dot(arms[a].p, arms[a].r);
  }
}

/* Stiffness about a free axis, so that the matrix is regular; over the sum of all arms' stiffness
 * [-]. */
static const double FREE_AXIS = 1e-9;

void sw_hub_compliance(const sw_join_hub *h, const sw_hub_arm *arms, double out[9]) {
  double H[9] = {0}, sum = 0;
  for (size_t a = 0; a < h->count; a++) {
    const double k = h->arms[a].k;
    add_unit(H, k * arms[a].c);
    sw_add_outer(H, arms[a].p, arms[a].r, -0.5 * k);
    sw_add_outer(H, arms[a].r, arms[a].p, -0.5 * k);
    sum += k;
  }
  /* parallel arms do not turn with that axis: any stiffness there gives the same result */
  add_unit(H, FREE_AXIS * sum);
  invert(H, out);
}

void sw_hub_rest_compliance(const sw_join_hub *h, const sw_hub_arm *arms, double C[9]) {
  sw_hub_arm rest[SW_HUB_ARMS];
  for (size_t a = 0; a < h->count; a++)
    rest[a] = (sw_hub_arm){arms[a].r, arms[a].r, arms[a].inverse, 1.0};
  sw_hub_compliance(h, rest, C);
}

void sw_hub_coupling(const sw_hub_arm *v, double k, double out[9]) {
  const sw_vec r = v->r, columns[3] = {{0, r.z, -r.y}, {-r.z, 0, r.x}, {r.y, -r.x, 0}};
  for (size_t j = 0; j < 3; j++) {
    const sw_vec c = sw_scale(sw_madd(columns[j], v->p, -sw_dot(columns[j], v->p)), k * v->inverse);
    out[j] = c.x, out[3 + j] = c.y, out[6 + j] = c.z;
  }
}

/* Adds the stiffness K between the vectors of two arms to their nodes. */
static sw_status add_arms(sw_system *s, const struct sw_join_arm *a, const struct sw_join_arm *b,
                          const double K[9]) {
  double minus[9], both[9];
  for (size_t m = 0; m < 9; m++) minus[m] = -K[m];
  if (a == b) {
    SW_TRY(sw_join_add_block(s, a->from, a->from, K));
    SW_TRY(sw_join_add_block(s, a->to, a->to, K));
    return sw_join_add_block(s, a->from, a->to, minus);
  }
  const uint32_t i[2] = {a->from, a->to}, j[2] = {b->from, b->to};
  for (size_t m = 0; m < 2; m++)
    for (size_t n = 0; n < 2; n++) {
      const double *k = m == n ? K : minus;
      /* a node in both arms gets the block and its transpose */
      for (int c = 0; c < 9; c++) both[c] = k[c] + k[3 * (c % 3) + c / 3];
      SW_TRY(sw_join_add_block(s, i[m], j[n], i[m] == j[n] ? both : k));
    }
  return SW_OK;
}

/* Stiffness of an arm's vector while the hub does not turn. */
static void own_stiffness(const sw_hub_arm *v, double k, double out[9]) {
  const sw_vec u = sw_madd(v->r, v->p, -v->c);
  const double f = k * v->inverse * v->inverse;
  memset(out, 0, 9 * sizeof *out);
  sw_add_outer(out, v->p, u, f);
  sw_add_outer(out, u, v->p, f);
  sw_add_outer(out, v->p, v->p, -f * v->c);
  add_unit(out, f * v->c);
}

sw_status sw_hub_eval(sw_system *s, const sw_join_hub *h, const double *y, sw_hub_arm *arms,
                      double C[9]) {
  double coupling[SW_HUB_ARMS][9], own[9];
  sw_hub_measure(h, y, arms);
  sw_hub_compliance(h, arms, C);
  for (size_t a = 0; a < h->count; a++) {
    const sw_hub_arm *v = &arms[a];
    const sw_vec pull = sw_scale(sw_madd(v->r, v->p, -v->c), h->arms[a].k * v->inverse);
    sw_join_add_force(s, h->arms[a].to, pull);
    sw_join_add_force(s, h->arms[a].from, sw_neg(pull));
    sw_hub_coupling(v, h->arms[a].k, coupling[a]);
  }
  for (size_t a = 0; a < h->count; a++)
    for (size_t b = a; b < h->count; b++) {
      double left[9], turned[9], K[9];
      multiply(coupling[a], C, left);
      transpose(coupling[b], turned);
      multiply(left, turned, K);
      if (a == b) own_stiffness(&arms[a], h->arms[a].k, own);
      for (size_t m = 0; m < 9; m++) K[m] = (a == b ? own[m] : 0.0) - K[m];
      SW_TRY(add_arms(s, &h->arms[a], &h->arms[b], K));
    }
  return SW_OK;
}
