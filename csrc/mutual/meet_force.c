/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributes a touch's force and stiffness to the nodes of its places: one node of a particle, two
 * of a segment or three of a curve. The turning normal adds stiffness to the K of the contact law:
 * with sliding nearest points, the distance d has the second derivative (1/d) [ w_i w_j (I - n n')
 * - g_i' Q^-1 g_j ] between nodes i and j, where w are the weights of the touch (negative on the
 * second segment), Q the second derivatives of |r|^2/2 with respect to the places along the wires,
 * and g its mixed ones. The normal force N adds -N times that.
 *
 * Friction acts at the surfaces. An edge that turns moves its surface along itself, so node i moves
 * the surface by G_i = w_i I + slope_i lever n', with the lever of meet.h, and takes the force G_i'
 * f: a share of it and a couple across the edge. Angular momentum is kept, and wires that turn like
 * one body do not rub (spec/contact/together_spec). */
#include <string.h>

#include "mutual/meet.h"
#include "solve/band3.h"
#include "touch/load.h"

static const size_t FULL[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
static const size_t UPPER[6] = {0, 1, 2, 4, 5, 8};

enum { MOST = 2 * SW_MEAN_MOST };

/* Stiffness between the nodes of a touch, upper half: the nodes of thing one, then those of thing
 * two. */
typedef struct blocks {
  int n, from[2], count[2];
  double w[MOST];     /* shares of the distance: negative on wire two [-] */
  double slope[MOST]; /* derivatives of these by the place along their own wire [-] */
  sw_vec turn[MOST];  /* shift of the surface over the node's shift along the normal [-] */
  double k[MOST * MOST][9];
} blocks;

static double *block(blocks *b, int i, int j) { return b->k[i * b->n + j]; }

static void begin(blocks *b, const sw_meet *t) {
  const sw_bow *bow = t->bow;
  b->n = 0;
  for (int side = 0; side < 2; side++) {
    const double sign = side == 0 ? 1.0 : -1.0;
    b->from[side] = b->n, b->count[side] = (int)bow[side].spot.count;
    for (int i = 0; i < b->count[side]; i++, b->n++) {
      b->w[b->n] = sign * bow[side].spot.w[i];
      b->slope[b->n] = sign * bow[side].slope[i];
      b->turn[b->n] = sw_scale(t->lever[side], bow[side].slope[i]);
    }
  }
}

static int side_of(const blocks *b, int i) { return i >= b->from[1]; }

/* 0 for a node on which the touch has no effect: the other node of a segment touched at one
 * node. */
static int takes_part(const blocks *b, const int slides[2], int i) {
  return b->w[i] != 0 || slides[side_of(b, i)] || sw_norm2(b->turn[i]) > 0;
}

static void take_law(blocks *b, const double K[6]) {
  double full[9];
  for (int m = 0; m < 9; m++) full[m] = K[FULL[m]];
  for (int i = 0; i < b->n; i++)
    for (int j = i; j < b->n; j++)
      for (int m = 0; m < 9; m++) block(b, i, j)[m] = b->w[i] * b->w[j] * full[m];
}

static sw_vec times(const double K[6], sw_vec v) {
  return sw_v(K[0] * v.x + K[1] * v.y + K[2] * v.z, K[1] * v.x + K[3] * v.y + K[4] * v.z,
              K[2] * v.x + K[4] * v.y + K[5] * v.z);
}

/* The law's stiffness K (upper half) without that against rolling: P K P with P = I - e e'. */
static void ease(const sw_meet *t, double K[6]) {
  const sw_vec e = t->eases, k = times(K, e);
  const double twice = sw_dot(e, k);
  const double a[3] = {e.x, e.y, e.z}, b[3] = {k.x, k.y, k.z};
  for (int i = 0, m = 0; i < 3; i++)
    for (int j = i; j < 3; j++, m++) K[m] += twice * a[i] * a[j] - a[i] * b[j] - b[i] * a[j];
}

/* Adds what the turns of the edges add to G_i' K G_j. */
static void take_turns(blocks *b, const double K[6], sw_vec n) {
  sw_vec stiff[MOST];
  int turns[MOST] = {0};
  for (int i = 0; i < b->n; i++) {
    turns[i] = sw_norm2(b->turn[i]) > 0;
    stiff[i] = turns[i] ? times(K, b->turn[i]) : sw_v(0, 0, 0);
  }
  for (int i = 0; i < b->n; i++)
    for (int j = i; j < b->n; j++) {
      const sw_vec one = sw_scale(stiff[j], b->w[i]);
      if (turns[j] && b->w[i] != 0) sw_add_outer(block(b, i, j), one, n, 1.0);
      if (!turns[i]) continue;
      const double both = turns[j] ? sw_dot(b->turn[i], stiff[j]) : 0.0;
      sw_add_outer(block(b, i, j), n, sw_madd(sw_scale(stiff[i], b->w[j]), n, both), 1.0);
    }
}

/* Sliding of the places along the wires: second derivatives of half the squared distance. */
typedef struct places {
  sw_vec along[2];   /* derivative of the distance vector by each place [m] */
  double aa, bb, ab; /* [m2] */
  const int *slides;
} places;

/* Inverts these for the sliding places; the rows of the others are zero. 0: nearly parallel. */
static int invert_places(const places *p, double Q[3]) {
  const double aa = p->aa, bb = p->bb, ab = p->ab;
  Q[0] = Q[1] = Q[2] = 0;
  if (p->slides[0] && p->slides[1]) {
    const double det = aa * bb - ab * ab;
    if (!(det > 1e-3 * aa * bb)) return 0;
    Q[0] = bb / det, Q[1] = ab / det, Q[2] = aa / det;
  } else if (p->slides[0]) {
    Q[0] = 1.0 / aa;
  } else if (p->slides[1]) {
    Q[2] = 1.0 / bb;
  }
  return 1;
}

/* Adds -N times the second derivative of the distance; f = -N/d. */
static void add_turning(blocks *out, const places *at, sw_vec n, double d, double f) {
  const double P[6] = {1 - n.x * n.x, -n.x * n.y, -n.x * n.z,
                       1 - n.y * n.y, -n.y * n.z, 1 - n.z * n.z};
  const double *w = out->w;
  double Q[3];
  sw_vec g[2][MOST];
  if (!invert_places(at, Q)) return;
  for (int q = 0; q < 2; q++)
    for (int i = 0; i < out->n; i++)
      g[q][i] =
          sw_madd(sw_scale(at->along[q], w[i]), n, side_of(out, i) == q ? d * out->slope[i] : 0);
  for (int i = 0; i < out->n; i++)
    for (int j = i; j < out->n && takes_part(out, at->slides, i); j++) {
      if (!takes_part(out, at->slides, j)) continue;
      double *k = block(out, i, j);
      for (int m = 0; m < 9; m++) k[m] += f * w[i] * w[j] * P[FULL[m]];
      sw_add_outer(k, g[0][i], g[0][j], -f * Q[0]);
      sw_add_outer(k, g[1][i], g[1][j], -f * Q[2]);
      sw_add_outer(k, g[0][i], g[1][j], -f * Q[1]);
      sw_add_outer(k, g[1][i], g[0][j], -f * Q[1]);
    }
}

/* Adds the couples of friction across both edges. */
static void add_couples(sw_system *s, const sw_meet *t, sw_vec force) {
  for (int side = 0; side < 2; side++) {
    const sw_mean *at = &t->bow[side].spot;
    sw_body *body = &s->bodies[t->of.body[side]];
    const double couple = sw_dot(t->lever[side], force);
    for (uint32_t i = 0; i < at->count; i++)
      sw_accumulate(body->field.force + 3 * (at->node[i] - body->first_node),
                    sw_scale(t->press.normal, couple * t->bow[side].slope[i]));
  }
}

static void add_to_rows(sw_body *body, const sw_mean *at, blocks *b, int side) {
  const int from = b->from[side], count = b->count[side];
  for (int i = 0; i < count; i++) {
    double *row = body->field.rows + SW_ROW_SIZE * (at->node[i] - body->first_node);
    for (int m = 0; m < 6; m++) row[SW_ROW_OWN + m] += block(b, from + i, from + i)[UPPER[m]];
    for (int j = i + 1; j < count; j++)
      sw_load_couple(body, at->node[i], at->node[j], block(b, from + i, from + j));
  }
}

static sw_status link_nodes(sw_system *s, const sw_bow bow[2], const int slides[2], blocks *b) {
  for (int i = 0; i < b->from[1]; i++)
    for (int j = b->from[1]; j < b->n && takes_part(b, slides, i); j++)
      if (takes_part(b, slides, j))
        SW_TRY(sw_system_add_bridge(s, bow[0].spot.node[i], bow[1].spot.node[j - b->from[1]],
                                    block(b, i, j)));
  return SW_OK;
}

/* Normals are not reliable if axes are nearer than this share of the sum of radii [-]. */
static const double WELL_APART = 0.5;

/* The lower limit holds because the curve never bends so much that a place is not a nearest one. */
double sw_meet_rise(double along2, double bends, double firm) {
  return sw_larger(along2 * (1.0 + firm) + bends, 0.3 * along2);
}

static places places_of(const sw_meet *t, const double *y, double d) {
  const sw_vec a = sw_bow_along(y, &t->bow[0]), b = sw_bow_along(y, &t->bow[1]);
  const sw_vec n = t->press.normal;
  const double aa = sw_norm2(a), bb = sw_norm2(b);
  return (places){.along = {a, sw_neg(b)},
                  .aa = sw_meet_rise(aa, d * sw_dot(n, sw_bow_bend(y, &t->bow[0])), t->firm[0]),
                  .bb = sw_meet_rise(bb, -d * sw_dot(n, sw_bow_bend(y, &t->bow[1])), t->firm[1]),
                  .ab = sw_dot(a, b),
                  .slides = t->slides};
}

sw_status sw_meet_push(sw_system *s, const sw_meet *t, const double *y, sw_vec force,
                       const double *K) {
  sw_body *one = &s->bodies[t->of.body[0]], *two = &s->bodies[t->of.body[1]];
  blocks b;
  const int turns = sw_meet_turns(t);
  double eased[6];
  if (K && sw_norm2(t->eases) > 0) memcpy(eased, K, sizeof eased), ease(t, eased), K = eased;
  sw_load_force(one, &t->bow[0].spot, force);
  sw_load_force(two, &t->bow[1].spot, sw_neg(force));
  if (turns) add_couples(s, t, force);
  if (!K) return SW_OK;
  begin(&b, t);
  take_law(&b, K);
  if (turns) take_turns(&b, K, t->press.normal);
  const double d = t->press.gap - t->forgiven + t->reach;
  if (d > WELL_APART * t->reach && !t->barred && t->turns) {
    const places at = places_of(t, y, d);
    add_turning(&b, &at, t->press.normal, d, -t->press.lag / d);
  }
  add_to_rows(one, &t->bow[0].spot, &b, 0);
  add_to_rows(two, &t->bow[1].spot, &b, 1);
  return link_nodes(s, t->bow, t->slides, &b);
}
