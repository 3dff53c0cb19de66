/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/link.h"

#include <string.h>

#include "base/alloc.h"
#include "solve/band3.h"
#include "solve/sparse.h"
#include "system/twist.h"

/* One block, rows of node i, columns of node j, i < j. */
typedef struct link {
  uint32_t i, j; /* in the system's arrays */
  double k[9];   /* [N/m] */
} link;

struct sw_links {
  link *list; /* of this evaluation */
  size_t count, capacity;

  /* the pattern: what the sparse matrix was analysed for */
  sw_sparse *matrix;
  sw_sparse_pair *pairs; /* of the bodies' chains, then links; in the matrix' numbers */
  size_t pair_capacity, chain_pairs, pair_count;
  sw_sparse_pair *known; /* links of the pattern: those planned, then what came besides */
  size_t known_count, known_capacity;
  sw_sparse_pair *planned, *taken; /* for the present step; for the pattern */
  size_t planned_count, planned_capacity, taken_count, taken_capacity;
  uint32_t *table; /* hash: number in known + 1, 0 = empty */
  size_t table_capacity, table_size;
  uint32_t *number; /* (system's nodes) in the matrix, or NONE */
  size_t *first;    /* (bodies) first node in the matrix */
  size_t nodes;     /* of the matrix */
  double *x;        /* (nodes x 3) */
  size_t x_capacity;
  double *spans; /* work for twist */
  size_t span_capacity;
};

static const uint32_t NONE = UINT32_MAX;

void sw_links_free(sw_system *s) {
  struct sw_links *l = s->links;
  if (!l) return;
  sw_sparse_free(l->matrix);
  sw_free(l->list);
  sw_free(l->pairs);
  sw_free(l->known);
  sw_free(l->planned);
  sw_free(l->taken);
  sw_free(l->table);
  sw_free(l->number);
  sw_free(l->first);
  sw_free(l->x);
  sw_free(l->spans);
  sw_free(l);
  s->links = NULL;
}

void sw_links_begin(sw_system *s) {
  if (s->links) s->links->count = 0;
}

int sw_links_any(const sw_system *s) { return s->links && s->links->count > 0; }

static struct sw_links *links_of(sw_system *s) {
  if (!s->links) s->links = sw_alloc(1, sizeof *s->links);
  return s->links;
}

void sw_system_begin_plan(sw_system *s) {
  if (s->links) s->links->planned_count = 0;
}

sw_status sw_system_plan_link(sw_system *s, size_t i, size_t j) {
  struct sw_links *l = links_of(s);
  if (!l) return SW_ENOMEM;
  SW_TRY(sw_grow((void **)&l->planned, &l->planned_capacity, l->planned_count + 1,
                 sizeof *l->planned));
  l->planned[l->planned_count++] =
      (sw_sparse_pair){(uint32_t)(i < j ? i : j), (uint32_t)(i < j ? j : i)};
  return SW_OK;
}

sw_status sw_system_add_link(sw_system *s, size_t i, size_t j, const double k[9]) {
  struct sw_links *l = links_of(s);
  if (!l) return SW_ENOMEM;
  SW_TRY(sw_grow((void **)&l->list, &l->capacity, l->count + 1, sizeof *l->list));
  link *at = &l->list[l->count++];
  if (i < j) {
    *at = (link){(uint32_t)i, (uint32_t)j, {0}};
    memcpy(at->k, k, sizeof at->k);
  } else {
    *at = (link){(uint32_t)j, (uint32_t)i, {0}};
    for (int r = 0; r < 3; r++)
      for (int c = 0; c < 3; c++) at->k[3 * r + c] = k[3 * c + r];
  }
  return SW_OK;
}

/* --- pattern -------------------------------------------------------------------- */

static size_t hash_of(const struct sw_links *l, uint32_t i, uint32_t j) {
  uint64_t h = ((uint64_t)i << 32 | j) * 0x9E3779B97F4A7C15u;
  return (size_t)(h >> 20) & (l->table_size - 1);
}

/* Number of the pair in the pattern, or NONE. */
static uint32_t find(const struct sw_links *l, uint32_t i, uint32_t j) {
  if (!l->table_size) return NONE;
  for (size_t h = hash_of(l, i, j); l->table[h]; h = (h + 1) & (l->table_size - 1)) {
    const sw_sparse_pair *k = &l->known[l->table[h] - 1];
    if (k->i == i && k->j == j) return l->table[h] - 1;
  }
  return NONE;
}

static void enter(struct sw_links *l, uint32_t number) {
  const sw_sparse_pair *k = &l->known[number];
  size_t h = hash_of(l, k->i, k->j);
  while (l->table[h]) h = (h + 1) & (l->table_size - 1);
  l->table[h] = number + 1;
}

/* A table for at least count pairs, holding those known now. */
static sw_status make_table(struct sw_links *l, size_t count) {
  size_t size = 64;
  while (size < 2 * count) size *= 2;
  SW_TRY(sw_grow((void **)&l->table, &l->table_capacity, size, sizeof *l->table));
  l->table_size = size;
  memset(l->table, 0, size * sizeof *l->table);
  for (size_t k = 0; k < l->known_count; k++) enter(l, (uint32_t)k);
  return SW_OK;
}

/* One more link for the pattern. */
static sw_status add_known(struct sw_links *l, uint32_t i, uint32_t j) {
  if (find(l, i, j) != NONE) return SW_OK;
  SW_TRY(sw_grow((void **)&l->known, &l->known_capacity, l->known_count + 1, sizeof *l->known));
  if (2 * l->known_count >= l->table_size) SW_TRY(make_table(l, 2 * l->known_count + 1));
  l->known[l->known_count] = (sw_sparse_pair){i, j};
  enter(l, (uint32_t)l->known_count++);
  return SW_OK;
}

/* The pattern that was planned, unless it is the present one. */
static sw_status take_plan(struct sw_links *l) {
  const size_t n = l->planned_count;
  if (n == l->taken_count && (!n || !memcmp(l->planned, l->taken, n * sizeof *l->planned)))
    return SW_OK;
  SW_TRY(sw_grow((void **)&l->taken, &l->taken_capacity, n, sizeof *l->taken));
  if (n) memcpy(l->taken, l->planned, n * sizeof *l->taken);
  l->taken_count = n;
  l->known_count = 0;
  if (l->table_size) memset(l->table, 0, l->table_size * sizeof *l->table);
  for (size_t k = 0; k < n; k++) SW_TRY(add_known(l, l->planned[k].i, l->planned[k].j));
  sw_sparse_free(l->matrix);
  l->matrix = NULL;
  return SW_OK;
}

static const sw_body *body_of(const sw_system *s, uint32_t node, size_t *number) {
  size_t low = 0, high = s->body_count;
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    if (s->bodies[middle].first_node <= node)
      low = middle;
    else
      high = middle;
  }
  *number = low;
  return &s->bodies[low];
}

/* Mark the linked bodies and number their nodes one after another. */
static sw_status number_nodes(sw_system *s) {
  struct sw_links *l = s->links;
  if (!l->number) l->number = sw_alloc(s->nodes, sizeof *l->number);
  if (!l->first) l->first = sw_alloc(s->body_count, sizeof *l->first);
  if (!l->number || !l->first) return SW_ENOMEM;
  for (size_t b = 0; b < s->body_count; b++) s->bodies[b].linked = 0;
  for (size_t k = 0; k < l->known_count; k++) {
    size_t b;
    body_of(s, l->known[k].i, &b);
    s->bodies[b].linked = 1;
    body_of(s, l->known[k].j, &b);
    s->bodies[b].linked = 1;
  }
  l->nodes = 0;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    l->first[b] = l->nodes;
    for (size_t i = 0; i < body->plan->nodes; i++)
      l->number[body->first_node + i] = body->linked ? (uint32_t)l->nodes++ : NONE;
  }
  return sw_grow((void **)&l->x, &l->x_capacity, 3 * l->nodes, sizeof *l->x);
}

/* All pairs of the matrix: two along each chain's node, then the links. */
static sw_status list_pairs(sw_system *s) {
  struct sw_links *l = s->links;
  size_t n = 0;
  SW_TRY(sw_grow((void **)&l->pairs, &l->pair_capacity, 2 * l->nodes + l->known_count,
                 sizeof *l->pairs));
  for (size_t b = 0; b < s->body_count; b++) {
    if (!s->bodies[b].linked) continue;
    const size_t count = s->bodies[b].plan->nodes;
    const uint32_t first = (uint32_t)l->first[b];
    for (uint32_t i = 0; i + 1 < count; i++) {
      l->pairs[n++] = (sw_sparse_pair){first + i, first + i + 1};
      if (i + 2 < count) l->pairs[n++] = (sw_sparse_pair){first + i, first + i + 2};
    }
  }
  l->chain_pairs = n;
  for (size_t k = 0; k < l->known_count; k++)
    l->pairs[n++] = (sw_sparse_pair){l->number[l->known[k].i], l->number[l->known[k].j]};
  l->pair_count = n;
  return SW_OK;
}

static sw_status prepare_pattern(sw_system *s) {
  struct sw_links *l = s->links;
  SW_TRY(take_plan(l));
  const size_t before = l->known_count;
  for (size_t k = 0; k < l->count; k++) SW_TRY(add_known(l, l->list[k].i, l->list[k].j));
  if (l->matrix && l->known_count == before) return SW_OK;
  sw_sparse_free(l->matrix);
  l->matrix = NULL;
  SW_TRY(number_nodes(s));
  SW_TRY(list_pairs(s));
  return sw_sparse_new(l->nodes, 3, l->pairs, l->pair_count, &l->matrix);
}

/* --- values --------------------------------------------------------------------- */

static void load_chain(struct sw_links *l, const sw_body *b, size_t first, size_t *pair) {
  static const int full[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  const size_t n = b->plan->nodes;
  for (size_t i = 0; i < n; i++) {
    const double *row = b->field.rows + SW_ROW_SIZE * i;
    double *own = sw_sparse_own(l->matrix, first + i);
    for (int k = 0; k < 9; k++) own[k] = row[full[k]];
    if (i + 1 < n) sw_sparse_add(l->matrix, (*pair)++, row + SW_ROW_NEXT);
    if (i + 2 < n) sw_sparse_add(l->matrix, (*pair)++, row + SW_ROW_SECOND);
  }
}

static int is_held(const sw_system *s, uint32_t node) {
  size_t b;
  const sw_body *body = body_of(s, node, &b);
  return body->plan->held[node - body->first_node] != SW_FREE;
}

static void load(sw_system *s) {
  struct sw_links *l = s->links;
  size_t pair = 0;
  sw_sparse_clear(l->matrix);
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].linked) load_chain(l, &s->bodies[b], l->first[b], &pair);
  for (size_t k = 0; k < l->count; k++) {
    const link *at = &l->list[k];
    if (is_held(s, at->i) || is_held(s, at->j)) continue;
    sw_sparse_add(l->matrix, l->chain_pairs + find(l, at->i, at->j), at->k);
  }
}

/* --- twist ---------------------------------------------------------------------- */

/* The linked bodies' spans, one after another. */
static size_t count_spans(const sw_system *s) {
  size_t count = 0;
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].linked && s->bodies[b].has_twist) count += s->bodies[b].plan->span_count;
  return count;
}

/* Solve S z = z in place for symmetric S (m x m) by elimination; counts negative
 * pivots. S has the spans' compliances on its diagonal. */
static size_t solve_dense(double *S, size_t m, double *z) {
  size_t negative = 0;
  for (size_t k = 0; k < m; k++) {
    const double pivot = S[m * k + k];
    negative += pivot < 0;
    for (size_t i = k + 1; i < m; i++) {
      const double f = S[m * i + k] / pivot;
      for (size_t j = k; j < m; j++) S[m * i + j] -= f * S[m * k + j];
      z[i] -= f * z[k];
    }
  }
  for (size_t k = m; k-- > 0;) {
    for (size_t j = k + 1; j < m; j++) z[k] -= S[m * k + j] * z[j];
    z[k] /= S[m * k + k];
  }
  return negative;
}

/* A span's slope among the matrix' unknowns, held nodes zero. */
static void put_slope(const struct sw_links *l, const sw_body *b, size_t first, const sw_span *span,
                      double *out) {
  memset(out, 0, 3 * l->nodes * sizeof *out);
  for (size_t i = span->first; i <= span->last + 1; i++)
    if (b->plan->held[i] == SW_FREE) sw_store(out + 3 * (first + i), sw_vec_at(b->twist_rank, i));
}

/* Each span adds stiffness g g' to the matrix K: with the compliances C^-1 and the
 * solved slopes K^-1 g, Sherman, Morrison and Woodbury's formula for all at once, as
 * links carry the twist of one wire to the next. Returns how many directions are not
 * negative any more. */
static sw_status correct_twist(sw_system *s, size_t *fewer) {
  struct sw_links *l = s->links;
  const size_t m = count_spans(s), n = 3 * l->nodes;
  size_t k = 0;
  *fewer = 0;
  if (!m) return SW_OK;
  SW_TRY(sw_grow((void **)&l->spans, &l->span_capacity, m * (n + m + 1), sizeof *l->spans));
  double *S = l->spans + m * n, *z = S + m * m;
  for (size_t b = 0; b < s->body_count; b++) {
    sw_body *body = &s->bodies[b];
    if (!body->linked || !body->has_twist) continue;
    sw_twist_gather(body);
    for (size_t j = 0; j < body->plan->span_count; j++, k++) {
      put_slope(l, body, l->first[b], &body->plan->spans[j], l->spans + n * k);
      sw_sparse_solve(l->matrix, l->spans + n * k);
    }
  }
  k = 0;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    for (size_t j = 0; body->linked && body->has_twist && j < body->plan->span_count; j++, k++) {
      const sw_span *span = &body->plan->spans[j];
      for (size_t i = 0; i < m; i++)
        S[m * k + i] = sw_twist_dot(body, span, l->spans + n * i + 3 * l->first[b]);
      S[m * k + k] += 1.0 / body->field.twist_stiffness[j];
      z[k] = sw_twist_dot(body, span, l->x + 3 * l->first[b]);
    }
  }
  *fewer = solve_dense(S, m, z);
  for (k = 0; k < m; k++)
    for (size_t i = 0; i < n; i++) l->x[i] -= z[k] * l->spans[n * k + i];
  return SW_OK;
}

static void keep_gains(sw_system *s) {
  for (size_t b = 0; b < s->body_count; b++) {
    sw_body *body = &s->bodies[b];
    for (size_t j = 0; body->linked && body->has_twist && j < body->plan->span_count; j++)
      body->twist_gain[j] =
          body->field.twist_stiffness[j] *
          sw_twist_dot(body, &body->plan->spans[j], s->links->x + 3 * s->links->first[b]);
  }
}

/* --- solution ------------------------------------------------------------------- */

sw_status sw_links_solve(sw_system *s, size_t *negative) {
  struct sw_links *l = s->links;
  size_t found = 0, fewer = 0;
  SW_TRY(prepare_pattern(s));
  load(s);
  SW_TRY(sw_sparse_factor(l->matrix, &found));
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].linked)
      memcpy(l->x + 3 * l->first[b], s->delta + 3 * s->bodies[b].first_node,
             3 * s->bodies[b].plan->nodes * sizeof *l->x);
  sw_sparse_solve(l->matrix, l->x);
  SW_TRY(correct_twist(s, &fewer));
  keep_gains(s);
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].linked)
      memcpy(s->delta + 3 * s->bodies[b].first_node, l->x + 3 * l->first[b],
             3 * s->bodies[b].plan->nodes * sizeof *l->x);
  *negative += found - fewer;
  return SW_OK;
}

/* --- reactions ------------------------------------------------------------------ */

static sw_held_node *held_at(sw_system *s, uint32_t node) {
  size_t low = 0, high = s->held_count; /* a hold's nodes ascend, holds may not */
  for (; low < high; low++)
    if (s->held[low].node == node) return &s->held[low];
  return NULL;
}

static void react(sw_system *s, uint32_t node, const double k[9], int transposed, const double *d) {
  sw_held_node *h = held_at(s, node);
  if (!h) return;
  sw_vec f = h->reaction;
  const int row = transposed ? 1 : 3, column = transposed ? 3 : 1;
  f.x += k[0] * d[0] + k[column] * d[1] + k[2 * column] * d[2];
  f.y += k[row] * d[0] + k[row + column] * d[1] + k[row + 2 * column] * d[2];
  f.z += k[2 * row] * d[0] + k[2 * row + column] * d[1] + k[2 * row + 2 * column] * d[2];
  h->reaction = f;
}

void sw_links_react(sw_system *s) {
  const struct sw_links *l = s->links;
  for (size_t k = 0; l && k < l->count; k++) {
    const link *at = &l->list[k];
    if (is_held(s, at->i)) react(s, at->i, at->k, 0, s->delta + 3 * at->j);
    if (is_held(s, at->j)) react(s, at->j, at->k, 1, s->delta + 3 * at->i);
  }
}
