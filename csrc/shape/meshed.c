/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of shapes whose surface is a triangle mesh. */
#include "shape/meshed.h"

int sw_meshed_distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  return sw_trimesh_distance(&((const sw_meshed *)shape)->mesh, p, reach, out);
}

sw_status sw_meshed_triangles(const sw_shape *shape, int around, sw_triangles *out) {
  (void)around;
  return sw_trimesh_triangles(&((const sw_meshed *)shape)->mesh, out);
}

void sw_meshed_bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  sw_trimesh_bones(&((const sw_meshed *)shape)->mesh, visit, user);
}

sw_sharp sw_meshed_sharp(const sw_shape *shape, int feature, sw_vec *along) {
  return sw_trimesh_sharp(&((const sw_meshed *)shape)->mesh, feature, along);
}

int sw_meshed_faceted(const sw_shape *shape) {
  return sw_trimesh_faceted(&((const sw_meshed *)shape)->mesh);
}

void sw_meshed_ridges(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                      void *user) {
  sw_trimesh_ridges(&((const sw_meshed *)shape)->mesh, a, b, reach, visit, user);
}

int sw_meshed_points_out(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share) {
  return sw_trimesh_points_out(&((const sw_meshed *)shape)->mesh, ridge, n, share);
}
