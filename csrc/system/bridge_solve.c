/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations of bridged bodies: values of the matrix, twist, solution, reactions. */
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "solve/band3.h"
#include "solve/band4.h"
#include "solve/dense.h"
#include "system/bridge.h"
#include "system/join_twist.h"
#include "system/spin.h"
#include "system/twist.h"
#include "system/web.h"

static const uint32_t NONE = UINT32_MAX;

/* --- values --------------------------------------------------------------------- */

/* Copies a 3 x 3 block into a block of the matrix's size. */
static void widen(const struct sw_bridges *l, const double *from, double *to) {
  for (size_t i = 0; i < 3; i++)
    for (size_t j = 0; j < 3; j++) to[l->block * i + j] = from[3 * i + j];
}

static void add_pair(struct sw_bridges *l, size_t pair, const double *from) {
  double block[SW_SPARSE_BLOCK_MAX * SW_SPARSE_BLOCK_MAX] = {0};
  if (l->block > 3) widen(l, from, block);
  sw_sparse_add(l->matrix, pair, l->block > 3 ? block : from);
}

static void load_chain(struct sw_bridges *l, const sw_body *b, size_t first, size_t *pair) {
  static const int full[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  const size_t n = b->plan->nodes;
  for (size_t i = 0; i < n; i++) {
    const double *row = b->field.rows + SW_ROW_SIZE * i;
    double *to = sw_sparse_own(l->matrix, first + i);
    for (int k = 0; k < 9; k++) to[l->block > 3 ? k + k / 3 : k] = row[full[k]];
    if (l->block > 3) to[15] = 1.0;
    if (i + 1 < n) add_pair(l, (*pair)++, row + SW_ROW_NEXT);
    if (i + 2 < n) add_pair(l, (*pair)++, row + SW_ROW_SECOND);
  }
}

/* Does this for a body with frames, whose rows already include spins. */
static void load_spinning(struct sw_bridges *l, const sw_body *b, size_t first, size_t *pair) {
  const size_t n = b->plan->nodes;
  for (size_t i = 0; i < n; i++) {
    const double *row = b->spin_rows + SW_ROW4_SIZE * i;
    memcpy(sw_sparse_own(l->matrix, first + i), row, 16 * sizeof *row);
    if (i + 1 < n) sw_sparse_add(l->matrix, (*pair)++, row + SW_ROW4_NEXT);
    if (i + 2 < n) sw_sparse_add(l->matrix, (*pair)++, row + SW_ROW4_SECOND);
  }
}

/* Copies a web's blocks from its own matrix; held particles get a unit block without couplings. */
static void load_web(struct sw_bridges *l, const sw_body *b, size_t first, size_t *pair) {
  static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  double block[9];
  for (size_t i = 0; i < b->plan->nodes; i++) {
    double *to = sw_sparse_own(l->matrix, first + i);
    if (!b->web_fixed[i]) sw_web_block(b, i, i, block);
    for (int k = 0; k < 9; k++)
      to[l->block > 3 ? k + k / 3 : k] = b->web_fixed[i] ? one[k] : block[k];
    if (l->block > 3) to[15] = 1.0;
  }
  for (size_t k = 0; k < b->web_couples; k++, ++*pair) {
    const size_t i = l->pairs[*pair].i - first, j = l->pairs[*pair].j - first;
    if (b->web_fixed[i] || b->web_fixed[j]) continue;
    sw_web_block(b, i, j, block);
    add_pair(l, *pair, block);
  }
}

static int is_held(const sw_system *s, uint32_t node) {
  const sw_body *body = &s->bodies[sw_system_body_of(s, node)];
  return body->plan->held[node - body->first_node] != SW_FREE;
}

static void load(sw_system *s) {
  struct sw_bridges *l = s->bridges;
  size_t pair = 0;
  sw_sparse_clear(l->matrix);
  for (size_t b = 0; b < s->body_count; b++) {
    sw_body *body = &s->bodies[b];
    if (!body->bridged) continue;
    if (body->spin_block) sw_spin_load(s, body, s->delta + 3 * body->first_node);
    const int web = body->plan->web != NULL;
    (web ? load_web : body->spin_block ? load_spinning : load_chain)(l, body, l->first[b], &pair);
  }
  SW_ITEMS(const sw_bridge, at, l->list, l->count) {
    if (is_held(s, at->i) || is_held(s, at->j)) continue;
    add_pair(l, l->chain_pairs + at->number, at->k);
  }
}

/* Fills x with the bridged bodies' right-hand sides: those of nodes (nodes x 3), or spin_delta of
 * bodies with frames. */
static void load_right(const sw_system *s, const double *nodes) {
  struct sw_bridges *l = s->bridges;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    double *x = l->x + l->block * l->first[b];
    const double *delta = nodes + 3 * body->first_node;
    if (!body->bridged) continue;
    if (body->spin_block)
      memcpy(x, body->spin_delta, 4 * body->plan->nodes * sizeof *x);
    else
      for (size_t i = 0; i < body->plan->nodes; i++, x += l->block, delta += 3) {
        memcpy(x, delta, 3 * sizeof *x);
        if (l->block == 4) x[3] = 0;
      }
  }
}

/* Copies the solution from x back to nodes or spin_delta. */
static void take_solution(sw_system *s, double *nodes) {
  const struct sw_bridges *l = s->bridges;
  for (size_t b = 0; b < s->body_count; b++) {
    sw_body *body = &s->bodies[b];
    const double *x = l->x + l->block * l->first[b];
    double *delta = nodes + 3 * body->first_node;
    if (!body->bridged) continue;
    if (body->spin_block) memcpy(body->spin_delta, x, 4 * body->plan->nodes * sizeof *x);
    for (size_t i = 0; i < body->plan->nodes; i++)
      memcpy(delta + 3 * i, x + l->block * i, 3 * sizeof *x);
  }
}

/* --- twist ---------------------------------------------------------------------- */

/* Number of spans of all bridged bodies. */
static size_t count_spans(const sw_system *s) {
  size_t count = 0;
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].bridged && s->bodies[b].has_twist) count += s->bodies[b].plan->span_count;
  return count;
}

/* Writes a span's slope in the matrix' unknowns, zero at held nodes. */
static void put_slope(const sw_system *s, const sw_body *b, size_t number, double *out) {
  const struct sw_bridges *l = s->bridges;
  const sw_span *span = &b->plan->spans[number];
  const size_t first = l->first[b - s->bodies], joined = sw_joins_span(s, b, number);
  memset(out, 0, l->block * l->nodes * sizeof *out);
  for (size_t i = span->first; i <= span->last + 1; i++)
    if (b->plan->held[i] == SW_FREE)
      sw_store(out + l->block * (first + i), sw_vec_at(b->twist_rank, i));
  if (joined != SIZE_MAX) sw_join_twist_put(s, joined, out);
}

/* Returns the slope times x, in the matrix' unknowns. */
static double slope_dot(const sw_system *s, const sw_body *b, size_t number, const double *x) {
  const struct sw_bridges *l = s->bridges;
  const sw_span *span = &b->plan->spans[number];
  const size_t first = l->first[b - s->bodies], joined = sw_joins_span(s, b, number);
  double sum = joined != SIZE_MAX ? sw_join_twist_dot(s, joined, x) : 0;
  for (size_t i = span->first; i <= span->last + 1; i++)
    if (b->plan->held[i] == SW_FREE)
      sum += sw_dot(sw_vec_at(b->twist_rank, i), sw_load(x + l->block * (first + i)));
  return sum;
}

/* Solves for the right-hand sides in l->x and for the spans' slopes. */
static sw_status solve_slopes(sw_system *s, size_t count) {
  struct sw_bridges *l = s->bridges;
  const size_t n = l->block * l->nodes;
  size_t k = 0;
  SW_TRY(SW_GROW(l->spans, l->span_capacity, count * (n + count + 1)));
  for (size_t b = 0; b < s->body_count; b++) {
    sw_body *body = &s->bodies[b];
    if (!body->bridged || !body->has_twist) continue;
    sw_twist_gather(body);
    for (size_t j = 0; j < body->plan->span_count; j++, k++)
      put_slope(s, body, j, l->spans + n * k);
  }
  sw_sparse_solve_two(l->matrix, l->x, count ? l->spans : NULL);
  for (k = 1; k < count; k += 2)
    sw_sparse_solve_two(l->matrix, l->spans + n * k, k + 1 < count ? l->spans + n * (k + 1) : NULL);
  return SW_OK;
}

/* Each span adds the stiffness g g' to the matrix K. Bridges carry twist from wire to wire, so all
 * spans are treated at once: by the formula of Sherman, Morrison and Woodbury with the compliances
 * C^-1 and the solved slopes K^-1 g. Returns by how many the negative directions become fewer. */
static size_t correct_twist(sw_system *s, size_t m) {
  struct sw_bridges *l = s->bridges;
  const size_t n = l->block * l->nodes;
  size_t k = 0;
  double *S = l->spans + m * n, *z = S + m * m;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    for (size_t j = 0; body->bridged && body->has_twist && j < body->plan->span_count; j++, k++) {
      for (size_t i = 0; i <= k; i++)
        S[m * k + i] = S[m * i + k] = slope_dot(s, body, j, l->spans + n * i);
      S[m * k + k] += 1.0 / body->field.twist_stiffness[j];
      z[k] = slope_dot(s, body, j, l->x);
      sw_joins_row(s, body, j, k);
    }
  }
  sw_joins_add_give(s, S, m);
  const size_t fewer = sw_dense_eliminate(S, m, z, SW_DENSE_IN_ORDER);
  for (k = 0; k < m; k++)
    for (size_t i = 0; i < n; i++) l->x[i] -= z[k] * l->spans[n * k + i];
  return fewer;
}

static void keep_gains(sw_system *s) {
  for (size_t b = 0; b < s->body_count; b++) {
    sw_body *body = &s->bodies[b];
    for (size_t j = 0; body->bridged && body->has_twist && j < body->plan->span_count; j++)
      body->twist_gain[j] = body->field.twist_stiffness[j] * slope_dot(s, body, j, s->bridges->x);
  }
  sw_joins_gain(s);
}

/* --- solution ------------------------------------------------------------------- */

sw_status sw_bridges_solve(sw_system *s, size_t *negative) {
  struct sw_bridges *l = s->bridges;
  size_t found = 0;
  SW_TRY(sw_bridges_prepare(s));
  const size_t spans = count_spans(s);
  load(s);
  SW_TRY(sw_sparse_factor(l->matrix, &found));
  load_right(s, s->delta);
  memcpy(l->right, l->x, l->block * l->nodes * sizeof *l->x);
  SW_TRY(solve_slopes(s, spans));
  const size_t fewer = spans ? correct_twist(s, spans) : 0;
  keep_gains(s);
  take_solution(s, s->delta);
  *negative += found - fewer;
  return SW_OK;
}

int sw_bridges_solves_again(const sw_system *s) {
  return sw_bridges_any(s) && s->bridges->block == 3;
}

void sw_bridges_solve_again(sw_system *s, double *more) {
  struct sw_bridges *l = s->bridges;
  const size_t spans = count_spans(s);
  load_right(s, more);
  for (size_t i = 0; i < l->block * l->nodes; i++) l->right[i] += l->x[i];
  sw_sparse_solve(l->matrix, l->x);
  if (spans) correct_twist(s, spans);
  for (size_t b = 0; b < s->body_count; b++)
    if (!s->bodies[b].bridged)
      memset(more + 3 * s->bodies[b].first_node, 0, 3 * s->bodies[b].plan->nodes * sizeof *more);
  take_solution(s, more);
}

double sw_bridges_work(const sw_system *s) {
  const struct sw_bridges *l = s->bridges;
  double sum = 0;
  for (size_t i = 0; i < s->nodes; i++)
    if (l->number[i] != NONE)
      sum += sw_dot(sw_load(l->right + l->block * l->number[i]), sw_vec_at(s->delta, i));
  return sum;
}

void sw_bridges_solve_shift(sw_system *s, double *nodes, double *spins) {
  struct sw_bridges *l = s->bridges;
  const size_t count = count_spans(s);
  for (int back = 0; back < 2; back++) {
    for (size_t i = 0; i < s->nodes; i++) {
      double *x = l->number[i] == NONE ? NULL : l->x + l->block * l->number[i];
      if (x && !back) memcpy(x, nodes + 3 * i, 3 * sizeof *x);
      if (x && !back && l->block == 4) x[3] = spins[i];
      if (x && back) memcpy(nodes + 3 * i, x, 3 * sizeof *x);
      if (x && back && l->block == 4) spins[i] = x[3];
    }
    if (!back) sw_sparse_solve(l->matrix, l->x);
    if (!back && count) correct_twist(s, count);
  }
}

void sw_bridges_take_solution(sw_system *s) {
  load_right(s, s->delta);
  keep_gains(s);
}

/* --- reactions ------------------------------------------------------------------ */

static sw_held_node *held_at(sw_system *s, uint32_t node) {
  size_t low = 0, high = s->held_count; /* nodes ascend within a hold, but not from hold to hold */
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

void sw_bridges_react(sw_system *s) {
  const struct sw_bridges *l = s->bridges;
  for (size_t k = 0; l && k < l->count; k++) {
    const sw_bridge *at = &l->list[k];
    if (is_held(s, at->i)) react(s, at->i, at->k, 0, s->delta + 3 * at->j);
    if (is_held(s, at->j)) react(s, at->j, at->k, 1, s->delta + 3 * at->i);
  }
}
