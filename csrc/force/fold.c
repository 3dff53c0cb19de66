/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bending between three particles of a web in a row: E = 1/2 k (phi - phi0)^2, phi the angle
 * between the unit tangents t1 and t2 of both parts, phi0 the angle at rest. As for a rod's hinges
 * (bend.c), with c = cos phi, s = (phi - phi0)/sin phi, w = (1 - s c)/sin^2 phi, p1 = t2 - c t1, p2
 * = t1 - c t2, the gradient with respect to edge e1 is -k s p1/l1 and the second derivatives are
 *   H11 = (k w p1 p1' + k s (c (I - t1 t1') + t1 p1' + p1 t1')) / l1^2,
 *   H12 = (k w p1 p2' - k s (I - t1 t1')(I - t2 t2')) / (l1 l2).
 * Undefined where one part is folded back onto the other (phi = pi). */
#include <math.h>

#include "force/force.h"
#include "state/angle.h"

typedef struct bent {
  double t[2][3], p[2][3], l[2]; /* [-], [-], [m] */
  double c, s, w;                /* [-] */
  double rest;                   /* [rad] */
  double k;                      /* [N m] */
} bent;

static const double LEAST_SINE = 1e-3; /* lower bound of sin phi where phi0 > 0 [-] */

static void measure(const sw_web_fold *fold, const double *x, bent *b) {
  const sw_vec at[3] = {sw_vec_at(x, fold->a), sw_vec_at(x, fold->b), sw_vec_at(x, fold->c)};
  const sw_vec e[2] = {sw_sub(at[1], at[0]), sw_sub(at[2], at[1])};
  sw_vec t[2];
  for (int i = 0; i < 2; i++) {
    b->l[i] = fmax(sw_norm(e[i]), 1e-30);
    t[i] = sw_scale(e[i], 1.0 / b->l[i]);
    sw_store(b->t[i], t[i]);
  }
  const double u = 0.25 * sw_norm2(sw_sub(t[0], t[1]));
  sw_angle_factors(u, &b->s, &b->w);
  b->c = 1.0 - 2.0 * u;
  b->k = fold->k;
  b->rest = fold->rest;
  if (fold->rest > 0) {
    const double sine = fmax(LEAST_SINE, sqrt(fmax(0.0, 1.0 - b->c * b->c)));
    b->s = (atan2(sine, b->c) - fold->rest) / sine;
    b->w = (1.0 - b->s * b->c) / (sine * sine);
  }
  for (int i = 0; i < 2; i++) sw_store(b->p[i], sw_madd(t[1 - i], t[i], -b->c));
}

static double energy_of(const bent *b) {
  const double phi = acos(fmax(-1.0, fmin(1.0, b->c))) - b->rest;
  return 0.5 * b->k * phi * phi;
}

static void add_force(const sw_web_fold *fold, const bent *b, double *force) {
  double *at[3] = {force + 3 * (size_t)fold->a, force + 3 * (size_t)fold->b,
                   force + 3 * (size_t)fold->c};
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 3; k++) {
      const double g = -b->k * b->s * b->p[i][k] / b->l[i];
      at[i][k] += g;
      at[i + 1][k] -= g;
    }
}

/* Second derivatives with respect to one edge. */
static void own_part(const bent *b, int n, double H[9]) {
  const double *t = b->t[n], *p = b->p[n], r = b->k / (b->l[n] * b->l[n]);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      H[3 * i + j] = r * (b->w * p[i] * p[j] +
                          b->s * (b->c * ((i == j) - t[i] * t[j]) + t[i] * p[j] + p[i] * t[j]));
}

static void mixed_part(const bent *b, double H[9]) {
  const double *t = b->t[0], *q = b->t[1], r = b->k / (b->l[0] * b->l[1]);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const double across = (i == j) - t[i] * t[j] - q[i] * q[j] + t[i] * b->c * q[j];
      H[3 * i + j] = r * (b->w * b->p[0][i] * b->p[1][j] - b->s * across);
    }
}

static void add_stiffness(const sw_web_fold *fold, const bent *b, size_t number, sw_field *f) {
  const size_t *slot = f->fold_slot + 3 * number;
  double H1[9], H2[9], M[9], bb[9], ab[9], ac[9], bc[9];
  own_part(b, 0, H1);
  own_part(b, 1, H2);
  mixed_part(b, M);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const int k = 3 * i + j;
      bb[k] = H1[k] + H2[k] - M[k] - M[3 * j + i];
      ab[k] = M[k] - H1[k];
      ac[k] = -M[k];
      bc[k] = M[k] - H2[k];
    }
  sw_field_add_own(f, fold->a, H1);
  sw_field_add_own(f, fold->b, bb);
  sw_field_add_own(f, fold->c, H2);
  sw_field_add_block(f, fold->a, fold->b, slot[0], ab, 3);
  sw_field_add_block(f, fold->a, fold->c, slot[1], ac, 3);
  sw_field_add_block(f, fold->b, fold->c, slot[2], bc, 3);
}

static sw_status eval(const void *args SW_UNUSED, sw_field *f, sw_error *err SW_UNUSED) {
  const sw_web *web = f->plan->web;
  for (size_t n = 0; n < web->folds; n++) {
    const sw_web_fold *fold = &web->fold[n];
    bent b;
    measure(fold, f->x, &b);
    if (f->want & SW_WANT_FORCE) add_force(fold, &b, f->force);
    if (f->want & SW_WANT_STIFFNESS) add_stiffness(fold, &b, n, f);
    if (f->want & SW_WANT_ENERGY) f->energy += energy_of(&b);
  }
  return SW_OK;
}

const sw_force_class sw_force_fold = {
    .name = "fold",
    .summary = "bending between three particles of a mesh in a row",
    .stores = "bend",
    .flags = SW_FORCE_INNER | SW_FORCE_ANY_BODY,
    .params = {"force fold", NULL, 0},
    .eval = eval,
};
