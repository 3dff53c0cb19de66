/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Block matrices. Those of rings are in rings.h. Those of any pattern store the blocks of the lower
 * half row by row, with ascending columns; blocks_tree.h makes their factor. */
#include "solve/blocks.h"

#include <string.h>

#include "base/alloc.h"
#include "base/clear.h"
#include "base/halving.h"
#include "solve/blocks_tree.h"
#include "solve/numbers.h"
#include "solve/rings.h"

enum { BLOCK = 9 };

struct sw_blocks {
  sw_rings *rings; /* NULL: any pattern, */
  size_t nodes;
  uint32_t *first;   /* (nodes + 1) a node's first block; its own block is the last one */
  uint32_t *column;  /* (blocks) nodes, ascending in each row */
  uint32_t *under;   /* (nodes + 1) index in below of a node's first block in later rows */
  uint32_t *below;   /* (blocks x 2) row and number of these blocks */
  sw_numbers values; /* (blocks x 9) */
  sw_tree *tree;
};

static sw_status finish(sw_status status, sw_blocks *b, sw_blocks **out) {
  if (status == SW_OK)
    *out = b;
  else
    sw_blocks_free(b);
  return status;
}

sw_status sw_blocks_new_rings(size_t rings, size_t per_ring, sw_blocks **out) {
  sw_blocks *b = sw_alloc(1, sizeof *b);
  if (!b) return SW_ENOMEM;
  b->nodes = rings * per_ring;
  return finish(sw_rings_new(rings, per_ring, &b->rings), b, out);
}

void sw_blocks_free(sw_blocks *b) {
  if (!b) return;
  sw_rings_free(b->rings);
  sw_tree_free(b->tree);
  SW_FREE_ALL(b->first, b->column, b->under, b->values.at, b);
}

/* --- any pattern ---------------------------------------------------------------------- */

/* Sorts the blocks of the lower half into columns and then these into rows, so that both lists
 * ascend. order: (count + nodes) indices of pairs. */
static void sort_by_column(size_t nodes, const sw_couple *pairs, size_t count, uint32_t *start,
                           uint32_t *order) {
  for (size_t k = 0; k < count; k++) {
    const uint32_t low = pairs[k].i < pairs[k].j ? pairs[k].i : pairs[k].j;
    start[low + 1]++;
  }
  for (size_t i = 0; i < nodes; i++) start[i + 1] += start[i];
  for (size_t k = 0; k < count; k++) {
    const uint32_t low = pairs[k].i < pairs[k].j ? pairs[k].i : pairs[k].j;
    order[start[low]++] = (uint32_t)k;
  }
}

/* Lists rows with their columns, repeats next to each other: column (count + nodes) and first
 * (nodes + 1). */
static void sort_by_row(size_t nodes, const sw_couple *pairs, size_t count, const uint32_t *order,
                        uint32_t *first, uint32_t *column) {
  for (size_t k = 0; k < count; k++) {
    const uint32_t high = pairs[k].i > pairs[k].j ? pairs[k].i : pairs[k].j;
    first[high + 1]++;
  }
  for (size_t i = 0; i < nodes; i++) first[i + 1] += first[i] + 1; /* and its own block */
  for (size_t k = 0; k < count; k++) {
    const sw_couple p = pairs[order[k]];
    const uint32_t high = p.i > p.j ? p.i : p.j, low = p.i < p.j ? p.i : p.j;
    column[first[high]++] = low;
  }
  for (size_t i = nodes; i-- > 0;) {
    column[first[i]] = (uint32_t)i;
    first[i + 1] = first[i] + 1; /* where this row ends and the next one began */
  }
  first[0] = 0;
}

/* Removes repeats. */
static void unite(size_t nodes, uint32_t *first, uint32_t *column) {
  uint32_t filled = 0, from = 0;
  for (size_t i = 0; i < nodes; i++) {
    const uint32_t begin = filled;
    for (; from < first[i + 1]; from++)
      if (filled == begin || column[filled - 1] != column[from]) column[filled++] = column[from];
    first[i + 1] = filled;
  }
}

static sw_status find_pattern(sw_blocks *s, const sw_couple *pairs, size_t count) {
  uint32_t *work SW_LOCAL = sw_alloc(s->nodes + 1 + count, sizeof *work);
  s->first = sw_alloc(s->nodes + 1, sizeof *s->first);
  s->column = sw_alloc(count + s->nodes, sizeof *s->column);
  if (!work || !s->first || !s->column) return SW_ENOMEM;
  uint32_t *order = work + s->nodes + 1;
  sort_by_column(s->nodes, pairs, count, work, order);
  sort_by_row(s->nodes, pairs, count, order, s->first, s->column);
  unite(s->nodes, s->first, s->column);
  return SW_OK;
}

/* Lists the blocks below each node's own block. */
static sw_status find_below(sw_blocks *s) {
  const size_t n = s->nodes, blocks = s->first[n];
  s->under = sw_alloc(n + 2 + 2 * blocks, sizeof *s->under);
  if (!s->under) return SW_ENOMEM;
  s->below = s->under + n + 2;
  uint32_t *at = s->under + 1; /* becomes under: filled one place further on */
  for (size_t i = 0; i < n; i++)
    for (uint32_t k = s->first[i]; s->column[k] < i; k++) at[s->column[k] + 1]++;
  for (size_t i = 1; i <= n; i++) at[i] += at[i - 1];
  for (size_t i = 0; i < n; i++)
    for (uint32_t k = s->first[i]; s->column[k] < i; k++) {
      uint32_t *to = s->below + 2 * (size_t)at[s->column[k]]++;
      to[0] = (uint32_t)i, to[1] = k;
    }
  return SW_OK;
}

static sw_status analyse(sw_blocks *s, const sw_couple *pairs, size_t count, const int32_t *order,
                         sw_blocks *old) {
  SW_TRY(find_pattern(s, pairs, count));
  SW_TRY(find_below(s));
  SW_TRY(
      sw_numbers_make(&s->values, old ? &old->values : NULL, BLOCK * (size_t)s->first[s->nodes]));
  return sw_tree_new(s->nodes, s->first, s->column, order, old ? old->tree : NULL, &s->tree);
}

sw_status sw_blocks_new_sparse(size_t nodes, const sw_couple *pairs, size_t count,
                               const int32_t *order, sw_blocks *old, sw_blocks **out) {
  if (nodes < 1) return SW_EINVAL;
  if (nodes > INT32_MAX / 32 || count > INT32_MAX / 32) return SW_ELIMIT;
  for (size_t k = 0; k < count; k++)
    if (pairs[k].i >= nodes || pairs[k].j >= nodes || pairs[k].i == pairs[k].j) return SW_EINVAL;
  sw_blocks *b = sw_alloc(1, sizeof *b);
  if (!b) return SW_ENOMEM;
  b->nodes = nodes;
  return finish(analyse(b, pairs, count, order, old && old->rings ? NULL : old), b, out);
}

/* y += block x */
static inline void add(const double *a, const double *x, double *y) {
  for (int i = 0; i < 3; i++) y[i] += a[3 * i] * x[0] + a[3 * i + 1] * x[1] + a[3 * i + 2] * x[2];
}

/* y += block' x */
static inline void add_mirrored(const double *a, const double *x, double *y) {
  for (int i = 0; i < 3; i++) y[i] += a[i] * x[0] + a[3 + i] * x[1] + a[6 + i] * x[2];
}

/* The same for a node's own block, of which only the lower half is read. */
static inline void add_own(const double *a, const double *x, double *y) {
  y[0] += a[0] * x[0] + a[3] * x[1] + a[6] * x[2];
  y[1] += a[3] * x[0] + a[4] * x[1] + a[7] * x[2];
  y[2] += a[6] * x[0] + a[7] * x[1] + a[8] * x[2];
}

static void multiply(const sw_blocks *s, const double *x, double *y) {
  memset(y, 0, 3 * s->nodes * sizeof *y);
  for (size_t i = 0; i < s->nodes; i++) {
    const double *a = s->values.at + BLOCK * (size_t)s->first[i];
    uint32_t k = s->first[i];
    for (; s->column[k] < i; k++, a += BLOCK) {
      const size_t j = s->column[k];
      add(a, x + 3 * j, y + 3 * i);
      add_mirrored(a, x + 3 * i, y + 3 * j);
    }
    add_own(a, x + 3 * i, y + 3 * i);
  }
}

static void row_times(const sw_blocks *s, size_t node, const double *x, double y[3]) {
  const double *a = s->values.at + BLOCK * (size_t)s->first[node];
  double sum[3] = {0, 0, 0};
  for (uint32_t k = s->first[node]; s->column[k] < node; k++, a += BLOCK)
    add(a, x + 3 * (size_t)s->column[k], sum);
  add_own(a, x + 3 * node, sum);
  for (uint32_t e = s->under[node]; e < s->under[node + 1]; e++) {
    const uint32_t *at = s->below + 2 * (size_t)e;
    add_mirrored(s->values.at + BLOCK * (size_t)at[1], x + 3 * (size_t)at[0], sum);
  }
  memcpy(y, sum, sizeof sum);
}

static size_t slot(const sw_blocks *s, size_t i, size_t j) {
  if (i >= s->nodes) return SIZE_MAX;
  size_t at;
  SW_FIRST_NOT(s->column[at] < j, at, s->first[i], s->first[i + 1]);
  return at < s->first[i + 1] && s->column[at] == j ? BLOCK * at : SIZE_MAX;
}

/* --- both kinds ----------------------------------------------------------------------- */

size_t sw_blocks_nodes(const sw_blocks *b) { return b->nodes; }

double *sw_blocks_values(sw_blocks *b) { return b->rings ? b->rings->values : b->values.at; }

size_t sw_blocks_stride(const sw_blocks *b) { return b->rings ? b->rings->stride : 3; }

size_t sw_blocks_slot(const sw_blocks *b, size_t i, size_t j) {
  return b->rings ? sw_rings_slot(b->rings, i, j) : slot(b, i, j);
}

void sw_blocks_clear(sw_blocks *b) {
  sw_clear(sw_blocks_values(b), b->rings ? b->rings->rings * b->rings->n * b->rings->stride
                                         : BLOCK * (size_t)b->first[b->nodes]);
}

sw_status sw_blocks_factor(sw_blocks *b, const unsigned char *fixed, size_t *negative) {
  return b->rings ? sw_rings_factor(b->rings, fixed, negative)
                  : sw_tree_factor(b->tree, b->values.at, fixed, negative);
}

double sw_blocks_work(const sw_blocks *b) {
  return b->rings ? sw_blocks_rings_work(b->rings->rings, b->rings->per_ring)
                  : sw_tree_work(b->tree);
}

void sw_blocks_solve(const sw_blocks *b, double *x) {
  if (b->rings)
    sw_rings_solve(b->rings, x);
  else
    sw_tree_solve(b->tree, x);
}

void sw_blocks_multiply(const sw_blocks *b, const double *x, double *y) {
  if (b->rings)
    sw_rings_multiply(b->rings, x, y);
  else
    multiply(b, x, y);
}

void sw_blocks_row_times(const sw_blocks *b, size_t node, const double *x, double y[3]) {
  if (b->rings)
    sw_rings_row_times(b->rings, node, x, y);
  else
    row_times(b, node, x, y);
}
