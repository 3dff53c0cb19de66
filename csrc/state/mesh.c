/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "state/mesh.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

static sw_status reserve(sw_mesh *m, size_t need) {
  if (need <= m->capacity) return SW_OK;
  const size_t capacity = need + need / 8 + 8;
  double *s = sw_alloc(capacity, sizeof *s), *x = sw_alloc(3 * capacity, sizeof *x);
  double *v = sw_alloc(3 * capacity, sizeof *v), *t = sw_alloc(capacity, sizeof *t);
  if (!s || !x || !v || !t) {
    sw_free(s), sw_free(x), sw_free(v), sw_free(t);
    return SW_ENOMEM;
  }
  if (m->n) {
    memcpy(s, m->s, m->n * sizeof *s);
    memcpy(x, m->x, 3 * m->n * sizeof *x);
    memcpy(v, m->v, 3 * m->n * sizeof *v);
    memcpy(t, m->tension, m->n * sizeof *t);
  }
  sw_free(m->s), sw_free(m->x), sw_free(m->v), sw_free(m->tension);
  m->s = s, m->x = x, m->v = v, m->tension = t;
  m->capacity = capacity;
  return SW_OK;
}

void sw_mesh_free(sw_mesh *m) {
  sw_free(m->s), sw_free(m->x), sw_free(m->v), sw_free(m->tension);
  memset(m, 0, sizeof *m);
}

sw_status sw_mesh_along(sw_mesh *m, const double *points, size_t count, size_t segments) {
  memset(m, 0, sizeof *m);
  SW_TRY(reserve(m, segments + 1));
  double total = 0;
  for (size_t k = 0; k + 1 < count; k++)
    total += sw_dist(sw_load(points + 3 * k), sw_load(points + 3 * k + 3));
  m->n = segments + 1;
  size_t k = 0;
  double before = 0, span = sw_dist(sw_load(points), sw_load(points + 3));
  for (size_t i = 0; i <= segments; i++) {
    const double at = total * (double)i / (double)segments;
    while (k + 2 < count && at > before + span) {
      before += span;
      k++;
      span = sw_dist(sw_load(points + 3 * k), sw_load(points + 3 * k + 3));
    }
    const double f = span > 0 ? fmin(1.0, (at - before) / span) : 0.0;
    sw_store(m->x + 3 * i, sw_lerp(sw_load(points + 3 * k), sw_load(points + 3 * k + 3), f));
  }
  sw_store(m->x + 3 * segments, sw_load(points + 3 * (count - 1)));
  for (size_t i = 0; i < segments; i++) /* chords: the wire is unstressed as drawn */
    m->s[i + 1] = m->s[i] + sw_dist(sw_load(m->x + 3 * i), sw_load(m->x + 3 * i + 3));
  return SW_OK;
}

size_t sw_mesh_node(const sw_mesh *m, double s) {
  size_t low = 0, high = m->n - 1;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (m->s[middle] < s) low = middle + 1;
    else high = middle;
  }
  return low;
}

sw_vec sw_mesh_tangent(const sw_mesh *m, size_t i) {
  const sw_vec x = sw_vec_at(m->x, i), fallback = sw_v(1, 0, 0);
  if (m->n == 2) return sw_unit_or(sw_sub(sw_vec_at(m->x, 1), sw_vec_at(m->x, 0)), fallback);
  if (i == 0 || i == m->n - 1) { /* straight on from the two last edges */
    const size_t j = i == 0 ? 1 : i - 1, k = i == 0 ? 2 : i - 2;
    const double sign = i == 0 ? 1.0 : -1.0;
    const double l1 = fabs(m->s[j] - m->s[i]), l2 = fabs(m->s[k] - m->s[j]);
    const sw_vec t1 = sw_scale(sw_unit_or(sw_sub(sw_vec_at(m->x, j), x), fallback), sign);
    const sw_vec t2 = sw_scale(
        sw_unit_or(sw_sub(sw_vec_at(m->x, k), sw_vec_at(m->x, j)), fallback), sign);
    return sw_unit_or(sw_madd(t1, sw_sub(t1, t2), l1 / (l1 + l2)), t1);
  }
  const double l1 = m->s[i] - m->s[i - 1], l2 = m->s[i + 1] - m->s[i];
  const sw_vec t1 = sw_unit_or(sw_sub(x, sw_vec_at(m->x, i - 1)), fallback);
  const sw_vec t2 = sw_unit_or(sw_sub(sw_vec_at(m->x, i + 1), x), fallback);
  return sw_unit_or(sw_add(sw_scale(t1, l2), sw_scale(t2, l1)), t1);
}

sw_vec sw_mesh_tangent_at(const sw_mesh *m, double s) {
  const size_t i = sw_mesh_node(m, s);
  if (i == 0 || m->s[i] <= s) return sw_mesh_tangent(m, i);
  const sw_vec a = sw_mesh_tangent(m, i - 1), b = sw_mesh_tangent(m, i);
  return sw_unit_or(sw_lerp(a, b, (s - m->s[i - 1]) / (m->s[i] - m->s[i - 1])), a);
}

/* Chord of an edge of rest length l under its tension. */
static double chord(const sw_mesh *m, size_t edge, double l) {
  return l * (1.0 + m->tension[edge] / m->EA);
}

/* Move node i to arc length s keeping both edges' strains: the node goes to the
 * point of its bending plane at the right distances from its neighbours. */
static void move_node(sw_mesh *m, size_t i, double s) {
  const sw_vec a = sw_vec_at(m->x, i - 1), b = sw_vec_at(m->x, i), c = sw_vec_at(m->x, i + 1);
  const double la = chord(m, i - 1, s - m->s[i - 1]), lc = chord(m, i, m->s[i + 1] - s);
  const sw_vec ac = sw_sub(c, a);
  const double d = sw_norm(ac);
  const sw_vec t = sw_unit_or(ac, sw_v(1, 0, 0));
  const sw_vec ab = sw_sub(b, a);
  const sw_vec across = sw_unit_or(sw_madd(ab, t, -sw_dot(ab, t)), sw_perpendicular(t));
  const double along = d > 0 ? (d * d + la * la - lc * lc) / (2.0 * d) : 0.0;
  const double height = sqrt(fmax(0.0, la * la - along * along));
  const double share = (s - m->s[i]) / (s > m->s[i] ? m->s[i + 1] - m->s[i] : m->s[i] - m->s[i - 1]);
  const sw_vec vi = sw_vec_at(m->v, i);
  const sw_vec vj = sw_vec_at(m->v, share > 0 ? i + 1 : i - 1);
  sw_store(m->v + 3 * i, sw_lerp(vi, vj, fabs(share)));
  sw_store(m->x + 3 * i, sw_madd(sw_madd(a, t, along), across, height));
  m->s[i] = s;
}

static sw_status insert_node(sw_mesh *m, size_t edge, double s) {
  SW_TRY(reserve(m, m->n + 1));
  const size_t i = edge + 1, tail = m->n - i;
  const double f = (s - m->s[edge]) / (m->s[i] - m->s[edge]);
  const sw_vec x = sw_lerp(sw_vec_at(m->x, edge), sw_vec_at(m->x, i), f);
  const sw_vec v = sw_lerp(sw_vec_at(m->v, edge), sw_vec_at(m->v, i), f);
  memmove(m->s + i + 1, m->s + i, tail * sizeof *m->s);
  memmove(m->x + 3 * i + 3, m->x + 3 * i, 3 * tail * sizeof *m->x);
  memmove(m->v + 3 * i + 3, m->v + 3 * i, 3 * tail * sizeof *m->v);
  memmove(m->tension + i + 1, m->tension + i, tail * sizeof *m->tension);
  m->s[i] = s;
  m->tension[i] = m->tension[edge];
  sw_store(m->x + 3 * i, x);
  sw_store(m->v + 3 * i, v);
  m->n++;
  return SW_OK;
}

static int may_move(const sw_mesh *m, size_t i, double s, const double *keep, size_t count) {
  if (i == 0 || i == m->n - 1) return 0;
  for (size_t k = 0; k < count; k++)
    if (keep[k] == m->s[i]) return 0;
  const double l = m->s[i + 1] - m->s[i - 1];
  const double share = (s - m->s[i - 1]) / l;
  return share > 0.22 && share < 0.78; /* first edges stay within b = 0.45 .. 1.55 */
}

sw_status sw_mesh_place(sw_mesh *m, double s, const double *keep, size_t keep_count,
                        double *placed) {
  const double total = m->s[m->n - 1];
  const double same = 1e-9 * total; /* closer is the same node [m] */
  size_t i = sw_mesh_node(m, s);
  if (i > 0 && s - m->s[i - 1] < m->s[i] - s) i--;
  if (fabs(m->s[i] - s) <= same) {
    *placed = m->s[i];
    return SW_OK;
  }
  *placed = s;
  if (may_move(m, i, s, keep, keep_count)) {
    move_node(m, i, s);
    return SW_OK;
  }
  return insert_node(m, m->s[i] < s ? i : i - 1, s);
}
