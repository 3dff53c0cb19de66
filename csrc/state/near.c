/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes of a bent wire near a hold: on its curve, and with its bend in the hinges beside a clamp.
 */
#include <math.h>
#include <string.h>

#include "state/hinge.h"
#include "state/mesh.h"
#include "state/plan.h"

/* Nodes on each side that move with a hold's node. Alone, a node that keeps the lengths of both
 * edges leaves the curve: an arc is up to 1.45 times as sharp there, 1.03 with three nodes [-]. */
enum { REACH = 3 };
static const double STRAIGHT = 1e-9; /* rounding: change of an edge's direction [-] */
/* A node beside may move by this share of an edge; a mesh where more were needed stays [-]. */
static const double FARTHEST = 0.25;

/* Finds the stretch around nodes first to last that may move: lo and hi stay. */
static void find_reach(const sw_mesh *m, size_t first, size_t last, const double *keep,
                       size_t count, size_t *lo, size_t *hi) {
  *lo = first > REACH ? first - REACH : 0;
  *hi = last + REACH < m->n ? last + REACH : m->n - 1;
  for (size_t k = 0; k < count; k++)
    for (size_t j = *lo; j <= *hi; j++) {
      if (m->s[j] != keep[k]) continue;
      if (j < first) *lo = j;
      if (j > last) *hi = j;
    }
}

static int turns(const double *nodes, size_t lo, size_t hi) {
  for (size_t e = lo + 1; e < hi; e++)
    if (sw_dist(sw_edge_direction(nodes, e - 1), sw_edge_direction(nodes, e)) > STRAIGHT) return 1;
  return 0;
}

static int is_bent(const sw_mesh *m, size_t lo, size_t hi) {
  return turns(m->x, lo, hi) || (m->rest && turns(m->rest, lo, hi));
}

int sw_mesh_is_bent_near(const sw_mesh *m, size_t i) {
  size_t lo, hi;
  find_reach(m, i, i, NULL, 0, &lo, &hi);
  return is_bent(m, lo, hi);
}

/* Returns nodes lo to hi of a mesh, in the mesh's own arrays. */
static sw_mesh stretch_of(const sw_mesh *m, size_t lo, size_t hi) {
  sw_mesh part = *m;
  part.n = hi - lo + 1;
  part.s += lo, part.tension += lo, part.rate += lo;
  part.x += 3 * lo, part.v += 3 * lo, part.a += 3 * lo;
  if (!m->rest) return part;
  part.rest += 3 * lo, part.normal += 3 * lo, part.rest_normal += 3 * lo;
  part.twist += lo, part.turn += lo, part.spin += lo;
  return part;
}

/* Copies the mesh with the tensions of its chords. Those of the wire differ from them by the
 * solve's remaining error, which would bend a taut wire. */
static sw_status copy_chords(const sw_mesh *m, sw_mesh *to) {
  SW_TRY(sw_mesh_copy(m, to));
  for (size_t e = 0; e + 1 < m->n; e++)
    to->tension[e] =
        m->EA * (sw_dist(sw_vec_at(m->x, e + 1), sw_vec_at(m->x, e)) / (m->s[e + 1] - m->s[e]) - 1);
  return SW_OK;
}

/* 1 if no inner node, but node i, moved far. */
static int is_near(const sw_mesh *from, const sw_mesh *to, size_t i) {
  for (size_t k = 1; k + 1 < from->n; k++) {
    const double edge = fmin(from->s[k + 1] - from->s[k], from->s[k] - from->s[k - 1]);
    const double way = sw_dist(sw_vec_at(from->x, k), sw_vec_at(to->x, k));
    if (k != i && !(way < FARTHEST * edge)) return 0;
  }
  return 1;
}

static void copy(double *to, const double *from, size_t width, size_t first, size_t end) {
  if (to) memcpy(to + width * first, from + width * first, width * (end - first) * sizeof *to);
}

/* Copies inner nodes, and the frames of edges. */
static void copy_inner(const sw_mesh *from, sw_mesh *to) {
  const size_t last = to->n - 1;
  copy(to->x, from->x, 3, 1, last);
  copy(to->v, from->v, 3, 1, last);
  copy(to->rest, from->rest, 3, 1, last);
  copy(to->normal, from->normal, 3, 0, last);
  copy(to->rest_normal, from->rest_normal, 3, 0, last);
  copy(to->twist, from->twist, 1, 1, last);
  copy(to->turn, from->turn, 1, 0, last);
  copy(to->spin, from->spin, 1, 0, last);
}

/* Puts the nodes between lo and hi on the curve through the nodes before. i: the node that may go
 * far, or none. */
static sw_status put_on_curve(sw_mesh *m, size_t lo, size_t hi, size_t i, const sw_mesh *before) {
  sw_mesh part = stretch_of(m, lo, hi), chords = {0}, fresh = {0};
  if (!is_bent(m, lo, hi)) return SW_OK;
  const sw_mesh was =
      stretch_of(before, sw_mesh_node(before, m->s[lo]), sw_mesh_node(before, m->s[hi]));
  const double held[4] = {m->s[lo], m->s[lo], m->s[hi], m->s[hi]};
  sw_status status = copy_chords(&was, &chords);
  if (status == SW_OK) status = sw_mesh_resample(&chords, part.s, part.n, held, 2, &fresh);
  if (status == SW_OK && is_near(&part, &fresh, i - lo)) copy_inner(&fresh, &part);
  sw_mesh_free(&chords);
  sw_mesh_free(&fresh);
  return status;
}

sw_status sw_mesh_smooth(sw_mesh *m, size_t i, const sw_mesh *before, const double *keep,
                         size_t count) {
  size_t lo, hi;
  find_reach(m, i, i, keep, count, &lo, &hi);
  return put_on_curve(m, lo, hi, i, before);
}

/* 1 if s is one of the arc lengths to keep (count) [m]. */
static int is_kept(const double *keep, size_t count, double s) {
  for (size_t k = 0; k < count; k++)
    if (keep[k] == s) return 1;
  return 0;
}

/* The chord of a long edge is longer than that of its halves on the curve, so that nodes beyond its
 * ends have to move with it: at least at one of them. */
sw_status sw_mesh_halve(sw_mesh *m, double low, double high, const double *keep, size_t count) {
  sw_mesh before = {0};
  size_t lo, hi, none;
  SW_TRY(sw_mesh_copy(m, &before));
  sw_status status = SW_OK;
  for (size_t e = sw_mesh_node(m, high); e-- > sw_mesh_node(m, low) && status == SW_OK;)
    status = sw_mesh_insert(m, e, 0.5 * (m->s[e] + m->s[e + 1]));
  const size_t first = sw_mesh_node(m, low), last = sw_mesh_node(m, high);
  find_reach(m, first, first, keep, count, &lo, &none);
  find_reach(m, last, last, keep, count, &none, &hi);
  if (is_kept(keep, count, low)) lo = first;
  if (is_kept(keep, count, high)) hi = last;
  if (status == SW_OK && (m->rest || !m->drawn)) status = put_on_curve(m, lo, hi, m->n, &before);
  sw_mesh_free(&before);
  return status;
}

/* Returns the curvature of a curve through nodes between the middles of edges a and b, a vector
 * [1/m]. */
static sw_vec curvature_between(const sw_mesh *m, const double *nodes, size_t a, size_t b) {
  const sw_vec turn = sw_sub(sw_edge_direction(nodes, b), sw_edge_direction(nodes, a));
  return sw_scale(turn, 1.0 / (sw_mesh_middle(m, b) - sw_mesh_middle(m, a)));
}

/* Returns the same at node i, as a mean over the edges beside it, in which hinges beside a clamp
 * and others count alike; at an end, it is extrapolated from the five edges there. */
static sw_vec curvature_at(const sw_mesh *m, const double *nodes, size_t i) {
  const size_t last = m->n - 2; /* edge */
  if (last < 4) return sw_v(0, 0, 0);
  if (i > 0 && i <= last)
    return curvature_between(m, nodes, i > 1 ? i - 2 : 0, i < last ? i + 1 : last);
  const size_t end = i ? last : 0, two = i ? last - 2 : 2, four = i ? last - 4 : 4;
  const sw_vec near = curvature_between(m, nodes, i ? two : end, i ? end : two);
  const sw_vec far = curvature_between(m, nodes, i ? four : two, i ? two : four);
  const double at = 0.5 * (sw_mesh_middle(m, end) + sw_mesh_middle(m, two));
  const double way =
      fabs((at - m->s[i]) / (0.5 * (sw_mesh_middle(m, two) + sw_mesh_middle(m, four)) - at));
  return sw_madd(near, sw_sub(near, far), way);
}

/* Returns the wire's curvature at node i minus that of the unloaded wire [1/m]. */
static sw_vec flexure_at(const sw_mesh *m, size_t i) {
  const sw_vec now = curvature_at(m, m->x, i);
  if (!m->rest) return now;
  const size_t e = i + 1 < m->n ? i : i - 1;
  const sw_vec k = curvature_at(m, m->rest, i), a = sw_vec_at(m->rest_normal, e);
  const sw_vec n = sw_vec_at(m->normal, e);
  const double one = sw_dot(k, a), two = sw_dot(k, sw_cross(sw_edge_direction(m->rest, e), a));
  return sw_sub(now, sw_madd(sw_scale(n, one), sw_cross(sw_edge_direction(m->x, e), n), two));
}

/* Adds to *sum how far a clamp at node i must lie inside the curve through the nodes on this side,
 * times a weight, and the weight to *weights. Where a wire has curvature k and edges h, the hinges
 * beside a clamp put all free nodes k h^2/12 further from its tangent than the axis
 * (clamp_hinge_length in plan.c). A clamp put on the axis would begin with up to four times the
 * bend. The weight is that of least squares for the bends of both sides: short edges count more. */
static void add_offset(const sw_mesh *m, size_t i, int side, sw_vec *sum, double *weights) {
  if (side > 0 ? i + 2 >= m->n : i < 2) return;
  const double first = side > 0 ? m->s[i + 1] - m->s[i] : m->s[i] - m->s[i - 1];
  const double second = side > 0 ? m->s[i + 2] - m->s[i + 1] : m->s[i - 1] - m->s[i - 2];
  double clamp, next;
  sw_plan_clamp_lengths(first, second, &clamp, &next);
  const double weight = 1.0 / (first * clamp * first * clamp);
  *sum = sw_madd(*sum, flexure_at(m, i), weight * (0.5 * first - clamp) * first);
  *weights += weight;
}

/* Shifts nodes first to last; frames follow the edges beside them. */
static void shift(const sw_mesh *m, sw_mesh *to, size_t first, size_t last, sw_vec by) {
  for (size_t i = first; i <= last; i++) sw_store(to->x + 3 * i, sw_add(sw_vec_at(m->x, i), by));
  for (size_t k = 0; k < 2 && m->rest; k++) {
    const size_t e = k ? last : first - 1; /* first = 0: there is none */
    if (e + 1 >= m->n) continue;
    const sw_vec was = sw_edge_direction(m->x, e), now = sw_edge_direction(to->x, e);
    sw_store(to->normal + 3 * e, sw_carry_unit(sw_vec_at(m->normal, e), was, now));
  }
}

sw_status sw_mesh_lean(sw_mesh *m, size_t first, size_t last, int way, const double *keep,
                       size_t count) {
  size_t lo, hi;
  double weights = 0;
  sw_vec sum = sw_v(0, 0, 0);
  sw_mesh chords = {0}, fresh = {0};
  find_reach(m, first, last, keep, count, &lo, &hi);
  add_offset(m, first, -1, &sum, &weights);
  add_offset(m, last, 1, &sum, &weights);
  if (!(weights > 0) || m->drawn || !is_bent(m, lo, hi)) return SW_OK;
  sw_mesh part = stretch_of(m, lo, hi);
  const double held[6] = {m->s[lo], m->s[lo], m->s[first], m->s[last], m->s[hi], m->s[hi]};
  sw_status status = copy_chords(&part, &chords);
  if (status == SW_OK) shift(&part, &chords, first - lo, last - lo, sw_scale(sum, way / weights));
  if (status == SW_OK) status = sw_mesh_resample(&chords, part.s, part.n, held, 3, &fresh);
  if (status == SW_OK && is_near(&part, &fresh, part.n)) {
    copy_inner(&fresh, &part);
    copy(part.x, fresh.x, 3, 0, part.n); /* its ends too, where they are the wire's */
  }
  sw_mesh_free(&chords);
  sw_mesh_free(&fresh);
  return status;
}
