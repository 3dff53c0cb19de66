/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The analysis of a sparse matrix: the order, the pattern of L, and the target block of each
 * product. */
#include "solve/sparse.h"

#include "base/alloc.h"
#include "base/halving.h"
#include "solve/order.h"
#include "solve/sparse_inner.h"

/* With more blocks than this per column of L, dense fronts make the factors, which treat many
 * numbers at once [-]. */
static const size_t DENSE = 12;

void sw_sparse_free(sw_sparse *s) {
  if (!s) return;
  sw_blocks_free(s->fronts);
  SW_FREE_ALL(s->place, s->start, s->row, s->slot, s->target, s->x, s);
}

void sw_sparse_forget_order(sw_sparse *s) { s->along = 0; }

size_t sw_sparse_fill(const sw_sparse *s) { return s->fill; }

/* --- analysis ------------------------------------------------------------------- */

static void sort(uint32_t *a, size_t n) {
  for (size_t i = 1; i < n; i++) {
    const uint32_t v = a[i];
    size_t j = i;
    for (; j > 0 && a[j - 1] > v; j--) a[j] = a[j - 1];
    a[j] = v;
  }
}

/* Work space of the analysis, each (n) or (n + 1). */
typedef struct analysis {
  int32_t *first, *next, *order;
  uint32_t *seen, *child, *sibling;
  size_t row_capacity;
} analysis;

/* Finds the rows of column k of L: those of the matrix and those of the columns whose first row is
 * k. */
static sw_status find_column(sw_sparse *s, analysis *a, uint32_t k) {
  const uint32_t none = (uint32_t)s->n, node = (uint32_t)a->order[k];
  size_t most = (size_t)(a->first[node + 1] - a->first[node]);
  for (uint32_t c = a->child[k]; c != none; c = a->sibling[c])
    most += s->start[c + 1] - s->start[c];
  SW_TRY(SW_GROW(s->row, a->row_capacity, s->fill + most + 1));
  uint32_t *rows = s->row + s->fill;
  size_t count = 0;
  a->seen[k] = k;
  for (int32_t e = a->first[node]; e < a->first[node + 1]; e++) {
    const uint32_t r = s->place[a->next[e]];
    if (r > k && a->seen[r] != k) a->seen[r] = k, rows[count++] = r;
  }
  for (uint32_t c = a->child[k]; c != none; c = a->sibling[c])
    for (uint32_t e = s->start[c]; e < s->start[c + 1]; e++) {
      const uint32_t r = s->row[e];
      if (a->seen[r] != k) a->seen[r] = k, rows[count++] = r;
    }
  sort(rows, count);
  if (count) {
    a->sibling[k] = a->child[rows[0]];
    a->child[rows[0]] = k;
  }
  s->fill += count;
  s->start[k + 1] = (uint32_t)s->fill;
  if (count > s->widest) s->widest = count;
  return SW_OK;
}

static uint32_t find_slot(const sw_sparse *s, uint32_t column, uint32_t row) {
  size_t after;
  SW_FIRST_NOT(s->row[after] <= row, after, s->start[column] + 1, s->start[column + 1]);
  return after - 1;
}

/* Finds the target of the product of rows a < b of each column, in the order of the factorisation.
 */
static sw_status find_targets(sw_sparse *s) {
  size_t total = 0;
  for (size_t k = 0; k < s->n; k++) {
    const size_t p = s->start[k + 1] - s->start[k];
    total += p * (p - (p > 0)) / 2;
  }
  s->target = sw_alloc(total, sizeof *s->target);
  if (!s->target) return SW_ENOMEM;
  for (size_t k = 0; k < s->n; k++)
    for (uint32_t a = s->start[k]; a < s->start[k + 1]; a++) {
      uint32_t at = s->start[s->row[a]];
      for (uint32_t b = a + 1; b < s->start[k + 1]; b++) {
        while (s->row[at] != s->row[b]) at++; /* both lists ascend */
        s->target[s->targets++] = at;
      }
    }
  return SW_OK;
}

static sw_status find_pattern(sw_sparse *s, const sw_couple *pairs, size_t count, analysis *a) {
  const size_t n = s->n;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(a->order, n), SW_ROOM(a->seen, 3 * (n + 1)), SW_ROOM(s->place, n),
                      SW_ROOM(s->start, n + 1)));
  a->child = a->seen + n + 1, a->sibling = a->child + n + 1;
  SW_TRY(sw_sparse_neighbours(n, pairs, count, &a->first, &a->next));
  SW_TRY(sw_sparse_order(n, a->first, a->next, a->order));
  for (size_t k = 0; k < n; k++) s->place[a->order[k]] = (uint32_t)k;
  for (size_t k = 0; k <= n; k++) a->seen[k] = a->child[k] = a->sibling[k] = (uint32_t)n;
  for (size_t k = 0; k < n; k++) SW_TRY(find_column(s, a, (uint32_t)k));
  for (size_t k = 0; k < count; k++) {
    const uint32_t pi = s->place[pairs[k].i], pj = s->place[pairs[k].j];
    s->slot[k] = pi < pj ? 2 * find_slot(s, pi, pj) + 1 : 2 * find_slot(s, pj, pi);
  }
  return SW_OK;
}

static sw_status analyse(sw_sparse *s, const sw_couple *pairs, size_t count) {
  analysis a = {0};
  const sw_status status = find_pattern(s, pairs, count, &a);
  SW_FREE_ALL(a.first, a.next, a.order, a.seen);
  return status;
}

/* Makes the fronts. slot[k]: where the block of pair k begins in their values, times 2, + 1 if
 * given transposed. */
static sw_status use_fronts(sw_sparse *s, const sw_couple *pairs, size_t count,
                            const int32_t *order, sw_sparse *old) {
  sw_blocks *room = old ? old->fronts : NULL;
  const sw_status status = sw_blocks_new_sparse(s->n, pairs, count, order, room, &s->fronts);
  for (size_t k = 0; k < count && status == SW_OK; k++) {
    const uint32_t i = pairs[k].i, j = pairs[k].j;
    const size_t at = i > j ? sw_blocks_slot(s->fronts, i, j) : sw_blocks_slot(s->fronts, j, i);
    s->slot[k] = (uint32_t)(2 * at) + (i < j);
  }
  return status;
}

/* Returns the number of blocks that the elimination in the order of least fill changes. */
static double work_of(const sw_sparse *s) {
  double sum = 0;
  for (size_t k = 0; k < s->n; k++) {
    const double rows = s->start[k + 1] - s->start[k] + 1.0;
    sum += rows * rows;
  }
  return sum;
}

/* Makes fronts for the pattern, eliminated from end to end if that is less work. */
static sw_status choose_fronts(sw_sparse *s, const sw_couple *pairs, size_t count, sw_sparse *old) {
  int32_t *order SW_LOCAL = sw_alloc(s->n, sizeof *order);
  double work;
  if (!order) return SW_ENOMEM;
  SW_TRY(sw_sparse_order_along(s->n, pairs, count, order, &work));
  s->along = s->along || work < work_of(s);
  return use_fronts(s, pairs, count, s->along ? order : NULL, old);
}

/* Allocates the values, if there are no fronts. */
static sw_status make_room(sw_sparse *s) {
  const size_t b = s->block, bb = b * b;
  SW_TRY(find_targets(s));
  s->x = sw_alloc(bb * (s->n + s->fill + s->widest) + 2 * b * s->n, sizeof *s->own);
  if (!s->x) return SW_ENOMEM;
  s->own = (double *)(s->x + b * s->n);
  s->off = s->own + bb * s->n;
  s->column = s->off + bb * s->fill;
  return SW_OK;
}

sw_status sw_sparse_new(size_t nodes, size_t block, const sw_couple *pairs, size_t count,
                        sw_sparse *old, sw_sparse **out) {
  sw_sparse *s = sw_alloc(1, sizeof *s);
  if (!s) return SW_ENOMEM;
  s->n = nodes, s->block = block;
  s->along = old && old->along && block == old->block;
  s->slot = sw_alloc(count, sizeof *s->slot);
  sw_status status = s->slot && nodes < INT32_MAX / 4 && count < INT32_MAX / 4 ? SW_OK : SW_ENOMEM;
  if (status == SW_OK && !s->along) status = analyse(s, pairs, count);
  if (status == SW_OK)
    status = s->along || (block == 3 && s->fill > DENSE * nodes)
                 ? choose_fronts(s, pairs, count, old)
                 : make_room(s);
  if (status == SW_OK)
    *out = s;
  else
    sw_sparse_free(s);
  return status;
}
