/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Signed distance of a point from a mesh: the nearest triangle by branch and bound, the sign by the
 * normal of the nearest face, edge or corner. */
#include "shape/meshed.h"

typedef struct nearest {
  double d2; /* squared distance [m2] */
  sw_vec q;  /* [m] */
  int tri, part;
} nearest;

static inline double box_distance2(const sw_bounds *box, sw_vec p) {
  const double x = fmax(fmax(box->min.x - p.x, p.x - box->max.x), 0);
  const double y = fmax(fmax(box->min.y - p.y, p.y - box->max.y), 0);
  const double z = fmax(fmax(box->min.z - p.z, p.z - box->max.z), 0);
  return x * x + y * y + z * z;
}

static void search_leaf(const sw_trimesh *mesh, const sw_tree_node *leaf, sw_vec p, nearest *best) {
  for (int tri = leaf->first; tri < leaf->first + leaf->count; tri++) {
    const sw_triangle t = sw_trimesh_triangle(mesh, tri);
    int part = SW_ON_FACE;
    const double height = sw_dot(t.n, sw_sub(p, t.v[0]));
    if (height * height >= best->d2) continue;
    const sw_vec q = sw_pair_triangle(&t, p, &part);
    const double d2 = part == SW_ON_FACE ? height * height : sw_norm2(sw_sub(p, q));
    if (d2 < best->d2) *best = (nearest){d2, q, tri, part};
  }
}

/* Finds the nearest triangle. best->d2 is the squared limit on entry; best->tri stays -1 if no
 * triangle is nearer. */
static void search(const sw_trimesh *mesh, sw_vec p, nearest *best) {
  struct {
    int node;
    double d2;
  } stack[SW_TREE_DEPTH];
  int top = 0, node = 0;
  for (;;) {
    const sw_tree_node *at = &mesh->nodes[node];
    if (at->count > 0) {
      search_leaf(mesh, at, p, best);
      do {
        if (top == 0) return;
        top--;
      } while (stack[top].d2 >= best->d2);
      node = stack[top].node;
      continue;
    }
    const int left = node + 1, right = at->first;
    const double dl = box_distance2(&mesh->nodes[left].bounds, p);
    const double dr = box_distance2(&mesh->nodes[right].bounds, p);
    const int far = dl <= dr ? right : left;
    node = dl <= dr ? left : right;
    stack[top].node = far;
    stack[top++].d2 = fmax(dl, dr);
  }
}

/* 1 if p is beyond the border of an open surface. There is no inside there: the sign is plus unless
 * p is nearly straight above or below the border. */
static int off_the_rim(int flags, sw_vec into, sw_vec w, double d) {
  const double beside = -0.2; /* cosine between w and the surface [-] */
  return (flags & SW_RIM) && sw_dot(into, w) < beside * d;
}

static void sign(const sw_trimesh *mesh, sw_vec p, const nearest *best, sw_closest *out) {
  const double touching = 1e-11; /* share of the size below which w has no direction [-] */
  const size_t tri = (size_t)best->tri;
  const sw_vec w = sw_sub(p, best->q);
  const double d = sqrt(best->d2);
  sw_vec n = sw_load(mesh->normals + 3 * tri), into;
  int flags, feature = best->tri;
  if (best->part == SW_ON_FACE) {
    *out = (sw_closest){sw_dot(n, w) < 0 ? -d : d, 0, n, best->q, feature};
    return;
  }
  if (best->part < SW_ON_CORNER) {
    const int number = mesh->sides[3 * tri + (size_t)(best->part - SW_ON_SIDE)];
    const sw_trimesh_edge *edge = &mesh->edges[number];
    feature = sw_trimesh_edge_feature(mesh, number);
    n = edge->normal, into = edge->into[0], flags = edge->flags;
  } else {
    const int v = mesh->indices[3 * tri + (size_t)(best->part - SW_ON_CORNER)];
    feature = sw_trimesh_corner_feature(mesh, v);
    n = mesh->corners[v].normal, into = mesh->corners[v].into, flags = mesh->corners[v].flags;
  }
  const double side = sw_dot(n, w) >= 0 || off_the_rim(flags, into, w, d) ? 1 : -1;
  if (d > touching * mesh->size) n = sw_scale(w, side / d);
  *out = (sw_closest){side * d, 0, n, best->q, feature};
}

int sw_trimesh_distance(const sw_trimesh *mesh, sw_vec p, double reach, sw_closest *out) {
  const double outside2 = box_distance2(&mesh->bounds, p);
  if (outside2 > 0 && (!(reach > 0) || outside2 >= reach * reach)) return 0;
  /* A point outside the bounds cannot be deep inside, so reach limits the search. */
  const double limit2 = outside2 > 0 ? reach * reach : HUGE_VAL;
  nearest best = {limit2, p, -1, SW_ON_FACE};
  search(mesh, p, &best);
  if (best.tri < 0) return 0;
  sign(mesh, p, &best, out);
  return out->gap < reach;
}

int sw_meshed_distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  return sw_trimesh_distance(sw_trimesh_of(shape), p, reach, out);
}
