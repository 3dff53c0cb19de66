/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tree of bounding boxes over things with boxes: a mesh's triangles, a scene's obstacles. Each node
 * is halved by count along the longest axis of the centres, so the depth grows with the logarithm
 * of the count. */
#ifndef SW_SHAPE_TREE_H
#define SW_SHAPE_TREE_H

#include "shape/shape.h"

enum {
  SW_TREE_LEAF = 4,  /* most things in a leaf [-] */
  SW_TREE_DEPTH = 64 /* above the depth of any tree [-] */
};

typedef struct sw_tree_node {
  sw_bounds bounds;
  int first; /* leaf: first thing; inner node: right child (the left one follows) */
  int count; /* things in a leaf; 0 for an inner node */
} sw_tree_node;

typedef struct sw_box_tree {
  sw_tree_node *nodes; /* (2 count) the root first */
  size_t node_count;
  int *order; /* (count) numbers of the things, in leaf order */
} sw_box_tree;

/* Makes a tree of things with these boxes (count), split by their centres (count x 3); centres
 * NULL: the boxes' centres. All must be finite. On SW_ENOMEM or SW_EINTR nothing stays
 * allocated. */
sw_status sw_box_tree_new(const sw_bounds *boxes, const double *centres, size_t count,
                          sw_box_tree *out);
void sw_box_tree_free(sw_box_tree *tree);

/* Updates the tree to new boxes of the same things. */
void sw_box_tree_refit(sw_box_tree *tree, const sw_bounds *boxes);

/* Finds the things whose boxes meet `near`, in no order; out has room for all of them. Returns
 * their number; adds the number of boxes tested to *looks. */
size_t sw_box_tree_find(const sw_box_tree *tree, const sw_bounds *boxes, const sw_bounds *near,
                        int *out, size_t *looks);

#endif
