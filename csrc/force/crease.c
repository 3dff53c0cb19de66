/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bending of a ring's wall about the wire: E = 1/2 k (phi - phi0)^2. phi is the angle by which the
 * strip from b to c is turned from the strip from a to b, about the edge from b to d, which runs
 * along the wire (the hinge of Grinspun et al., Discrete shells, 2003). phi has a sign: it
 * distinguishes a wall bent inwards from one bent outwards.
 *
 * Let e = d - b, u its unit vector, l its length. The turn theta of q about e has, with w = u x q,
 * h = |w|, n = w/h, s = q.e/l^2, the derivatives
 *   theta_q = w/h^2, theta_e = -s theta_q, theta_qq = (I - 2 n n')[u x]/h^2,
 *   theta_qe = -(I - 2 n n')[q x](I - u u')/(l h^2), theta_ee = -theta_q s_e' - s theta_qe,
 *   s_e = q/l^2 - 2 s e/l^2,
 * and phi = pi + theta(c - b) - theta(a - b). Undefined where a or c lies on the edge (h = 0). */
#include "state/crease.h"

#include <math.h>

#include "force/force.h"

enum { A, C, EDGE, PARTS }; /* vectors from b to a, c and d */

typedef double block[3][3];

typedef struct turned {
  sw_vec by_q, by_e; /* derivatives [1/m] */
  block qq, qe, ee;  /* [1/m2] */
} turned;

static void cross_matrix(sw_vec v, block out) {
  const block m = {{0, -v.z, v.y}, {v.z, 0, -v.x}, {-v.y, v.x, 0}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out[i][j] = m[i][j];
}

static void times(const block a, const block b, double scale, block out) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      out[i][j] = scale * (a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]);
}

/* I - share v v' */
static void without(sw_vec v, double share, block out) {
  const double c[3] = {v.x, v.y, v.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out[i][j] = (i == j) - share * c[i] * c[j];
}

static void measure(sw_vec q, sw_vec e, int second, turned *t) {
  const double l2 = sw_norm2(e), l = sqrt(l2), s = sw_dot(q, e) / l2;
  const sw_vec u = sw_scale(e, 1.0 / l), w = sw_cross(u, q);
  const double h2 = fmax(sw_norm2(w), SW_CREASE_LEAST * l2);
  t->by_q = sw_scale(w, 1.0 / h2);
  t->by_e = sw_scale(t->by_q, -s);
  if (!second) return;
  block mirror, along, across, part;
  without(sw_scale(w, 1.0 / sqrt(h2)), 2.0, mirror);
  cross_matrix(u, along);
  times(mirror, along, 1.0 / h2, t->qq);
  cross_matrix(q, along);
  without(u, 1.0, across);
  times(mirror, along, -1.0 / (l * h2), part);
  times(part, across, 1.0, t->qe);
  const sw_vec se = sw_scale(sw_madd(q, e, -2.0 * s), 1.0 / l2);
  const double p[3] = {t->by_q.x, t->by_q.y, t->by_q.z}, r[3] = {se.x, se.y, se.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) t->ee[i][j] = -p[i] * r[j] - s * t->qe[i][j];
}

typedef struct bent {
  turned to[2];        /* of a and of c */
  sw_vec slope[PARTS]; /* of phi [1/m] */
  double over, k;      /* phi - phi0 [rad]; [N m] */
} bent;

static void bend(const sw_web_crease *crease, const double *x, int second, bent *b) {
  const sw_vec at = sw_vec_at(x, crease->b), e = sw_sub(sw_vec_at(x, crease->d), at);
  const sw_vec q[2] = {sw_sub(sw_vec_at(x, crease->a), at), sw_sub(sw_vec_at(x, crease->c), at)};
  b->k = crease->k;
  b->over = sw_crease_angle(q[0], q[1], e) - crease->rest;
  for (int i = 0; i < 2; i++) measure(q[i], e, second, &b->to[i]);
  b->slope[A] = sw_neg(b->to[0].by_q);
  b->slope[C] = b->to[1].by_q;
  b->slope[EDGE] = sw_sub(b->to[1].by_e, b->to[0].by_e);
}

static void add_force(const sw_web_crease *crease, const bent *b, double *force) {
  const uint32_t to[PARTS] = {crease->a, crease->c, crease->d};
  for (int i = 0; i < PARTS; i++) {
    const sw_vec f = sw_scale(b->slope[i], -b->k * b->over);
    sw_accumulate(force + 3 * (size_t)to[i], f);
    sw_accumulate(force + 3 * (size_t)crease->b, sw_neg(f));
  }
}

/* Second derivatives of the energy with respect to the vectors from b. */
static void curve(const bent *b, block H[PARTS][PARTS]) {
  const double moment = b->k * b->over;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      H[A][A][i][j] = -moment * b->to[0].qq[i][j];
      H[C][C][i][j] = moment * b->to[1].qq[i][j];
      H[A][C][i][j] = H[C][A][i][j] = 0;
      H[A][EDGE][i][j] = H[EDGE][A][j][i] = -moment * b->to[0].qe[i][j];
      H[C][EDGE][i][j] = H[EDGE][C][j][i] = moment * b->to[1].qe[i][j];
      H[EDGE][EDGE][i][j] = moment * (b->to[1].ee[i][j] - b->to[0].ee[i][j]);
    }
  for (int m = 0; m < PARTS; m++)
    for (int n = 0; n < PARTS; n++) {
      const double p[3] = {b->slope[m].x, b->slope[m].y, b->slope[m].z};
      const double r[3] = {b->slope[n].x, b->slope[n].y, b->slope[n].z};
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) H[m][n][i][j] += b->k * p[i] * r[j];
    }
}

static void add_stiffness(const sw_web_crease *crease, const bent *b, size_t number, sw_field *f) {
  const uint32_t node[PARTS] = {crease->a, crease->c, crease->d};
  const size_t *slot = f->crease_slot + SW_FIELD_CREASE_PAIRS * number;
  block H[PARTS][PARTS], own = {{0}};
  curve(b, H);
  for (int m = 0; m < PARTS; m++) {
    block with_b = {{0}}; /* moving b moves all three vectors the other way */
    for (int n = 0; n < PARTS; n++)
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
          with_b[i][j] -= H[m][n][i][j];
          own[i][j] += H[m][n][i][j];
        }
    sw_field_add_own(f, node[m], &H[m][m][0][0]);
    sw_field_add_block(f, node[m], crease->b, slot[m], &with_b[0][0], 3);
  }
  sw_field_add_own(f, crease->b, &own[0][0]);
  sw_field_add_block(f, crease->a, crease->c, slot[3], &H[A][C][0][0], 3);
  sw_field_add_block(f, crease->a, crease->d, slot[4], &H[A][EDGE][0][0], 3);
  sw_field_add_block(f, crease->c, crease->d, slot[5], &H[C][EDGE][0][0], 3);
}

static sw_status eval(const void *args SW_UNUSED, sw_field *f, sw_error *err SW_UNUSED) {
  const sw_web *web = f->plan->web;
  for (size_t n = 0; n < web->creases; n++) {
    const sw_web_crease *crease = &web->crease[n];
    bent b;
    bend(crease, f->x, (f->want & SW_WANT_STIFFNESS) != 0, &b);
    if (f->want & SW_WANT_FORCE) add_force(crease, &b, f->force);
    if (f->want & SW_WANT_STIFFNESS) add_stiffness(crease, &b, n, f);
    if (f->want & SW_WANT_ENERGY) f->energy += 0.5 * b.k * b.over * b.over;
  }
  return SW_OK;
}

const sw_force_class sw_force_crease = {
    .name = "crease",
    .summary = "bending of the wall of a tube's rings",
    .stores = "bend",
    .flags = SW_FORCE_INNER | SW_FORCE_ANY_BODY,
    .params = {"force crease", NULL, 0},
    .eval = eval,
};
