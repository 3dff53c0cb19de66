/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tree of bounding boxes over a mesh's triangles: halves by count along the
 * longest axis of the centres, so that its depth is the count's logarithm. */
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "shape/trimesh.h"

typedef struct builder {
  sw_trimesh *mesh;
  const double *centres; /* of the triangles, x 3 [m] */
  int *order;            /* triangle numbers, sorted in place */
  int stopped;           /* 1: the user wants to stop */
} builder;

static inline double key(const builder *b, int i, int axis) {
  return b->centres[3 * (size_t)b->order[i] + (size_t)axis];
}

static inline void swap(int *order, int i, int j) {
  const int kept = order[i];
  order[i] = order[j], order[j] = kept;
}

/* Reorder [low, high] so that no key before `middle` is above one after it. */
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

static void widen(sw_bounds *box, sw_vec p) {
  box->min = sw_v(fmin(box->min.x, p.x), fmin(box->min.y, p.y), fmin(box->min.z, p.z));
  box->max = sw_v(fmax(box->max.x, p.x), fmax(box->max.y, p.y), fmax(box->max.z, p.z));
}

static const sw_bounds nothing = {{INFINITY, INFINITY, INFINITY},
                                  {-INFINITY, -INFINITY, -INFINITY}};

static int longest_axis(const builder *b, int low, int high) {
  sw_bounds box = nothing;
  for (int i = low; i <= high; i++) widen(&box, sw_load(b->centres + 3 * (size_t)b->order[i]));
  const sw_vec e = sw_sub(box.max, box.min);
  return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
}

static sw_bounds bounds_of(const builder *b, int low, int high) {
  sw_bounds box = nothing;
  for (int i = low; i <= high; i++)
    for (int k = 0; k < 3; k++)
      widen(&box,
            sw_trimesh_vertex(b->mesh, b->mesh->indices[3 * (size_t)b->order[i] + (size_t)k]));
  return box;
}

static void split(builder *b, int low, int high) {
  b->stopped |= sw_interrupted();
  if (b->stopped) return;
  sw_tree_node *node = &b->mesh->nodes[b->mesh->node_count++];
  node->bounds = bounds_of(b, low, high);
  if (high - low < SW_TREE_LEAF) {
    node->first = low, node->count = high - low + 1;
    return;
  }
  const int middle = low + (high - low + 1) / 2;
  select_middle(b, low, high, middle, longest_axis(b, low, high));
  split(b, low, middle - 1);
  node->first = (int)b->mesh->node_count;
  split(b, middle, high);
}

/* Put the triangles themselves into the order of the leaves. */
static void reorder(builder *b, int *indices, double *normals) {
  sw_trimesh *mesh = b->mesh;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    memcpy(indices + 3 * i, mesh->indices + 3 * (size_t)b->order[i], 3 * sizeof *indices);
    memcpy(normals + 3 * i, mesh->normals + 3 * (size_t)b->order[i], 3 * sizeof *normals);
  }
  sw_free(mesh->indices), sw_free(mesh->normals);
  mesh->indices = indices, mesh->normals = normals;
}

sw_status sw_trimesh_tree(sw_trimesh *mesh) {
  const size_t n = mesh->triangle_count;
  double *centres = sw_alloc(3 * n, sizeof *centres), *normals = sw_alloc(3 * n, sizeof *normals);
  int *order = sw_alloc(n, sizeof *order), *indices = sw_alloc(3 * n, sizeof *indices);
  mesh->nodes = sw_alloc(2 * n, sizeof *mesh->nodes);
  sw_status status = SW_OK;
  const int fine = centres && normals && order && indices && mesh->nodes;
  if (fine) {
    builder b = {.mesh = mesh, .centres = centres, .order = order};
    for (size_t i = 0; i < n; i++) {
      const sw_triangle t = sw_trimesh_triangle(mesh, (int)i);
      sw_store(centres + 3 * i, sw_scale(sw_add(sw_add(t.v[0], t.v[1]), t.v[2]), 1.0 / 3));
      order[i] = (int)i;
    }
    split(&b, 0, (int)n - 1);
    reorder(&b, indices, normals);
    if (b.stopped) status = SW_EINTR;
  } else {
    sw_free(normals), sw_free(indices);
  }
  sw_free(centres), sw_free(order);
  return fine ? status : SW_ENOMEM;
}
