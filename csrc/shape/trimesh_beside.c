/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Further near places of a point outside a mesh with hollows, as in a groove: the nearest place of
 * each flank is a local minimum of the distance. On a face it lies straight above its foot; from an
 * edge or a corner it leads out of all faces that meet there. */
#include "shape/meshed.h"

typedef struct query {
  const sw_trimesh *mesh;
  sw_vec p;
  double reach;            /* [m] */
  const sw_closest *first; /* the nearest place */
  sw_closest *out;
  int count;
} query;

/* Places whose normals differ by less are one place: 1 minus the cosine of 0.08 degrees [-]. */
static const double SAME_WAY = 1e-6;

static int is_known(const query *q, sw_vec n) {
  int known = sw_dot(q->first->normal, n) > 1 - SAME_WAY;
  for (int i = 0; i < q->count; i++) known |= sw_dot(q->out[i].normal, n) > 1 - SAME_WAY;
  return known;
}

/* 1 if w, from the edge or corner to the point, leads out of the faces that meet there. */
static int leads_out_of_edge(const sw_trimesh_edge *edge, sw_vec w) {
  if (!(edge->flags & SW_CONVEX) || edge->tri[1] < 0) return 0;
  return sw_dot(w, edge->into[0]) <= 0 && sw_dot(w, edge->into[1]) <= 0;
}

static int leads_out_of_corner(const sw_trimesh *mesh, int v, sw_vec w) {
  const sw_trimesh_corner *corner = &mesh->corners[v];
  if (!(corner->flags & SW_CONVEX) || corner->flags & SW_RIM) return 0;
  for (int i = 0; i < corner->count; i++) {
    const sw_trimesh_edge *edge = &mesh->edges[mesh->corner_edges[corner->first + i]];
    const int other = edge->v[0] == v ? edge->v[1] : edge->v[0];
    const sw_vec along = sw_sub(sw_trimesh_vertex(mesh, other), sw_trimesh_vertex(mesh, v));
    if (sw_dot(w, along) > 0) return 0;
  }
  return 1;
}

/* Keeps the nearest ones, in order. */
static void insert(query *q, const sw_closest *c) {
  if (q->count == SW_CLOSEST_MAX && q->out[q->count - 1].gap <= c->gap) return;
  int place = q->count < SW_CLOSEST_MAX ? q->count++ : q->count - 1;
  for (; place > 0 && q->out[place - 1].gap > c->gap; place--) q->out[place] = q->out[place - 1];
  q->out[place] = *c;
}

static void try_triangle(void *context, int tri) {
  query *q = context;
  const sw_trimesh *mesh = q->mesh;
  const sw_triangle t = sw_trimesh_triangle(mesh, tri);
  const double height = sw_dot(t.n, sw_sub(q->p, t.v[0]));
  int part = SW_ON_FACE, feature = tri;
  if (!(height > 0 && height < q->reach)) return;
  const sw_vec at = sw_pair_triangle(&t, q->p, &part), w = sw_sub(q->p, at);
  if (part >= SW_ON_CORNER) {
    const int v = mesh->indices[3 * tri + (part - SW_ON_CORNER)];
    if (!leads_out_of_corner(mesh, v, w)) return;
    feature = sw_trimesh_corner_feature(mesh, v);
  } else if (part >= SW_ON_SIDE) {
    const int side = mesh->sides[3 * tri + (part - SW_ON_SIDE)];
    if (!leads_out_of_edge(&mesh->edges[side], w)) return;
    feature = sw_trimesh_edge_feature(mesh, side);
  }
  const double gap = part == SW_ON_FACE ? height : sw_norm(w);
  if (!(gap > 0 && gap < q->reach)) return;
  const sw_vec n = part == SW_ON_FACE ? t.n : sw_scale(w, 1.0 / gap);
  const sw_closest place = {gap, 0, n, at, feature};
  if (!is_known(q, n)) insert(q, &place);
}

int sw_meshed_beside(const sw_shape *shape, sw_vec p, double reach, const sw_closest *nearest,
                     sw_closest *out) {
  const sw_trimesh *mesh = sw_trimesh_of(shape);
  query q = {.mesh = mesh, .p = p, .reach = reach, .first = nearest, .out = out};
  if (!mesh->hollow || !(nearest->gap > 0)) return 0;
  sw_trimesh_near(mesh, p, p, reach, try_triangle, &q);
  return q.count;
}
