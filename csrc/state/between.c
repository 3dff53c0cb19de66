/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes of a bent wire that is held near a hold that it has. Where little wire is between two
 * holds, it must fit between the places and directions of both: a new hold is put where the wire
 * comes from the other one, hinge by hinge, with the bends that it has there. */
#include <math.h>
#include <string.h>

#include "state/hinge.h"
#include "state/mesh.h"
#include "state/near.h"
#include "state/plan.h"

static sw_vec turn_over(sw_vec from, sw_vec to, double length) {
  const sw_vec turn = sw_sub(to, from);
  const double chord = sw_norm(turn);
  if (!(chord > 0)) return turn;
  return sw_scale(turn, 2.0 * asin(fmin(1.0, 0.5 * chord)) / (chord * length));
}

/* Returns the direction of the k-th edge on this side of node `from`, away from the node [-]. */
static sw_vec away(const sw_mesh *m, size_t from, int side, size_t k) {
  const size_t a = from + (size_t)side * k, b = a + (size_t)side;
  return sw_unit_or(sw_sub(sw_vec_at(m->x, b), sw_vec_at(m->x, a)), sw_v(1, 0, 0));
}

static double length_of(const sw_mesh *m, size_t from, int side, size_t k) {
  const size_t a = from + (size_t)side * k;
  return fabs(m->s[a + (size_t)side] - m->s[a]);
}

/* Edges of a gap whose two clamps have hinges of their own [-]. */
enum { LEAST_GAP = 4 };

/* Returns how long the k-th hinge on this side of a clamp at node `from` is; there are `edges`
 * edges, the last of which ends at another clamp, or goes on freely (far 0) [m]. */
static double hinge_at(const sw_mesh *m, size_t from, int side, size_t k, size_t edges, int far) {
  const size_t last = edges - 1;
  double own, next;
  if (k < 2) {
    sw_plan_clamp_lengths(length_of(m, from, side, 0), length_of(m, from, side, 1), &own, &next);
    return k ? next : own;
  }
  if (far && k >= last) {
    sw_plan_clamp_lengths(length_of(m, from, side, last), length_of(m, from, side, last - 1), &own,
                          &next);
    return k > last ? own : next;
  }
  return 0.5 * (length_of(m, from, side, k - 1) + length_of(m, from, side, k));
}

static const double STRAIGHT = 1e-9; /* rounding: change of an edge's direction [-] */

static int turns(const double *nodes, size_t count) {
  for (size_t e = 1; e + 1 < count; e++)
    if (sw_dist(sw_edge_direction(nodes, e - 1), sw_edge_direction(nodes, e)) > STRAIGHT) return 1;
  return 0;
}

int sw_mesh_read_bends(const sw_mesh *m, size_t from, int side, sw_vec director, double to,
                       const double *keep, size_t count, sw_mesh_bends *out) {
  sw_vec before = director;
  size_t edges = 0;
  const size_t room = side > 0 ? m->n - 1 - from : from;
  while (edges < room && edges < SW_MESH_BENDS) {
    if (edges > 0 && sw_mesh_is_kept(keep, count, m->s[from + (size_t)side * edges])) break;
    edges++;
  }
  out->count = edges;
  if (edges < 3 || m->drawn || (m->rest && turns(m->rest, m->n))) return 0;
  for (size_t k = 0; k < edges; k++) {
    const sw_vec next = away(m, from, side, k);
    out->s[k] = m->s[from + (size_t)side * k];
    out->bend[k] = turn_over(before, next, hinge_at(m, from, side, k, edges, 0));
    before = next;
  }
  return side * (out->s[edges - 1] - to) >= 0 &&
         turns(m->x + 3 * (side > 0 ? from : from - edges), edges + 1);
}

static sw_vec bend_at(const sw_mesh_bends *b, int side, double s) {
  size_t k = 1;
  while (k + 1 < b->count && side * (b->s[k] - s) < 0) k++;
  return sw_lerp(b->bend[k - 1], b->bend[k], (s - b->s[k - 1]) / (b->s[k] - b->s[k - 1]));
}

/* Turns a direction as a bend does over a length. */
static sw_vec bent(sw_vec u, sw_vec bend, double length) {
  const sw_vec across = sw_madd(bend, u, -sw_dot(bend, u));
  const double k = sw_norm(across);
  if (!(k > 0)) return u;
  return sw_unit_or(sw_madd(sw_scale(u, cos(k * length)), across, sin(k * length) / k), u);
}

/* The nodes from a hold to a new one, and beyond that. */
typedef struct way {
  size_t from;            /* node of the first hold's end */
  int side;               /* 1: numbers of nodes go up */
  size_t near, far, last; /* edges up to the new hold's ends, and up to the last node that moves */
  const sw_mesh_bends *bends;
  double reach; /* least length beyond the new hold that moves [m] */
} way;

static size_t node_on(const way *w, size_t k) { return w->from + (size_t)w->side * k; }

/* Returns the length over which the wire bends at the k-th node, on the side of the first hold
 * (beyond 0) or beyond it: all of it where no hold holds its direction there [m]. */
static double length_at(const sw_mesh *m, const way *w, size_t k, int beyond) {
  if (w->far == 0 && !beyond) return 0; /* there is no new hold */
  if (k < w->near) return beyond ? hinge_at(m, w->from, w->side, k, w->near, 1) : 0;
  if (k == w->near && !beyond) return hinge_at(m, w->from, w->side, k, w->near, 1);
  if (k > w->far || (k == w->far && beyond))
    return beyond ? hinge_at(m, node_on(w, w->far), w->side, k - w->far, w->last - w->far, 0) : 0;
  return 0.5 * length_of(m, w->from, w->side, beyond ? k : k - 1); /* within the new hold */
}

/* Puts the nodes of the way where the wire has these bends. u: direction away from the first hold;
 * directors: those of the new one [-]. */
static void build(const sw_mesh *m, sw_mesh *to, const way *w, sw_vec u, sw_vec directors[2]) {
  sw_vec at = sw_vec_at(m->x, w->from);
  for (size_t k = 0; k <= w->last; k++) {
    const size_t i = node_on(w, k), next = node_on(w, k + 1), e = w->side > 0 ? i : next;
    const sw_vec bend = bend_at(w->bends, w->side, m->s[i]);
    u = bent(u, bend, length_at(m, w, k, 0));
    if (k == w->near) directors[w->side < 0] = sw_scale(u, w->side);
    if (k == w->far) directors[w->side > 0] = sw_scale(u, w->side);
    if (k == w->last) return;
    u = bent(u, bend, length_at(m, w, k, 1));
    at = sw_madd(at, u, length_of(m, w->from, w->side, k) * (1.0 + m->tension[e] / m->EA));
    sw_store(to->x + 3 * next, at);
    if (!m->rest || k >= w->far) continue;
    const sw_vec was = sw_edge_direction(m->x, e), now = sw_scale(u, w->side);
    sw_store(to->normal + 3 * e, sw_carry_unit(sw_vec_at(m->normal, e), was, now));
  }
}

/* Lets the nodes beyond the new hold go over, little by little, to where they are in the mesh. */
static void go_over(const sw_mesh *m, sw_mesh *to, const way *w) {
  for (size_t k = w->far + 1; k <= w->last; k++) {
    const size_t i = node_on(w, k);
    const double x = (double)(k - w->far) / (double)(w->last - w->far);
    sw_store(to->x + 3 * i,
             sw_lerp(sw_vec_at(to->x, i), sw_vec_at(m->x, i), x * x * (3.0 - 2.0 * x)));
  }
}

/* Shifts these nodes along the wire's curvature until their chords together are as long as their
 * edges. Lengths one by one are left to sw_mesh_resample, which would bend the wire sharply beside
 * the hold to make good their sum. */
static void fit_length(sw_mesh *m, const way *w) {
  const size_t a = node_on(w, w->far), b = node_on(w, w->last), lo = a < b ? a : b;
  const size_t hi = a < b ? b : a;
  double more = 0, gain = 0;
  for (size_t e = lo; e < hi; e++)
    more += sw_dist(sw_vec_at(m->x, e), sw_vec_at(m->x, e + 1)) -
            (m->s[e + 1] - m->s[e]) * (1.0 + m->tension[e] / m->EA);
  for (int apply = 0; apply < 2; apply++)
    for (size_t i = lo + 1; i < hi; i++) {
      const double x = sin(M_PI * (m->s[i] - m->s[lo]) / (m->s[hi] - m->s[lo]));
      const sw_vec k = bend_at(w->bends, w->side, m->s[i]);
      if (!apply) gain += x * x * sw_norm2(k) * 0.5 * (m->s[i + 1] - m->s[i - 1]);
      if (apply && gain > 0) sw_accumulate(m->x + 3 * i, sw_scale(k, x * x * more / gain));
    }
}

/* Gives the edges beyond the new hold their lengths, and frames. *good: 1 if nodes stay near. */
static sw_status give_lengths(const sw_mesh *before, sw_mesh *m, const way *w, int *good) {
  const size_t a = node_on(w, w->far), b = node_on(w, w->last);
  if (a == b) return SW_OK; /* the wire ends */
  const size_t lo = a < b ? a : b, hi = a < b ? b : a;
  sw_mesh part = sw_mesh_stretch(m, lo, hi), fresh = {0};
  const sw_mesh was = sw_mesh_stretch(before, lo, hi);
  const double held[4] = {m->s[lo], m->s[lo], m->s[hi], m->s[hi]};
  SW_TRY(sw_mesh_resample(&part, part.s, part.n, held, 2, &fresh));
  *good = sw_mesh_is_near(&was, &fresh, part.n);
  sw_mesh_copy_inner(&fresh, &part);
  sw_mesh_free(&fresh);
  return SW_OK;
}

/* Nodes beyond a new hold that move with it: over so many, what does not fit is made good by a bend
 * of less than a hundredth of the wire's [-]. */
enum { FOLLOWERS = 8 };

static size_t last_of(const sw_mesh *m, const way *w, const double *keep, size_t count) {
  const size_t room = w->side > 0 ? m->n - 1 - w->from : w->from;
  size_t last = w->far;
  while (last < room) {
    const double gone = fabs(m->s[node_on(w, last)] - m->s[node_on(w, w->far)]);
    if (last >= w->far + FOLLOWERS && gone >= w->reach) break;
    last++;
    if (sw_mesh_is_kept(keep, count, m->s[node_on(w, last)])) break;
  }
  return last;
}

static void copy(double *to, const double *from, size_t count) {
  if (to) memcpy(to, from, count * sizeof *to);
}

static void take_shape(const sw_mesh *from, sw_mesh *m) {
  copy(m->x, from->x, 3 * m->n);
  copy(m->v, from->v, 3 * m->n);
  copy(m->normal, from->normal, 3 * m->n);
  copy(m->twist, from->twist, m->n);
  copy(m->turn, from->turn, m->n);
  copy(m->spin, from->spin, m->n);
}

sw_status sw_mesh_continue(sw_mesh *m, size_t from, size_t near, size_t far, sw_vec director,
                           const sw_mesh_bends *bends, const double *keep, size_t count,
                           sw_vec directors[2], int *done) {
  way w = {.from = from, .side = near > from ? 1 : -1, .bends = bends};
  w.near = w.side > 0 ? near - from : from - near, w.far = w.side > 0 ? far - from : from - far;
  w.last = last_of(m, &w, keep, count);
  sw_mesh fresh = {0};
  sw_vec now[2];
  *done = w.near >= LEAST_GAP && (w.last == w.far || w.last > w.far + 1);
  if (!*done) return SW_OK;
  SW_TRY(sw_mesh_copy(m, &fresh));
  build(m, &fresh, &w, director, now);
  go_over(m, &fresh, &w);
  fit_length(&fresh, &w);
  const sw_status status = give_lengths(m, &fresh, &w, done);
  if (status == SW_OK && *done) {
    take_shape(&fresh, m);
    memcpy(directors, now, sizeof now);
  }
  sw_mesh_free(&fresh);
  return status;
}

sw_status sw_mesh_leave(sw_mesh *m, size_t from, int side, sw_vec director,
                        const sw_mesh_bends *bends, double longest, const double *keep,
                        size_t count) {
  way w = {.from = from, .side = side, .bends = bends, .reach = FOLLOWERS * longest};
  sw_mesh fresh = {0};
  sw_vec unused[2];
  int done = 1;
  w.last = last_of(m, &w, keep, count);
  while (w.last > 2 && side * (m->s[node_on(&w, w.last)] - bends->s[bends->count - 1]) > 0)
    w.last--;
  if (w.last < 3) return SW_OK;
  SW_TRY(sw_mesh_copy(m, &fresh));
  build(m, &fresh, &w, director, unused);
  go_over(m, &fresh, &w);
  fit_length(&fresh, &w);
  const sw_status status = give_lengths(m, &fresh, &w, &done);
  if (status == SW_OK && done) take_shape(&fresh, m);
  sw_mesh_free(&fresh);
  return status;
}
