/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes whose surface is a triangle mesh, and their functions of shape_class.h. */
#ifndef SW_SHAPE_MESHED_H
#define SW_SHAPE_MESHED_H

#include "shape/trimesh.h"

/* First member of such a shape. */
typedef struct sw_meshed {
  sw_shape base;
  sw_trimesh mesh;
} sw_meshed;

static inline const sw_trimesh *sw_trimesh_of(const sw_shape *shape) {
  return &((const sw_meshed *)shape)->mesh;
}

int sw_meshed_distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out);
int sw_meshed_beside(const sw_shape *shape, sw_vec p, double reach, const sw_closest *nearest,
                     sw_closest *out);
/* Copies the triangles for drawing; visits corners and edges as bones. */
sw_status sw_meshed_triangles(const sw_shape *shape, int around, sw_triangles *out);
void sw_meshed_bones(const sw_shape *shape, sw_bone_visit visit, void *user);
/* 1: some edges are so blunt that they approximate a round surface. */
int sw_meshed_faceted(const sw_shape *shape);
double sw_meshed_roundness(const sw_shape *shape);
static inline double sw_meshed_facet(const sw_shape *shape, double *radius) {
  *radius = sw_trimesh_of(shape)->facet_radius;
  return sw_trimesh_of(shape)->facet;
}
sw_sharp sw_meshed_sharp(const sw_shape *shape, int feature, sw_vec *along);
void sw_meshed_ridges(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                      void *user);
int sw_meshed_points_out(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share);

#endif
