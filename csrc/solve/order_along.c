/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elimination order of Cuthill and McKee (1969), reversed (George 1971). Wires of a bundle are
 * coupled all along it. An elimination from one end to the other never holds more than a few rows
 * of nodes across, whichever of these are coupled. */
#include <string.h>

#include "base/alloc.h"
#include "solve/order.h"

sw_status sw_sparse_neighbours(size_t n, const sw_couple *pairs, size_t count, int32_t **first,
                               int32_t **next) {
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(*first, n + 2), SW_ROOM(*next, 2 * count + 1)));
  int32_t *at = *first + 1; /* becomes first: filled one place further on */
  for (size_t k = 0; k < count; k++) at[pairs[k].i + 1]++, at[pairs[k].j + 1]++;
  for (size_t i = 1; i < n; i++) at[i] += at[i - 1];
  for (size_t k = 0; k < count; k++) {
    (*next)[at[pairs[k].i]++] = (int32_t)pairs[k].j;
    (*next)[at[pairs[k].j]++] = (int32_t)pairs[k].i;
  }
  return SW_OK;
}

/* Work space of the search. */
typedef struct walk {
  size_t n;
  int32_t *first, *next;
  int32_t *order;
  uint8_t *seen; /* (n) */
} walk;

static int32_t degree(const walk *w, int32_t node) { return w->first[node + 1] - w->first[node]; }

/* Appends a node's unseen neighbours, those with fewest neighbours first. Returns the new end of
 * the order. */
static size_t add_neighbours(walk *w, int32_t node, size_t end) {
  const size_t begin = end;
  for (int32_t e = w->first[node]; e < w->first[node + 1]; e++) {
    const int32_t to = w->next[e];
    if (w->seen[to]) continue;
    w->seen[to] = 1;
    size_t at = end++;
    for (; at > begin && degree(w, w->order[at - 1]) > degree(w, to); at--)
      w->order[at] = w->order[at - 1];
    w->order[at] = to;
  }
  return end;
}

/* Appends all nodes connected to a node, the nearest first, from place begin of the order on.
 * Returns their end; *last: where the farthest begin. */
static size_t spread(walk *w, int32_t node, size_t begin, size_t *last) {
  size_t end = begin, at = begin;
  w->order[end++] = node;
  w->seen[node] = 1;
  while (at < end) {
    *last = at;
    for (const size_t level = end; at < level; at++) end = add_neighbours(w, w->order[at], end);
  }
  return end;
}

/* Number of searches for an end of the connected nodes, each from the farthest node with fewest
 * neighbours [-]. */
enum { TURNS = 3 };

static int32_t find_end(walk *w, int32_t node, size_t begin) {
  for (int turn = 0; turn < TURNS; turn++) {
    size_t last = begin;
    const size_t end = spread(w, node, begin, &last);
    node = w->order[last];
    for (size_t k = last; k < end; k++)
      if (degree(w, w->order[k]) < degree(w, node)) node = w->order[k];
    for (size_t k = begin; k < end; k++) w->seen[w->order[k]] = 0;
  }
  return node;
}

static void turn_round(int32_t *order, size_t n) {
  for (size_t i = 0, j = n; i + 1 < j; i++) {
    const int32_t swap = order[i];
    order[i] = order[--j], order[j] = swap;
  }
}

/* Returns the sum, over the elimination's steps, of the square of the number of nodes held in a
 * step, including its own. */
static double find_work(walk *w) {
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

sw_status sw_sparse_order_along(size_t n, const sw_couple *pairs, size_t count, int32_t *order,
                                double *work) {
  walk w = {.n = n, .order = order, .seen = sw_alloc(n, sizeof *w.seen)};
  size_t end = 0, last;
  const sw_status status =
      w.seen ? sw_sparse_neighbours(n, pairs, count, &w.first, &w.next) : SW_ENOMEM;
  for (int32_t node = 0; status == SW_OK && (size_t)node < n; node++)
    if (!w.seen[node]) end = spread(&w, find_end(&w, node, end), end, &last);
  turn_round(order, end);
  if (status == SW_OK) *work = find_work(&w);
  SW_FREE_ALL(w.first, w.next, w.seen);
  return status;
}
