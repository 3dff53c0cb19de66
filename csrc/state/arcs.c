/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arcs of the path that a wire was drawn along. Its edges are chords of the path. Where the path is
 * an arc of curvature K, they are shorter than the arc by the share K^2 h^2/24. */
#include <math.h>

#include "base/alloc.h"
#include "state/mesh.h"

/* Points of the path in an edge that make an arc of it. Fewer are corners of a polygon [-]. */
enum { FEW = 2 };
enum { EVENED = 2 }; /* times that the shares are evened out [-] */
/* A path that turns by more than CORNER from edge to edge has a corner there; up to STRAIGHT it is
 * rounding [rad]. */
static const double CORNER = 0.6, STRAIGHT = 1e-9;

static sw_vec turn_at(const sw_mesh *m, size_t i) {
  return sw_sub(sw_edge_direction(m->x, i), sw_edge_direction(m->x, i - 1));
}

/* The turn at a node that belongs to an arc: that of the least of some three in a row, which turn
 * the same way. A corner of the path turns one node, or two beside each other [rad]. */
static double arc_at(const sw_mesh *m, size_t i) {
  enum { IN_ROW = 3 };
  const sw_vec here = turn_at(m, i);
  const size_t last = m->n - 2; /* the last inner node */
  double most = 0;
  for (size_t first = i < IN_ROW ? 1 : i + 1 - IN_ROW; first <= i && first + IN_ROW <= last + 1;
       first++) {
    double least = HUGE_VAL;
    for (size_t k = first; k < first + IN_ROW; k++) {
      const sw_vec turn = turn_at(m, k);
      least = fmin(least, sw_dot(turn, here) > 0 ? sw_norm(turn) : 0.0);
    }
    most = fmax(most, least);
  }
  return most < CORNER && most > STRAIGHT ? most : 0.0;
}

/* An edge is shorter than its arc by up to this factor on what the least turns nearby give: they
 * differ as the points of a path fall on edges [-]. */
static const double AT_MOST = 2.0;

/* Counts the points of the polyline inside each of so many equal parts of its length. */
static double count_points(const double *points, size_t count, size_t parts, double *inside) {
  double total = 0, at = 0;
  for (size_t k = 0; k + 1 < count; k++)
    total += sw_dist(sw_vec_at(points, k), sw_vec_at(points, k + 1));
  for (size_t k = 0; k + 1 < count && total > 0; k++) {
    if (k > 0) inside[(size_t)fmin(at / total * (double)parts, (double)parts - 1.0)] += 1;
    at += sw_dist(sw_vec_at(points, k), sw_vec_at(points, k + 1));
  }
  return total;
}

/* Makes shares from the numbers of points in each edge. Returns 0 if all are zero. */
static int find_shares(const sw_mesh *m, double total, double *shares) {
  const size_t edges = m->n - 1;
  const double path = total / (double)edges; /* its length from node to node [m] */
  int any = 0;
  for (size_t e = 0; e < edges; e++) {
    const double before = e > 0 ? arc_at(m, e) : 0.0,
                 after = e + 1 < edges ? arc_at(m, e + 1) : 0.0;
    const double turn = fmax(before, after);
    const double less = 1.0 - sw_dist(sw_vec_at(m->x, e), sw_vec_at(m->x, e + 1)) / path;
    const double most = shares[e] < FEW ? 0.0 : AT_MOST * turn * turn / 24.0;
    shares[e] = fmin(fmax(less, 0.0), most);
    any |= shares[e] > 0;
  }
  return any;
}

/* Evens out what depends on how many points of the path fall on an edge. The sum stays. */
static void smooth(double *shares, size_t edges) {
  double before = shares[0];
  for (size_t e = 0; e < edges; e++) {
    const double here = shares[e], after = e + 1 < edges ? shares[e + 1] : here;
    shares[e] = 0.25 * (before + after) + 0.5 * here;
    before = here;
  }
}

/* The mean of the shares between two places, in the path's own edges. */
static double mean_between(const double *shares, size_t edges, double from, double to) {
  enum { SAMPLES = 4 };
  double sum = 0;
  for (int q = 0; q < SAMPLES; q++) {
    const double at = from + (to - from) * (q + 0.5) / SAMPLES;
    if (at >= 0 && at < (double)edges) sum += shares[(size_t)at];
  }
  return sum / SAMPLES;
}

sw_status sw_mesh_arcs(const double *points, size_t count, size_t segments, const double *s,
                       size_t n, double length, double *shares, int *any) {
  sw_mesh path = {0};
  double *drawn SW_LOCAL = sw_alloc(segments, sizeof *drawn);
  if (!drawn) return SW_ENOMEM;
  SW_TRY(sw_mesh_along(&path, points, count, segments));
  *any = find_shares(&path, count_points(points, count, segments, drawn), drawn);
  sw_mesh_free(&path);
  for (int k = 0; *any && k < EVENED; k++) smooth(drawn, segments);
  const double scale = (double)segments / length;
  for (size_t e = 0; *any && e + 1 < n; e++)
    shares[e] = mean_between(drawn, segments, s[e] * scale, s[e + 1] * scale);
  return SW_OK;
}
