/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The round surface that a mesh's facets approximate: its radius, and the width of the facets. */
#include "shape/meshed.h"

/* Sine of the angle between an edge's faces: from FLAT to BLUNT (25 degrees) the faces are facets
 * of a round surface [-]. */
static const double FLAT = 1e-3, BLUNT = 0.42;
/* Least share of the surface beside such edges: less are fillets of something that is not round
 * [-]. */
static const double ROUND = 0.2;

static int is_facet_edge(const sw_trimesh_edge *edge) {
  return (edge->flags & SW_CONVEX) && edge->tri[1] >= 0 && edge->sine > FLAT && edge->sine < BLUNT;
}

static double area_of(const sw_trimesh *mesh, int tri) {
  const sw_triangle t = sw_trimesh_triangle(mesh, tri);
  return 0.5 * sw_norm(sw_cross(sw_sub(t.v[1], t.v[0]), sw_sub(t.v[2], t.v[0])));
}

static double round_area(const sw_trimesh *mesh, double *all) {
  double sum = 0;
  *all = 0;
  for (size_t tri = 0; tri < mesh->triangle_count; tri++) {
    const double area = area_of(mesh, (int)tri);
    int beside = 0;
    for (size_t k = 0; k < 3; k++) beside |= is_facet_edge(&mesh->edges[mesh->sides[3 * tri + k]]);
    *all += area;
    if (beside) sum += area;
  }
  return sum;
}

/* A facet's width over the turn from facet to facet is the radius; a mean over the length of edges.
 * The width is the mean height of both triangles over the edge. */
double sw_meshed_roundness(const sw_shape *shape) {
  const sw_trimesh *mesh = sw_trimesh_of(shape);
  double all, width = 0, turn = 0;
  if (!(round_area(mesh, &all) > ROUND * all)) return 0;
  for (size_t e = 0; e < mesh->edge_count; e++) {
    const sw_trimesh_edge *edge = &mesh->edges[e];
    if (!is_facet_edge(edge)) continue;
    const double length =
        sw_dist(sw_trimesh_vertex(mesh, edge->v[0]), sw_trimesh_vertex(mesh, edge->v[1]));
    width += area_of(mesh, edge->tri[0]) + area_of(mesh, edge->tri[1]); /* times the length */
    turn += length * asin(edge->sine);
  }
  return turn > 0 ? width / turn : 0;
}

/* Sine of the angle between the faces of a hollow edge: from LEVEL on it is no rounding of the
 * file; up to STEEP (53 degrees) it is part of a hollow in facets, and not the foot of a flange
 * [-]. */
static const double LEVEL = 0.01, STEEP = 0.8;

static int is_hollow(const sw_trimesh_edge *edge) {
  return !(edge->flags & SW_CONVEX) && edge->tri[1] >= 0 && edge->sine > LEVEL &&
         edge->sine < STEEP;
}

double sw_trimesh_facet(const sw_trimesh *mesh, double *radius) {
  double width = 0, along = 0, turn = 0;
  *radius = 0;
  for (size_t e = 0; e < mesh->edge_count; e++) {
    const sw_trimesh_edge *edge = &mesh->edges[e];
    if (is_hollow(edge)) return 0;
    if (!is_facet_edge(edge) || !(edge->sine > LEVEL)) continue;
    const double length =
        sw_dist(sw_trimesh_vertex(mesh, edge->v[0]), sw_trimesh_vertex(mesh, edge->v[1]));
    along += length, turn += length * asin(edge->sine);
    width += area_of(mesh, edge->tri[0]) + area_of(mesh, edge->tri[1]); /* times the length */
  }
  if (!(along > 0)) return 0;
  *radius = width / turn;
  return width / along;
}
