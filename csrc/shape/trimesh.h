/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A triangle surface with the data for exact signed queries: neighbours, normals of faces, edges
 * and corners, and a tree of bounding boxes. Flat arrays, built once; queries allocate nothing.
 * Shared by meshes and hulls. */
#ifndef SW_SHAPE_TRIMESH_H
#define SW_SHAPE_TRIMESH_H

#include "shape/pairs.h"
#include "shape/tree.h"

enum { SW_TRIMESH_MOST = 1 << 24 }; /* most triangles or vertices [-] */

/* Flags of edges and corners. */
enum {
  SW_CONVEX = 1, /* sticks out: may touch a segment between its ends */
  SW_RIM = 2     /* on the border of an open surface */
};

typedef struct sw_trimesh_edge {
  int v[2];   /* vertices, the smaller number first */
  int tri[2]; /* adjacent triangles; the second is -1 on a border */
  int flags;
  double sine;    /* of the angle between its faces [-] */
  sw_vec normal;  /* unit mean of the normals of its faces [-] */
  sw_vec into[2]; /* unit vectors across the edge into both faces [-] */
} sw_trimesh_edge;

typedef struct sw_trimesh_corner {
  sw_vec normal; /* mean of the face normals, weighted by angle [-] */
  sw_vec into;   /* unit mean direction into the surface [-] */
  int owner;     /* the one triangle that reports it in queries */
  int flags;
  int first; /* its edges start here in corner_edges */
  int count;
} sw_trimesh_corner;

typedef struct sw_trimesh {
  size_t vertex_count, triangle_count, edge_count, node_count;
  double *vertices;           /* vertex_count x 3 [m] */
  int *indices;               /* triangle_count x 3, in leaf order of the tree */
  int *sides;                 /* triangle_count x 3: the edge from corner k to k + 1 */
  double *normals;            /* triangle_count x 3, unit [-] */
  sw_trimesh_edge *edges;     /* edge_count */
  sw_trimesh_corner *corners; /* vertex_count */
  int *corner_edges;          /* 2 x edge_count */
  sw_tree_node *nodes;        /* node_count, the root first */
  sw_bounds bounds;
  double size;                /* largest extent [m] */
  double facet, facet_radius; /* as sw_shape_facet [m] */
  int open;                   /* 1: it has a border */
  int hollow;                 /* 1: it is not convex, so a point may be near several faces */
} sw_trimesh;

/* Builds a mesh from cleaned copies of the triangles: coinciding vertices are joined, triangles
 * without area and copies of triangles are dropped. object is for error texts. */
sw_status sw_trimesh_build(sw_trimesh *mesh, const char *object, const double *vertices,
                           size_t vertex_count, const int *indices, size_t triangle_count,
                           sw_error *err);
void sw_trimesh_free(sw_trimesh *mesh);

/* Parts of the build. The first drops triangles that are there twice, and fails if one is there in
 * both windings. numbers: the triangles' numbers in the file, counted from 0. */
sw_status sw_trimesh_drop_repeats(sw_trimesh *mesh, const char *object, int *numbers,
                                  sw_error *err);
sw_status sw_trimesh_topology(sw_trimesh *mesh, const char *object, sw_error *err);
/* Fails if a closed surface faces inwards, unless it bounds a cavity within another one. */
sw_status sw_trimesh_check_shells(const sw_trimesh *mesh, const char *object, sw_error *err);

/* Returns what sw_shape_facet tells of a mesh whose topology is known [m]. */
double sw_trimesh_facet(const sw_trimesh *mesh, double *radius);

/* Calls visit for every triangle in leaves whose box, widened by reach on all sides, meets the
 * segment a-b. */
typedef void (*sw_trimesh_visit)(void *context, int tri);
void sw_trimesh_near(const sw_trimesh *mesh, sw_vec a, sw_vec b, double reach,
                     sw_trimesh_visit visit, void *context);

/* The queries of shape.h. */
int sw_trimesh_distance(const sw_trimesh *mesh, sw_vec p, double reach, sw_closest *out);
int sw_trimesh_segment(const sw_trimesh *mesh, sw_vec a, sw_vec b, double reach, sw_closest *out);
int sw_trimesh_sweep(const sw_trimesh *mesh, const sw_sweep *path, sw_closest *out, double *when);

/* Features are numbered triangles first, then edges, then corners. */
static inline int sw_trimesh_edge_feature(const sw_trimesh *mesh, int edge) {
  return (int)mesh->triangle_count + edge;
}
static inline int sw_trimesh_corner_feature(const sw_trimesh *mesh, int corner) {
  return (int)(mesh->triangle_count + mesh->edge_count) + corner;
}
static inline sw_vec sw_trimesh_vertex(const sw_trimesh *mesh, int v) {
  return sw_load(mesh->vertices + 3 * (size_t)v);
}
static inline sw_triangle sw_trimesh_triangle(const sw_trimesh *mesh, int tri) {
  const int *at = mesh->indices + 3 * (size_t)tri;
  return (sw_triangle){{sw_trimesh_vertex(mesh, at[0]), sw_trimesh_vertex(mesh, at[1]),
                        sw_trimesh_vertex(mesh, at[2])},
                       sw_load(mesh->normals + 3 * (size_t)tri)};
}

#endif
