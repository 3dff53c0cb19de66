/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A touch's force and stiffness among the four nodes of its segments. Besides the law's
 * own stiffness K at the touch there is that of the turning normal: with the nearest
 * points free to slide, the distance d has the second derivative
 *   (1/d) [ w_i w_j (I - n n') - g_i' Q^-1 g_j ]
 * between nodes i and j, where w are the weights of the touch (negative on the second
 * segment), Q the second derivatives of |r|^2/2 with respect to the places along the
 * segments, and g its mixed ones. The normal force N adds -N times that. */
#include "contact/pair.h"

enum { OWN = 0, NEXT = 6, ROW = 24 }; /* layout of the system's block rows */
static const size_t FULL[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
static const size_t UPPER[6] = {0, 1, 2, 4, 5, 8};

/* Stiffness between the nodes: segment one's two, segment two's two. */
typedef struct blocks {
  double k[4][4][9];
} blocks;

static void add_outer(double out[9], sw_vec a, sw_vec b, double f) {
  const double x[3] = {f * a.x, f * a.y, f * a.z}, y[3] = {b.x, b.y, b.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out[3 * i + j] += x[i] * y[j];
}

/* The touch of a node does nothing to the other node of its segment. */
static int takes_part(const double w[4], const int slides[2], int i) {
  return w[i] != 0 || slides[i / 2];
}

static void add_law(blocks *b, const double w[4], const double K[6]) {
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4 && w[i] != 0; j++)
      for (int m = 0; m < 9; m++) b->k[i][j][m] += w[i] * w[j] * K[FULL[m]];
}

/* Inverse of Q for the places that may slide; others' rows are zero. 0 = none or nearly
 * parallel. */
static int invert_places(sw_vec a, sw_vec b, const int slides[2], double Q[3]) {
  const double aa = sw_norm2(a), bb = sw_norm2(b), ab = sw_dot(a, b);
  Q[0] = Q[1] = Q[2] = 0;
  if (slides[0] && slides[1]) {
    const double det = aa * bb - ab * ab;
    if (!(det > 1e-3 * aa * bb)) return 0;
    Q[0] = bb / det, Q[1] = ab / det, Q[2] = aa / det;
  } else if (slides[0]) {
    Q[0] = 1.0 / aa;
  } else if (slides[1]) {
    Q[2] = 1.0 / bb;
  }
  return 1;
}

/* -N times the second derivative of the distance; f = -N/d. */
static void add_turning(blocks *out, const double w[4], sw_vec a, sw_vec b, sw_vec n, double d,
                        double f, const int slides[2]) {
  static const double by_place[2][4] = {{-1, 1, 0, 0}, {0, 0, 1, -1}}; /* of the weights */
  const sw_vec along[2] = {a, sw_neg(b)};
  const double P[6] = {1 - n.x * n.x, -n.x * n.y, -n.x * n.z,
                       1 - n.y * n.y, -n.y * n.z, 1 - n.z * n.z};
  double Q[3];
  sw_vec g[2][4];
  if (!invert_places(a, b, slides, Q)) return;
  for (int q = 0; q < 2; q++)
    for (int i = 0; i < 4; i++) g[q][i] = sw_madd(sw_scale(along[q], w[i]), n, d * by_place[q][i]);
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4 && takes_part(w, slides, i); j++) {
      if (!takes_part(w, slides, j)) continue;
      double *k = out->k[i][j];
      for (int m = 0; m < 9; m++) k[m] += f * w[i] * w[j] * P[FULL[m]];
      add_outer(k, g[0][i], g[0][j], -f * Q[0]);
      add_outer(k, g[1][i], g[1][j], -f * Q[2]);
      add_outer(k, g[0][i], g[1][j], -f * Q[1]);
      add_outer(k, g[1][i], g[0][j], -f * Q[1]);
    }
}

static void add_to_rows(sw_body *body, size_t i, double k[4][4][9], int first) {
  double *row = body->field.rows + ROW * i;
  for (int e = 0; e < 2; e++)
    for (int m = 0; m < 6; m++) row[ROW * e + OWN + m] += k[first + e][first + e][UPPER[m]];
  for (int m = 0; m < 9; m++) row[NEXT + m] += k[first][first + 1][m];
}

static void add_force(sw_body *body, size_t i, double at, sw_vec f) {
  sw_accumulate(body->field.force + 3 * i, sw_scale(f, 1.0 - at));
  sw_accumulate(body->field.force + 3 * i + 3, sw_scale(f, at));
}

static sw_status link_nodes(sw_system *s, const sw_pair *k, const double w[4], const int slides[2],
                            double block[4][4][9]) {
  for (uint32_t i = 0; i < 2; i++)
    for (uint32_t j = 0; j < 2 && takes_part(w, slides, (int)i); j++)
      if (takes_part(w, slides, 2 + (int)j))
        SW_TRY(sw_system_add_bridge(s, k->one + i, k->two + j, block[i][2 + j]));
  return SW_OK;
}

/* Where axes are nearer than this share of the radii's sum, normals mean little [-]. */
static const double WELL_APART = 0.5;

sw_status sw_pair_add(sw_system *s, const sw_pair *k, const sw_pair_touch *t, const double *y,
                      sw_vec force, const double *K) {
  sw_body *one = &s->bodies[k->body[0]], *two = &s->bodies[k->body[1]];
  const size_t i = k->one - one->first_node, j = k->two - two->first_node;
  const double w[4] = {1.0 - t->at[0], t->at[0], t->at[1] - 1.0, -t->at[1]};
  blocks b = {0};
  add_force(one, i, t->at[0], force);
  add_force(two, j, t->at[1], sw_neg(force));
  if (!K) return SW_OK;
  add_law(&b, w, K);
  const double d = t->press.gap - t->forgiven + k->reach;
  if (d > WELL_APART * k->reach && !t->barred && !t->far) {
    const sw_vec a0 = sw_vec_at(y, k->one), b0 = sw_vec_at(y, k->two);
    add_turning(&b, w, sw_sub(sw_vec_at(y, k->one + 1u), a0), sw_sub(sw_vec_at(y, k->two + 1u), b0),
                t->press.normal, d, -t->press.lag / d, t->slides);
  }
  add_to_rows(one, i, b.k, 0);
  add_to_rows(two, j, b.k, 2);
  return link_nodes(s, k, w, t->slides, b.k);
}
