/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes of a bent wire near a hold: on its curve, and with its bend in the hinges beside a clamp.
 */
#include <math.h>
#include <string.h>

#include "state/mesh.h"
#include "state/plan.h"

/* Nodes on each side that move with a hold's node. Alone, a node that keeps the lengths of both
 * edges leaves the curve: an arc is up to 1.45 times as sharp there, 1.03 with three nodes [-]. */
enum { REACH = 3 };
static const double STRAIGHT = 1e-9; /* rounding: change of an edge's direction [-] */
/* A node beside may move by this share of an edge; a mesh where more were needed stays [-]. */
static const double FARTHEST = 0.25;

static sw_vec direction(const double *x, size_t e) {
  return sw_unit_or(sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e)), sw_v(1, 0, 0));
}

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
    if (sw_dist(direction(nodes, e - 1), direction(nodes, e)) > STRAIGHT) return 1;
  return 0;
}

static int is_bent(const sw_mesh *m, size_t lo, size_t hi) {
  return turns(m->x, lo, hi) || (m->rest && turns(m->rest, lo, hi));
}

/* Copies the mesh with the tensions that its chords have. Those of the wire differ from them by
 * what the solve leaves, which would bend a taut wire. */
static sw_status copy_chords(const sw_mesh *m, sw_mesh *to) {
  SW_TRY(sw_mesh_copy(m, to));
  for (size_t e = 0; e + 1 < m->n; e++)
    to->tension[e] =
        m->EA * (sw_dist(sw_vec_at(m->x, e + 1), sw_vec_at(m->x, e)) / (m->s[e + 1] - m->s[e]) - 1);
  return SW_OK;
}

/* 1 if no node between lo and hi, but node i, moved far. */
static int is_near(const sw_mesh *from, const sw_mesh *to, size_t lo, size_t hi, size_t i) {
  for (size_t k = lo + 1; k < hi; k++) {
    const double edge = fmin(from->s[k + 1] - from->s[k], from->s[k] - from->s[k - 1]);
    const double way = sw_dist(sw_vec_at(from->x, k), sw_vec_at(to->x, k));
    if (k != i && !(way < FARTHEST * edge)) return 0;
  }
  return 1;
}

static void copy(double *to, const double *from, size_t width, size_t first, size_t end) {
  if (to) memcpy(to + width * first, from + width * first, width * (end - first) * sizeof *to);
}

/* Copies nodes between lo and hi, and what the edges there have of frames. */
static void copy_stretch(const sw_mesh *from, sw_mesh *to, size_t lo, size_t hi) {
  copy(to->x, from->x, 3, lo + 1, hi);
  copy(to->v, from->v, 3, lo + 1, hi);
  copy(to->rest, from->rest, 3, lo + 1, hi);
  copy(to->normal, from->normal, 3, lo, hi);
  copy(to->rest_normal, from->rest_normal, 3, lo, hi);
  copy(to->twist, from->twist, 1, lo + 1, hi);
  copy(to->turn, from->turn, 1, lo, hi);
  copy(to->spin, from->spin, 1, lo, hi);
}

sw_status sw_mesh_smooth(sw_mesh *m, size_t i, const sw_mesh *before, const double *keep,
                         size_t count) {
  size_t lo, hi;
  sw_mesh chords = {0}, fresh = {0};
  find_reach(m, i, i, keep, count, &lo, &hi);
  if (!is_bent(m, lo, hi)) return SW_OK;
  const double held[4] = {m->s[0], m->s[lo], m->s[hi], m->s[m->n - 1]};
  sw_status status = copy_chords(before, &chords);
  if (status == SW_OK) status = sw_mesh_resample(&chords, m->s, m->n, held, 2, &fresh);
  if (status == SW_OK && is_near(m, &fresh, lo, hi, i)) copy_stretch(&fresh, m, lo, hi);
  sw_mesh_free(&chords);
  sw_mesh_free(&fresh);
  return status;
}

/* Returns the curvature between the middles of edges a and b, a vector [1/m]. */
static sw_vec curvature_between(const sw_mesh *m, size_t a, size_t b) {
  const double way = 0.5 * (m->s[b] + m->s[b + 1] - m->s[a] - m->s[a + 1]);
  return sw_scale(sw_sub(direction(m->x, b), direction(m->x, a)), 1.0 / way);
}

/* Returns the curvature at node i, as a mean over the edges beside it, in which hinges beside a
 * clamp and others count alike; at an end, it is extrapolated from the two nodes before. */
static sw_vec curvature_at(const sw_mesh *m, size_t i) {
  const size_t last = m->n - 2; /* edge */
  if (last < 2) return sw_v(0, 0, 0);
  if (i > 0 && i <= last) return curvature_between(m, i > 1 ? i - 2 : 0, i < last ? i + 1 : last);
  const size_t e = i ? last - 1 : 0, next = i ? last - 2 : 1; /* pairs of edges: near, far */
  const sw_vec near = curvature_between(m, e, e + 1), far = curvature_between(m, next, next + 1);
  const double way = fabs(m->s[e + 1] - m->s[i]) / fabs(m->s[next + 1] - m->s[e + 1]);
  return sw_madd(near, sw_sub(near, far), way);
}

/* Adds to *sum how far a clamp at node i must lie inside the curve through the nodes on this side.
 * Where a wire has curvature k and edges h, the hinges beside a clamp put all free nodes k h^2/12
 * further from its tangent than the axis (clamp_hinge_length in plan.c). A clamp put on the axis
 * would begin with up to four times the bend. Returns 0 if there is no wire on this side. */
static int add_offset(const sw_mesh *m, size_t i, int side, sw_vec *sum) {
  if (side > 0 ? i + 2 >= m->n : i < 2) return 0;
  const double first = side > 0 ? m->s[i + 1] - m->s[i] : m->s[i] - m->s[i - 1];
  const double second = side > 0 ? m->s[i + 2] - m->s[i + 1] : m->s[i - 1] - m->s[i - 2];
  double clamp, next;
  sw_plan_clamp_lengths(first, second, &clamp, &next);
  *sum = sw_madd(*sum, curvature_at(m, i), (0.5 * first - clamp) * first);
  return 1;
}

sw_status sw_mesh_lean(sw_mesh *m, size_t first, size_t last, int way, const double *keep,
                       size_t count) {
  size_t lo, hi;
  sw_vec sum = sw_v(0, 0, 0);
  sw_mesh chords = {0}, fresh = {0};
  find_reach(m, first, last, keep, count, &lo, &hi);
  const int sides = add_offset(m, first, -1, &sum) + add_offset(m, last, 1, &sum);
  if (!sides || m->drawn || !turns(m->x, lo, hi)) return SW_OK;
  const double held[6] = {m->s[0], m->s[lo], m->s[first], m->s[last], m->s[hi], m->s[m->n - 1]};
  sw_status status = copy_chords(m, &chords);
  for (size_t i = first; i <= last && status == SW_OK; i++)
    sw_store(chords.x + 3 * i, sw_madd(sw_vec_at(m->x, i), sum, (double)way / sides));
  if (status == SW_OK) status = sw_mesh_resample(&chords, m->s, m->n, held, 3, &fresh);
  if (status == SW_OK && is_near(m, &fresh, lo, hi, m->n)) copy(m->x, fresh.x, 3, lo, hi + 1);
  sw_mesh_free(&chords);
  sw_mesh_free(&fresh);
  return status;
}
