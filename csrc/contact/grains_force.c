/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a touch does to its nodes, whether it agrees with the solve, impacts. */
#include <math.h>

#include "contact/grain.h"
#include "contact/same.h"

enum { NODES = 4, NEXT = 6, ROW = 24 }; /* of a touch; layout of the system's block rows */
static const size_t FULL[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
static const size_t UPPER[6] = {0, 1, 2, 4, 5, 8};

/* --- forces ------------------------------------------------------------------------- */

/* How a touch's nodes move it: their weights, and what turns its normal (see pairs_force.c). */
typedef struct lever {
  double w[NODES];
  sw_vec g[2][NODES]; /* mixed derivatives of half the distance squared: by places and nodes [m] */
  double Q[3];        /* inverse of the second ones by the places that slide [1/m2] */
  double f;           /* -N over the distance; 0: the normal counts as fixed [N/m] */
} lever;

/* Where the two are nearer than this share of the radii's sum, normals mean little [-]. */
static const double WELL_APART = 0.5;

static void invert_places(sw_vec a, sw_vec b, const int slides[2], lever *l) {
  const double aa = sw_norm2(a), bb = sw_norm2(b), ab = sw_dot(a, b);
  const double det = aa * bb - ab * ab;
  if (slides[0] && slides[1]) {
    if (!(det > 1e-3 * aa * bb))
      l->f = 0;
    else
      l->Q[0] = bb / det, l->Q[1] = ab / det, l->Q[2] = aa / det;
  } else if (slides[0] && aa > 0) {
    l->Q[0] = 1.0 / aa;
  } else if (slides[1] && bb > 0) {
    l->Q[2] = 1.0 / bb;
  }
}

static lever lever_of(const sw_grain_touch *t, const double *y) {
  static const double by_place[2][NODES] = {{-1, 1, 0, 0}, {0, 0, 1, -1}}; /* of the weights */
  const sw_grain_pair *k = &t->pair;
  const sw_vec a = sw_sub(sw_vec_at(y, k->end[0]), sw_vec_at(y, k->node[0]));
  const sw_vec b = sw_sub(sw_vec_at(y, k->end[1]), sw_vec_at(y, k->node[1]));
  const sw_vec along[2] = {a, sw_neg(b)};
  const double d = t->press.gap - t->forgiven + k->reach;
  lever l = {.w = {1.0 - t->at[0], t->at[0], t->at[1] - 1.0, -t->at[1]}};
  if (d > WELL_APART * k->reach && !t->barred) l.f = -t->press.lag / d;
  for (int q = 0; q < 2; q++)
    for (int i = 0; i < NODES; i++)
      l.g[q][i] = sw_madd(sw_scale(along[q], l.w[i]), t->press.normal, d * by_place[q][i]);
  invert_places(a, b, t->slides, &l);
  return l;
}

static void add_outer(double out[9], sw_vec a, sw_vec b, double f) {
  const double x[3] = {f * a.x, f * a.y, f * a.z}, y[3] = {b.x, b.y, b.z};
  for (int m = 0; m < 9; m++) out[m] += x[m / 3] * y[m % 3];
}

/* Stiffness between nodes i and j: of the law, and of the normal that turns. */
static void block(const lever *l, sw_vec n, const double K[6], int i, int j, double out[9]) {
  const double P[6] = {1 - n.x * n.x, -n.x * n.y, -n.x * n.z,
                       1 - n.y * n.y, -n.y * n.z, 1 - n.z * n.z};
  for (int m = 0; m < 9; m++) out[m] = l->w[i] * l->w[j] * (K[FULL[m]] + l->f * P[FULL[m]]);
  if (l->f == 0) return;
  add_outer(out, l->g[0][i], l->g[0][j], -l->f * l->Q[0]);
  add_outer(out, l->g[1][i], l->g[1][j], -l->f * l->Q[2]);
  add_outer(out, l->g[0][i], l->g[1][j], -l->f * l->Q[1]);
  add_outer(out, l->g[1][i], l->g[0][j], -l->f * l->Q[1]);
}

/* Between nodes i < j of a touch: of one edge, or of both things. */
static sw_status couple(sw_system *s, const sw_grain_pair *k, int i, int j, const uint32_t *node,
                        const double K[9]) {
  if (i < 2 && j >= 2) return sw_system_add_bridge(s, node[i], node[j], K);
  sw_body *b = &s->bodies[k->body[i / 2]];
  const size_t first = b->first_node;
  if (b->plan->web) {
    sw_body_couple(b, node[i] - first, node[j] - first, K);
    return SW_OK;
  }
  double *row = b->field.rows + ROW * (node[i] - first);
  for (int m = 0; m < 9; m++) row[NEXT + m] += K[m];
  return SW_OK;
}

sw_status sw_grain_add(sw_system *s, const sw_grain_touch *t, const double *y, sw_vec force,
                       const double *K) {
  const sw_grain_pair *k = &t->pair;
  const uint32_t node[NODES] = {k->node[0], k->end[0], k->node[1], k->end[1]};
  const int there[NODES] = {1, k->end[0] != k->node[0], 1, k->end[1] != k->node[1]};
  const lever l = lever_of(t, y);
  double K_ij[9];
  for (int i = 0; i < NODES; i++) {
    if (!there[i]) continue;
    sw_body *b = &s->bodies[k->body[i / 2]];
    const size_t at = node[i] - b->first_node;
    sw_accumulate(b->field.force + 3 * at, sw_scale(force, l.w[i]));
    if (!K) continue;
    block(&l, t->press.normal, K, i, i, K_ij);
    for (int m = 0; m < 6; m++) b->field.rows[ROW * at + (size_t)m] += K_ij[UPPER[m]];
    for (int j = i + 1; j < NODES; j++) {
      if (!there[j]) continue;
      block(&l, t->press.normal, K, i, j, K_ij);
      SW_TRY(couple(s, k, i, j, node, K_ij));
    }
  }
  return SW_OK;
}

/* --- after the solve ----------------------------------------------------------------- */

/* Shorter updates leave place and normal of a touch as they are; of the radii [-]. */
static const double SMALL_SHIFT = 0.05;

static int update(const sw_grains *g, sw_grain_touch *t, const double *delta, double scale) {
  const sw_vec shift = sw_grain_apart(delta, &t->pair, t->at);
  const double friction = sw_grain_rule(g, t->pair.body)->friction;
  const int agrees = sw_press_update(&t->press, friction, shift, scale);
  const int small = sw_norm(shift) <= SMALL_SHIFT * t->pair.reach;
  if (t->press.gap_after < 0.5 * t->pair.reach && !small) return 0;
  /* a prediction's normal is not the end's */
  if (g->updates == 1 && g->regime == SW_CONTACT_IMPLICIT && t->press.active) return 0;
  return agrees;
}

static int stiffen(sw_grains *g, const sw_system *s) {
  const int small = sw_press_is_short(g->regime == SW_CONTACT_STATIC, g->h, g->nominal);
  int any = 0;
  if (g->regime == SW_CONTACT_EXPLICIT || s->rough) return 0;
  for (size_t i = 0; i < g->pair_count; i++) {
    sw_grain_touch *t = &g->now[i];
    if (!t->stage) continue;
    const sw_vec apart = sw_grain_apart(s->x, &t->pair, t->at);
    const double before = fmax(0.0, t->pair.reach - sw_dot(t->press.normal, apart));
    t->stiffer = sw_press_stiffer(&t->press, t->pair.usual, t->forgiven, small ? before : -1.0);
    any |= t->stiffer > t->press.k;
  }
  return any;
}

/* Forces far below the largest one of either body do not matter. */
static void find_scales(sw_grains *g) {
  for (size_t b = 0; b < g->bodies; b++) g->largest[b] = 0;
  for (size_t i = 0; i < g->pair_count; i++)
    for (size_t k = 0; k < 2 && g->now[i].stage; k++) {
      double *largest = &g->largest[g->pairs[i].body[k]];
      *largest = fmax(*largest, g->now[i].press.lag);
    }
}

int sw_grains_settled(sw_grains *g, sw_system *s, const double *delta) {
  int fine = 1;
  g->updates++;
  find_scales(g);
  for (size_t i = 0; i < g->pair_count; i++) {
    const uint32_t *body = g->pairs[i].body;
    if (!g->now[i].stage) continue;
    const double scale = fmin(g->largest[body[0]], g->largest[body[1]]);
    fine &= update(g, &g->now[i], delta, scale);
  }
  return fine && !stiffen(g, s);
}

/* --- review ---------------------------------------------------------------------------- */

/* Places that are met within the step: it is redone as one that does not bounce, in which both
 * reach each other and go on together. */
static int strike(sw_grains *g, const sw_system *s, double h) {
  if (g->struck) return 0;
  for (size_t i = 0; i < g->pair_count; i++) {
    const sw_grain_touch *t = &g->now[i];
    if (!t->stage || !(t->press.normal_force > 0)) continue;
    const double gap =
        sw_dot(t->press.normal, sw_grain_apart(s->x, &t->pair, t->at)) - t->pair.reach;
    const double approach = -sw_dot(sw_grain_apart(s->v, &t->pair, t->at), t->press.normal);
    g->hits += approach - fmax(0.0, gap) / h > SW_SLOWEST_IMPACT;
  }
  return g->struck = g->hits > 0;
}

/* How far nodes go astray of their free way in the step, which is all that was reckoned with [m].
 */
static double stray(const sw_system *s, const double *x1, double h) {
  double most = 0;
  for (size_t i = 0; i < s->nodes; i++) {
    const sw_vec way = sw_sub(sw_vec_at(x1, i), sw_vec_at(s->x, i));
    most = fmax(most, sw_norm2(sw_madd(way, sw_vec_at(s->v, i), -h)));
  }
  return sqrt(most);
}

/* 1: more may touch than was looked at, and has been added. */
static int widen(sw_grains *g, sw_system *s, const double *x1, double h) {
  const double needed = 2.0 * stray(s, x1, h);
  double least = HUGE_VAL;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_plan *p = s->bodies[b].plan;
    least = fmin(least, 2.0 * (p->web ? p->web->skin : p->beam.radius));
  }
  if (!(needed > fmax(0.25 * least + g->fall, g->least_reserve))) return 0;
  g->least_reserve = 1.5 * needed;
  return sw_grains_choose(g, s) == SW_OK;
}

/* A step may leave two this much deeper in each other than it found them; of the radii's sum [-].
 * In steps below this share of the nominal one depth is taken as it comes [-]. */
static const double DEEPER = 0.05, SMALLEST_CARE = 1.0 / 64;

static double distance_at(const double *x, const sw_grain_pair *k) {
  double at[2];
  return sw_grain_nearest(x, k, at);
}

static int cuts_deep(const sw_grains *g, const sw_system *s, const double *x1, double h) {
  if (h < SMALLEST_CARE * g->nominal || g->regime == SW_CONTACT_EXPLICIT) return 0;
  for (size_t i = 0; i < g->pair_count; i++) {
    const sw_grain_pair *k = &g->pairs[i];
    const double deeper = DEEPER * k->reach;
    if (k->held) continue;
    const double after = distance_at(x1, k);
    if (after < k->reach - deeper && after < distance_at(s->x, k) - deeper) return 1;
  }
  return 0;
}

sw_contact_verdict sw_grains_review(sw_grains *g, sw_system *s, const double *x1, double h) {
  if (widen(g, s, x1, h)) return SW_CONTACT_REDO;
  if (strike(g, s, h)) return SW_CONTACT_STRIKE;
  return cuts_deep(g, s, x1, h) ? SW_CONTACT_SMALLER : SW_CONTACT_ACCEPT;
}

int sw_grains_review_static(sw_grains *g, sw_system *s, const double *x1) {
  return widen(g, s, x1, 0.0);
}
