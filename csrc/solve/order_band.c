/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elimination order of Cuthill and McKee (1969), turned round: what is coupled like the wires of a
 * bundle, all along it, is eliminated from one end to the other, and what couples it across costs
 * next to nothing. */
#include <string.h>

#include "base/alloc.h"
#include "solve/sparse.h"

typedef struct walk {
  size_t n;
  const int32_t *first, *next;
  int32_t *order;
  uint8_t *seen; /* (n) */
} walk;

static int32_t degree(const walk *w, int32_t node) { return w->first[node + 1] - w->first[node]; }

/* Neighbours of a node that were not seen yet, fewest neighbours of their own first. */
static size_t add_neighbours(walk *w, int32_t node, size_t filled) {
  const size_t begin = filled;
  for (int32_t e = w->first[node]; e < w->first[node + 1]; e++) {
    const int32_t to = w->next[e];
    if (w->seen[to]) continue;
    w->seen[to] = 1;
    size_t at = filled++;
    for (; at > begin && degree(w, w->order[at - 1]) > degree(w, to); at--)
      w->order[at] = w->order[at - 1];
    w->order[at] = to;
  }
  return filled;
}

/* All that hangs together with a node, nearest first, from place `begin` of the order on. Returns
 * where it ends; last: the first one of those that are farthest away. */
static size_t spread(walk *w, int32_t from, size_t begin, size_t *last) {
  size_t filled = begin, level = begin, at = begin;
  w->order[filled++] = from;
  w->seen[from] = 1;
  *last = begin;
  while (at < filled) {
    *last = level = at;
    for (const size_t end = filled; at < end; at++) filled = add_neighbours(w, w->order[at], filled);
  }
  (void)level;
  return filled;
}

/* A node at an end of what hangs together with a node: the loosest one of the farthest. */
enum { TURNS = 3 };
static int32_t end_of(walk *w, int32_t node, size_t begin) {
  for (int turn = 0; turn < TURNS; turn++) {
    size_t last;
    const size_t end = spread(w, node, begin, &last);
    node = w->order[last];
    for (size_t k = last; k < end; k++)
      if (degree(w, w->order[k]) < degree(w, node)) node = w->order[k];
    for (size_t k = begin; k < end; k++) w->seen[w->order[k]] = 0;
  }
  return node;
}

/* Rows that each step of the elimination holds, squared and summed. */
static double work_of(walk *w) {
  size_t held = 0;
  double sum = 0;
  memset(w->seen, 0, w->n);
  for (size_t k = 0; k < w->n; k++) {
    const int32_t node = w->order[k];
    held -= w->seen[node];
    w->seen[node] = 1;
    for (int32_t e = w->first[node]; e < w->first[node + 1]; e++) {
      held += !w->seen[w->next[e]];
      w->seen[w->next[e]] = 1;
    }
    sum += (double)(held + 1) * (double)(held + 1);
  }
  return sum;
}

sw_status sw_sparse_order_along(size_t n, const int32_t *first, const int32_t *next, int32_t *order,
                                double *work) {
  uint8_t *seen SW_LOCAL = sw_alloc(n, sizeof *seen);
  if (!seen) return SW_ENOMEM;
  walk w = {n, first, next, order, seen};
  size_t filled = 0, last;
  for (int32_t node = 0; (size_t)node < n; node++)
    if (!seen[node]) filled = spread(&w, end_of(&w, node, filled), filled, &last);
  for (size_t i = 0, j = n; i + 1 < j; i++) {
    const int32_t swap = order[i];
    order[i] = order[--j], order[j] = swap;
  }
  *work = work_of(&w);
  return SW_OK;
}
