/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tree over a mesh's triangles. */
#include <string.h>

#include "base/alloc.h"
#include "shape/trimesh.h"

static sw_bounds box_of(const sw_triangle *t) {
  const sw_vec a = t->v[0], b = t->v[1], c = t->v[2];
  return (sw_bounds){
      sw_v(fmin(fmin(a.x, b.x), c.x), fmin(fmin(a.y, b.y), c.y), fmin(fmin(a.z, b.z), c.z)),
      sw_v(fmax(fmax(a.x, b.x), c.x), fmax(fmax(a.y, b.y), c.y), fmax(fmax(a.z, b.z), c.z))};
}

/* Puts the triangles into leaf order. */
static void reorder(sw_trimesh *mesh, const int *order, int *indices, double *normals) {
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    memcpy(indices + 3 * i, mesh->indices + 3 * (size_t)order[i], 3 * sizeof *indices);
    memcpy(normals + 3 * i, mesh->normals + 3 * (size_t)order[i], 3 * sizeof *normals);
  }
  sw_free(mesh->indices), sw_free(mesh->normals);
  mesh->indices = indices, mesh->normals = normals;
}

sw_status sw_trimesh_tree(sw_trimesh *mesh) {
  const size_t n = mesh->triangle_count;
  sw_box_tree tree = {.count = 0};
  double *centres = sw_alloc(3 * n, sizeof *centres), *normals = sw_alloc(3 * n, sizeof *normals);
  int *indices = sw_alloc(3 * n, sizeof *indices);
  sw_bounds *boxes = (sw_bounds *)sw_alloc(n, sizeof *boxes);
  sw_status status = centres && normals && indices && boxes ? SW_OK : SW_ENOMEM;
  for (size_t i = 0; status == SW_OK && i < n; i++) {
    const sw_triangle t = sw_trimesh_triangle(mesh, (int)i);
    boxes[i] = box_of(&t);
    sw_store(centres + 3 * i, sw_scale(sw_add(sw_add(t.v[0], t.v[1]), t.v[2]), 1.0 / 3));
  }
  if (status == SW_OK) status = sw_box_tree_new(boxes, centres, n, &tree);
  if (status == SW_OK) {
    reorder(mesh, tree.order, indices, normals);
    mesh->nodes = tree.nodes, mesh->node_count = tree.node_count;
    tree.nodes = NULL;
  } else {
    sw_free(normals), sw_free(indices);
  }
  sw_box_tree_free(&tree);
  sw_free(centres), sw_free(boxes);
  return status;
}
