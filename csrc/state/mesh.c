/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire's nodes: copies, tangents, frames, and moving, adding and removing nodes. */
#include "state/mesh.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/halving.h"
#include "state/hinge.h"

enum { ARRAYS = 12, PLAIN = 6 }; /* the arrays after the plain ones exist only with frames */

/* Lists the arrays and their doubles per node. */
static void arrays(sw_mesh *m, double **out[ARRAYS], size_t width[ARRAYS]) {
  double **const all[ARRAYS] = {&m->s,           &m->tension, &m->rate, &m->x,
                                &m->v,           &m->a,       &m->rest, &m->normal,
                                &m->rest_normal, &m->twist,   &m->turn, &m->spin};
  static const size_t widths[ARRAYS] = {1, 1, 1, 3, 3, 3, 3, 3, 3, 1, 1, 1};
  memcpy(out, all, sizeof all);
  memcpy(width, widths, sizeof widths);
}

/* Makes room for need nodes in the first count arrays and keeps their contents. */
static sw_status make_room(sw_mesh *m, size_t need, size_t count) {
  double **at[ARRAYS], *more[ARRAYS] = {NULL};
  size_t width[ARRAYS];
  int good = 1;
  arrays(m, at, width);
  for (size_t k = 0; k < count; k++) {
    more[k] = sw_alloc(width[k] * need, sizeof(double));
    good &= more[k] != NULL;
  }
  for (size_t k = 0; k < count; k++) {
    if (good && *at[k] && m->n) memcpy(more[k], *at[k], width[k] * m->n * sizeof(double));
    sw_free(good ? *at[k] : more[k]);
    if (good) *at[k] = more[k];
  }
  if (good) m->capacity = need;
  return good ? SW_OK : SW_ENOMEM;
}

static sw_status reserve(sw_mesh *m, size_t need) {
  if (need <= m->capacity) return SW_OK;
  return make_room(m, need + need / 8 + 8, m->rest ? ARRAYS : PLAIN);
}

void sw_mesh_free(sw_mesh *m) {
  double **at[ARRAYS];
  size_t width[ARRAYS];
  arrays(m, at, width);
  for (size_t k = 0; k < ARRAYS; k++) sw_free(*at[k]);
  memset(m, 0, sizeof *m);
}

sw_status sw_mesh_like(const sw_mesh *other, size_t n, sw_mesh *to) {
  sw_mesh copy = *other; /* its arrays are replaced by empty ones */
  double **at[ARRAYS];
  size_t width[ARRAYS];
  arrays(&copy, at, width);
  for (size_t k = 0; k < ARRAYS; k++) *at[k] = NULL;
  *to = (sw_mesh){0};
  SW_TRY(make_room(&copy, n, other->rest ? ARRAYS : PLAIN));
  copy.n = n;
  *to = copy;
  return SW_OK;
}

sw_status sw_mesh_copy(const sw_mesh *from, sw_mesh *to) {
  double **source[ARRAYS], **at[ARRAYS];
  size_t width[ARRAYS];
  sw_mesh keep = *from;
  SW_TRY(sw_mesh_like(from, from->n, to));
  arrays(&keep, source, width);
  arrays(to, at, width);
  for (size_t k = 0; k < ARRAYS; k++)
    if (*at[k]) memcpy(*at[k], *source[k], width[k] * from->n * sizeof(double));
  return SW_OK;
}

sw_status sw_mesh_along(sw_mesh *m, const double *points, size_t count, size_t segments) {
  memset(m, 0, sizeof *m);
  SW_TRY(reserve(m, segments + 1));
  double total = 0;
  for (size_t k = 0; k + 1 < count; k++)
    total += sw_dist(sw_load(points + 3 * k), sw_load(points + 3 * k + 3));
  m->n = segments + 1;
  m->drawn = 1, m->scale = 1;
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
  m->spacing = m->s[segments] / (double)segments;
  return SW_OK;
}

size_t sw_mesh_node(const sw_mesh *m, double s) {
  size_t i;
  SW_FIRST_NOT(m->s[i] < s, i, 0, m->n - 1);
  return i;
}

static sw_vec tangent_of(const sw_mesh *m, const double *nodes, size_t i) {
  const sw_vec x = sw_vec_at(nodes, i), fallback = sw_v(1, 0, 0);
  if (m->n == 2) return sw_unit_or(sw_sub(sw_vec_at(nodes, 1), sw_vec_at(nodes, 0)), fallback);
  if (i == 0 || i == m->n - 1) { /* extrapolated from the two last edges */
    const size_t j = i == 0 ? 1 : i - 1, k = i == 0 ? 2 : i - 2;
    const double sign = i == 0 ? 1.0 : -1.0;
    const double l1 = fabs(m->s[j] - m->s[i]), l2 = fabs(m->s[k] - m->s[j]);
    const sw_vec t1 = sw_scale(sw_unit_or(sw_sub(sw_vec_at(nodes, j), x), fallback), sign);
    const sw_vec t2 =
        sw_scale(sw_unit_or(sw_sub(sw_vec_at(nodes, k), sw_vec_at(nodes, j)), fallback), sign);
    return sw_unit_or(sw_madd(t1, sw_sub(t1, t2), l1 / (l1 + l2)), t1);
  }
  const double l1 = m->s[i] - m->s[i - 1], l2 = m->s[i + 1] - m->s[i];
  const sw_vec t1 = sw_unit_or(sw_sub(x, sw_vec_at(nodes, i - 1)), fallback);
  const sw_vec t2 = sw_unit_or(sw_sub(sw_vec_at(nodes, i + 1), x), fallback);
  return sw_unit_or(sw_add(sw_scale(t1, l2), sw_scale(t2, l1)), t1);
}

sw_vec sw_mesh_tangent(const sw_mesh *m, size_t i) { return tangent_of(m, m->x, i); }

static sw_vec tangent_between(const sw_mesh *m, const double *nodes, double s) {
  const size_t i = sw_mesh_node(m, s);
  if (i == 0 || m->s[i] <= s) return tangent_of(m, nodes, i);
  const sw_vec a = tangent_of(m, nodes, i - 1), b = tangent_of(m, nodes, i);
  return sw_unit_or(sw_lerp(a, b, (s - m->s[i - 1]) / (m->s[i] - m->s[i - 1])), a);
}

sw_vec sw_mesh_tangent_at(const sw_mesh *m, double s) { return tangent_between(m, m->x, s); }

/* --- frames ------------------------------------------------------------------- */

static sw_vec turned_about(sw_vec n, sw_vec t, double angle) {
  return sw_add(sw_scale(n, cos(angle)), sw_scale(sw_cross(t, n), sin(angle)));
}

/* Makes frames without twist along the nodes; normal: at the first edge. */
static void frames_along(const double *nodes, size_t n, sw_vec normal, double *out) {
  sw_vec before = sw_edge_direction(nodes, 0);
  sw_vec m = sw_unit_or(sw_madd(normal, before, -sw_dot(normal, before)), sw_perpendicular(before));
  for (size_t e = 0; e + 1 < n; e++) {
    const sw_vec t = sw_edge_direction(nodes, e);
    m = sw_carry_unit(m, before, t);
    sw_store(out + 3 * e, m);
    before = t;
  }
}

sw_status sw_mesh_add_frames(sw_mesh *m, sw_vec normal, int straight, double rest_twist) {
  SW_TRY(make_room(m, m->capacity, ARRAYS));
  const sw_vec along = sw_edge_direction(m->x, 0);
  for (size_t i = 0; i < m->n; i++)
    sw_store(m->rest + 3 * i, straight ? sw_scale(along, m->s[i]) : sw_vec_at(m->x, i));
  frames_along(m->x, m->n, normal, m->normal);
  frames_along(m->rest, m->n, normal, m->rest_normal);
  for (size_t e = 0; rest_twist != 0 && e + 1 < m->n; e++)
    sw_store(m->rest_normal + 3 * e,
             turned_about(sw_vec_at(m->rest_normal, e), sw_edge_direction(m->rest, e),
                          rest_twist * sw_mesh_middle(m, e)));
  return SW_OK;
}

/* Returns the normal at arc length s. The twist varies linearly between the edges' middles, and is
 * extrapolated to the ends. */
static sw_vec normal_at(const sw_mesh *m, const double *nodes, const double *normals, double s,
                        sw_vec tangent) {
  const size_t i = sw_mesh_node(m, s), last = m->n - 2;
  size_t e = i > 0 ? i - 1 : 0;
  if (e > 0 && s < sw_mesh_middle(m, e)) e--;
  if (e == last && e > 0) e--;
  const sw_edge_frame a = {sw_edge_direction(nodes, e), sw_vec_at(normals, e)};
  const sw_vec n = sw_carry_unit(a.m1, a.t, tangent);
  if (last == 0) return n;
  const sw_edge_frame b = {sw_edge_direction(nodes, e + 1), sw_vec_at(normals, e + 1)};
  const double share =
      (s - sw_mesh_middle(m, e)) / (sw_mesh_middle(m, e + 1) - sw_mesh_middle(m, e));
  return turned_about(n, tangent, share * sw_hinge_twist(&a, &b, 0.0));
}

sw_mesh_frame sw_mesh_frame_at(const sw_mesh *m, double s) {
  sw_mesh_frame f = {.tangent = tangent_between(m, m->x, s),
                     .rest_tangent = tangent_between(m, m->rest, s)};
  f.normal = normal_at(m, m->x, m->normal, s, f.tangent);
  f.rest_normal = normal_at(m, m->rest, m->rest_normal, s, f.rest_tangent);
  return f;
}

/* --- editing ------------------------------------------------------------------ */

/* Returns the chord of an edge of rest length l under its tension. */
static double chord(const sw_mesh *m, size_t edge, double l) {
  return l * (1.0 + m->tension[edge] / m->EA);
}

/* Moves node i, in its bending plane, to distances la and lc from its neighbours; normals (may be
 * NULL) follow the edges. */
static void bend_node(double *nodes, double *normals, size_t i, double la, double lc) {
  const sw_vec a = sw_vec_at(nodes, i - 1), b = sw_vec_at(nodes, i), c = sw_vec_at(nodes, i + 1);
  const sw_vec before[2] = {sw_edge_direction(nodes, i - 1), sw_edge_direction(nodes, i)};
  const sw_vec ac = sw_sub(c, a);
  const double d = sw_norm(ac);
  const sw_vec t = sw_unit_or(ac, sw_v(1, 0, 0));
  const sw_vec ab = sw_sub(b, a);
  const sw_vec across = sw_unit_or(sw_madd(ab, t, -sw_dot(ab, t)), sw_perpendicular(t));
  const double along = d > 0 ? (d * d + la * la - lc * lc) / (2.0 * d) : 0.0;
  const double height = sqrt(fmax(0.0, la * la - along * along));
  sw_store(nodes + 3 * i, sw_madd(sw_madd(a, t, along), across, height));
  for (size_t k = 0; normals && k < 2; k++) {
    double *normal = normals + 3 * (i - 1 + k);
    sw_store(normal,
             sw_carry_unit(sw_load(normal), before[k], sw_edge_direction(nodes, i - 1 + k)));
  }
}

/* Moves node i to arc length s, keeping both edges' strains. */
static void move_node(sw_mesh *m, size_t i, double s) {
  const double rest_a = s - m->s[i - 1], rest_c = m->s[i + 1] - s;
  bend_node(m->x, m->normal, i, chord(m, i - 1, rest_a), chord(m, i, rest_c));
  if (m->rest) bend_node(m->rest, m->rest_normal, i, rest_a, rest_c);
  const double share =
      (s - m->s[i]) / (s > m->s[i] ? m->s[i + 1] - m->s[i] : m->s[i] - m->s[i - 1]);
  const sw_vec vi = sw_vec_at(m->v, i);
  const sw_vec vj = sw_vec_at(m->v, share > 0 ? i + 1 : i - 1);
  sw_store(m->v + 3 * i, sw_lerp(vi, vj, fabs(share)));
  m->s[i] = s;
}

sw_status sw_mesh_insert(sw_mesh *m, size_t edge, double s) {
  double **at[ARRAYS];
  size_t width[ARRAYS];
  SW_TRY(reserve(m, m->n + 1));
  arrays(m, at, width);
  const size_t i = edge + 1, tail = m->n - i;
  const double f = (s - m->s[edge]) / (m->s[i] - m->s[edge]);
  const sw_vec x = sw_lerp(sw_vec_at(m->x, edge), sw_vec_at(m->x, i), f);
  const sw_vec v = sw_lerp(sw_vec_at(m->v, edge), sw_vec_at(m->v, i), f);
  const sw_vec a = sw_lerp(sw_vec_at(m->a, edge), sw_vec_at(m->a, i), f);
  const sw_vec rest =
      m->rest ? sw_lerp(sw_vec_at(m->rest, edge), sw_vec_at(m->rest, i), f) : sw_v(0, 0, 0);
  for (size_t k = 0; k < ARRAYS; k++)
    if (*at[k])
      memmove(*at[k] + width[k] * (i + 1), *at[k] + width[k] * i, width[k] * tail * sizeof(double));
  m->s[i] = s;
  m->tension[i] = m->tension[edge];
  m->rate[i] = m->rate[edge];
  sw_store(m->x + 3 * i, x);
  sw_store(m->v + 3 * i, v);
  sw_store(m->a + 3 * i, a);
  if (m->rest) {
    sw_store(m->rest + 3 * i, rest);
    memcpy(m->normal + 3 * i, m->normal + 3 * edge, 3 * sizeof(double));
    memcpy(m->rest_normal + 3 * i, m->rest_normal + 3 * edge, 3 * sizeof(double));
    m->twist[i] = 0;
    m->turn[i] = m->turn[edge], m->spin[i] = m->spin[edge];
  }
  m->n++;
  return SW_OK;
}

/* Puts the unit mean of vectors i - 1 and i, with weights a and b, at i - 1. */
static void merge_units(double *list, size_t i, double a, double b) {
  const sw_vec u = sw_vec_at(list, i - 1), v = sw_vec_at(list, i);
  sw_store(list + 3 * (i - 1), sw_unit_or(sw_add(sw_scale(u, a), sw_scale(v, b)), u));
}

void sw_mesh_remove(sw_mesh *m, size_t i) {
  double **at[ARRAYS];
  size_t width[ARRAYS];
  const double a = m->s[i] - m->s[i - 1], b = m->s[i + 1] - m->s[i];
  m->tension[i - 1] = (a * m->tension[i - 1] + b * m->tension[i]) / (a + b);
  m->rate[i - 1] = (a * m->rate[i - 1] + b * m->rate[i]) / (a + b);
  if (m->rest) {
    merge_units(m->normal, i, a, b);
    merge_units(m->rest_normal, i, a, b);
    m->turn[i - 1] = (a * m->turn[i - 1] + b * m->turn[i]) / (a + b);
    m->spin[i - 1] = (a * m->spin[i - 1] + b * m->spin[i]) / (a + b);
  }
  arrays(m, at, width);
  for (size_t k = 0; k < ARRAYS; k++)
    if (*at[k])
      memmove(*at[k] + width[k] * i, *at[k] + width[k] * (i + 1),
              width[k] * (m->n - i - 1) * sizeof(double));
  m->n--;
}

/* Shortest stub at a wire's end, over the edge there [-]. */
static const double SHORTEST_STUB = 0.004;

double sw_mesh_snap(const sw_mesh *m, double s) {
  const double first = m->s[0], last = m->s[m->n - 1];
  if (s < first + SHORTEST_STUB * (m->s[1] - first)) return first;
  if (s > last - SHORTEST_STUB * (last - m->s[m->n - 2])) return last;
  return s;
}

static int may_move(const sw_mesh *m, size_t i, double s, const double *keep, size_t count) {
  if (i == 0 || i == m->n - 1) return 0;
  for (size_t k = 0; k < count; k++)
    if (keep[k] == m->s[i]) return 0;
  const double l = m->s[i + 1] - m->s[i - 1];
  const double share = (s - m->s[i - 1]) / l;
  return share > 0.22 && share < 0.78; /* first edges stay within b = 0.45 .. 1.55 */
}

/* Moves node *i to s, or inserts one beside it; *i becomes its number. */
static sw_status place_on_chords(sw_mesh *m, size_t *i, double s, const double *keep,
                                 size_t count) {
  if (may_move(m, *i, s, keep, count)) {
    move_node(m, *i, s);
    return SW_OK;
  }
  const size_t edge = m->s[*i] < s ? *i : *i - 1;
  *i = edge + 1;
  return sw_mesh_insert(m, edge, s);
}

static sw_status place_on_curve(sw_mesh *m, size_t i, double s, const double *keep, size_t count) {
  sw_mesh before = {0};
  SW_TRY(sw_mesh_copy(m, &before));
  sw_status status = place_on_chords(m, &i, s, keep, count);
  if (status == SW_OK) status = sw_mesh_smooth(m, i, &before, keep, count);
  if (status == SW_OK) {
    sw_mesh_free(&before);
  } else {
    sw_mesh_free(m);
    *m = before;
  }
  return status;
}

sw_status sw_mesh_place(sw_mesh *m, double s, const double *keep, size_t keep_count,
                        double *placed) {
  const double total = m->s[m->n - 1] - m->s[0];
  const double same = 1e-9 * total; /* nearer is the same node [m] */
  size_t i = sw_mesh_node(m, s);
  if (i > 0 && s - m->s[i - 1] < m->s[i] - s) i--;
  if (fabs(m->s[i] - s) <= same) {
    *placed = m->s[i];
    return SW_OK;
  }
  *placed = s;
  if ((m->rest || !m->drawn) && sw_mesh_is_bent_near(m, i))
    return place_on_curve(m, i, s, keep, keep_count);
  return place_on_chords(m, &i, s, keep, keep_count);
}
