/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Builds, refits and searches a tree of bounding boxes. */
#include "shape/tree.h"

#include <math.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "shape/shape_class.h"

typedef struct builder {
  sw_box_tree *tree;
  const sw_bounds *boxes;
  const double *centres; /* (count x 3) centres of the things [m] */
  int *order;            /* their numbers, sorted in place */
  int stopped;           /* 1: the user wants to stop */
} builder;

static inline double key(const builder *b, int i, int axis) {
  return b->centres[3 * (size_t)b->order[i] + (size_t)axis];
}

static inline void swap(int *order, int i, int j) {
  const int kept = order[i];
  order[i] = order[j], order[j] = kept;
}

/* Reorders [low, high] so that no key before `middle` is above any key after it. */
static void select_middle(const builder *b, int low, int high, int middle, int axis) {
  while (low < high) {
    const double pivot = key(b, low + (high - low) / 2, axis);
    int i = low, j = high;
    while (i <= j) {
      while (key(b, i, axis) < pivot) i++;
      while (key(b, j, axis) > pivot) j--;
      if (i <= j) swap(b->order, i++, j--);
    }
    if (middle <= j)
      high = j;
    else if (middle >= i)
      low = i;
    else
      return;
  }
}

static const sw_bounds nothing = {{INFINITY, INFINITY, INFINITY},
                                  {-INFINITY, -INFINITY, -INFINITY}};

static void widen(sw_bounds *box, sw_vec low, sw_vec high) {
  box->min = sw_v(fmin(box->min.x, low.x), fmin(box->min.y, low.y), fmin(box->min.z, low.z));
  box->max = sw_v(fmax(box->max.x, high.x), fmax(box->max.y, high.y), fmax(box->max.z, high.z));
}

static int longest_axis(const builder *b, int low, int high) {
  sw_bounds box = nothing;
  for (int i = low; i <= high; i++) {
    const sw_vec p = sw_load(b->centres + 3 * (size_t)b->order[i]);
    widen(&box, p, p);
  }
  const sw_vec e = sw_sub(box.max, box.min);
  return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
}

static sw_bounds bounds_of(const sw_bounds *boxes, const int *order, int low, int high) {
  sw_bounds box = nothing;
  for (int i = low; i <= high; i++) widen(&box, boxes[order[i]].min, boxes[order[i]].max);
  return box;
}

static void split(builder *b, int low, int high) {
  b->stopped |= sw_interrupted();
  if (b->stopped) return;
  sw_tree_node *node = &b->tree->nodes[b->tree->node_count++];
  node->bounds = bounds_of(b->boxes, b->order, low, high);
  if (high - low < SW_TREE_LEAF) {
    node->first = low, node->count = high - low + 1;
    return;
  }
  const int middle = low + (high - low + 1) / 2;
  select_middle(b, low, high, middle, longest_axis(b, low, high));
  split(b, low, middle - 1);
  node->first = (int)b->tree->node_count;
  split(b, middle, high);
}

static void find_centres(const sw_bounds *boxes, size_t count, double *out) {
  for (size_t i = 0; i < count; i++)
    sw_store(out + 3 * i, sw_scale(sw_add(boxes[i].min, boxes[i].max), 0.5));
}

sw_status sw_box_tree_new(const sw_bounds *boxes, const double *centres, size_t count,
                          sw_box_tree *out) {
  double *own = centres ? NULL : sw_alloc(3 * count, sizeof *own);
  *out = (sw_box_tree){.nodes = NULL};
  out->nodes = sw_alloc(2 * count, sizeof *out->nodes);
  out->order = sw_alloc(count, sizeof *out->order);
  sw_status status = out->nodes && out->order && (centres || own) ? SW_OK : SW_ENOMEM;
  if (status == SW_OK && count > 0) {
    builder b = {
        .tree = out, .boxes = boxes, .centres = centres ? centres : own, .order = out->order};
    if (!centres) find_centres(boxes, count, own);
    for (size_t i = 0; i < count; i++) out->order[i] = (int)i;
    split(&b, 0, (int)count - 1);
    if (b.stopped) status = SW_EINTR;
  }
  sw_free(own);
  if (status != SW_OK) sw_box_tree_free(out);
  return status;
}

void sw_box_tree_free(sw_box_tree *tree) {
  sw_free(tree->nodes);
  sw_free(tree->order);
  *tree = (sw_box_tree){.nodes = NULL};
}

void sw_box_tree_refit(sw_box_tree *tree, const sw_bounds *boxes) {
  for (size_t i = tree->node_count; i-- > 0;) { /* children come after their parents */
    sw_tree_node *n = &tree->nodes[i];
    if (n->count > 0) {
      n->bounds = bounds_of(boxes, tree->order, n->first, n->first + n->count - 1);
      continue;
    }
    n->bounds = tree->nodes[i + 1].bounds;
    widen(&n->bounds, tree->nodes[n->first].bounds.min, tree->nodes[n->first].bounds.max);
  }
}

size_t sw_box_tree_find(const sw_box_tree *tree, const sw_bounds *boxes, const sw_bounds *near,
                        int *out, size_t *looks) {
  int stack[SW_TREE_DEPTH], top = 0;
  size_t found = 0;
  if (tree->node_count) stack[top++] = 0;
  while (top > 0) {
    const int number = stack[--top];
    const sw_tree_node *node = &tree->nodes[number];
    ++*looks;
    if (!sw_bounds_meet(&node->bounds, near)) continue;
    for (int i = 0; i < node->count; i++) {
      const int thing = tree->order[node->first + i];
      ++*looks;
      if (sw_bounds_meet(&boxes[thing], near)) out[found++] = thing;
    }
    if (node->count > 0) continue;
    stack[top++] = node->first;
    stack[top++] = number + 1;
  }
  return found;
}
