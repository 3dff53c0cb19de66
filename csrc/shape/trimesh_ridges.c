/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The convex edges and corners of a mesh, as lines and points for contact. */
#include "shape/meshed.h"

/* Sine of the angle between an edge's faces. Below LEVEL the faces are one face, rounded by the
 * file. Below BLUNT (25 degrees) they approximate a round surface [-]. */
static const double LEVEL = 0.01, BLUNT = 0.42;

static int sticks_out(const sw_trimesh_edge *edge) {
  return (edge->flags & SW_CONVEX) && edge->sine > LEVEL;
}

int sw_meshed_faceted(const sw_shape *shape) {
  const sw_trimesh *mesh = sw_trimesh_of(shape);
  for (size_t e = 0; e < mesh->edge_count; e++)
    if (sticks_out(&mesh->edges[e]) && mesh->edges[e].sine < BLUNT) return 1;
  return 0;
}

sw_sharp sw_meshed_sharp(const sw_shape *shape, int feature, sw_vec *along) {
  const sw_trimesh *mesh = sw_trimesh_of(shape);
  const int edge = feature - sw_trimesh_edge_feature(mesh, 0);
  const int corner = feature - sw_trimesh_corner_feature(mesh, 0);
  if (corner >= 0) return mesh->corners[corner].flags & SW_CONVEX ? SW_SHARP_CORNER : SW_SHARP_NOT;
  if (edge < 0 || !sticks_out(&mesh->edges[edge])) return SW_SHARP_NOT;
  const int *v = mesh->edges[edge].v;
  *along = sw_unit_or(sw_sub(sw_trimesh_vertex(mesh, v[1]), sw_trimesh_vertex(mesh, v[0])),
                      sw_v(1, 0, 0));
  return SW_SHARP_EDGE;
}

typedef struct tour {
  const sw_trimesh *mesh;
  sw_ridge_visit visit;
  void *user;
} tour;

static void show_edge(const tour *t, int number) {
  const sw_trimesh_edge *edge = &t->mesh->edges[number];
  const sw_vec from = sw_trimesh_vertex(t->mesh, edge->v[0]);
  const sw_vec along = sw_sub(sw_trimesh_vertex(t->mesh, edge->v[1]), from);
  const double length = sw_norm(along);
  if (!sticks_out(edge) || !(length > 0)) return;
  const sw_ridge r = {.sharp = SW_SHARP_EDGE,
                      .feature = sw_trimesh_edge_feature(t->mesh, number),
                      .from = from,
                      .along = sw_scale(along, 1.0 / length),
                      .length = length};
  t->visit(t->user, &r);
}

/* Visits the edges and corners that this triangle owns. */
static void show(void *context, int tri) {
  const tour *t = context;
  for (size_t i = 3 * (size_t)tri; i < 3 * (size_t)tri + 3; i++) {
    const int edge = t->mesh->sides[i], v = t->mesh->indices[i];
    if (t->mesh->edges[edge].tri[0] == tri) show_edge(t, edge);
    const sw_trimesh_corner *corner = &t->mesh->corners[v];
    if (corner->owner != tri || !(corner->flags & SW_CONVEX)) continue;
    const sw_ridge r = {.sharp = SW_SHARP_CORNER,
                        .feature = sw_trimesh_corner_feature(t->mesh, v),
                        .from = sw_trimesh_vertex(t->mesh, v)};
    t->visit(t->user, &r);
  }
}

void sw_meshed_ridges(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                      void *user) {
  tour t = {sw_trimesh_of(shape), visit, user};
  sw_trimesh_near(t.mesh, a, b, reach, show, &t);
}

/* 1 if n points away from the edge's faces. A border of an open surface can be touched from both
 * sides. */
static int off_edge(const sw_trimesh_edge *edge, sw_vec n, double share) {
  const double most = share * edge->sine;
  if (!(sw_dot(n, edge->into[0]) <= most)) return 0;
  if (edge->tri[1] < 0) return 1;
  return sw_dot(n, edge->into[1]) <= most && sw_dot(n, edge->normal) > 0;
}

static int off_corner(const sw_trimesh *mesh, int v, sw_vec n, double share) {
  const sw_trimesh_corner *corner = &mesh->corners[v];
  const sw_vec p = sw_trimesh_vertex(mesh, v);
  for (int i = 0; i < corner->count; i++) {
    const sw_trimesh_edge *edge = &mesh->edges[mesh->corner_edges[corner->first + i]];
    const int other = edge->v[0] == v ? edge->v[1] : edge->v[0];
    const sw_vec along = sw_sub(sw_trimesh_vertex(mesh, other), p);
    if (!(sw_dot(n, along) <= share * edge->sine * sw_norm(along))) return 0;
  }
  return 1;
}

int sw_meshed_points_out(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share) {
  const sw_trimesh *mesh = sw_trimesh_of(shape);
  if (ridge->sharp == SW_SHARP_EDGE)
    return off_edge(&mesh->edges[ridge->feature - sw_trimesh_edge_feature(mesh, 0)], n, share);
  return off_corner(mesh, ridge->feature - sw_trimesh_corner_feature(mesh, 0), n, share);
}
