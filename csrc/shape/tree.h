/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tree of bounding boxes over things that have boxes: a mesh's triangles, a scene's obstacles.
 * Halves by count along the longest axis of the centres, so that its depth is the count's
 * logarithm. */
#ifndef SW_SHAPE_TREE_H
#define SW_SHAPE_TREE_H

#include "shape/shape.h"

enum {
  SW_TREE_LEAF = 4,  /* most things in a leaf [-] */
  SW_TREE_DEPTH = 64 /* more than any tree's depth [-] */
};

typedef struct sw_tree_node {
  sw_bounds bounds;
  int first; /* leaf: first thing; else the right child (the left one follows) */
  int count; /* things of a leaf; 0 for an inner node */
} sw_tree_node;

typedef struct sw_box_tree {
  sw_tree_node *nodes; /* (2 count) the root first */
  size_t node_count;
  int *order; /* (count) numbers of the things, in the order of the leaves */
  size_t count;
} sw_box_tree;

/* Over things with these boxes (count), by their centres (count x 3), or by those of the boxes
 * where NULL is given. All must be finite. SW_ENOMEM, SW_EINTR: nothing is left behind. */
sw_status sw_box_tree_new(const sw_bounds *boxes, const double *centres, size_t count,
                          sw_box_tree *out);
void sw_box_tree_free(sw_box_tree *tree);

/* The things have other boxes now. */
void sw_box_tree_refit(sw_box_tree *tree, const sw_bounds *boxes);

/* Numbers of the things whose boxes meet this one, in no order; out has room for all. Returns how
 * many; adds to *looks the boxes that were looked at. */
size_t sw_box_tree_find(const sw_box_tree *tree, const sw_bounds *boxes, const sw_bounds *near,
                        int *out, size_t *looks);

#endif
