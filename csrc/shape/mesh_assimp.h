/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangles from the bytes of a mesh file, by Assimp. */
#ifndef SW_SHAPE_MESH_ASSIMP_H
#define SW_SHAPE_MESH_ASSIMP_H

#include "shape/shape.h"

typedef struct sw_mesh_data {
  double *vertices; /* vertex_count x 3, for sw_free */
  int *indices;     /* triangle_count x 3, for sw_free */
  size_t vertex_count, triangle_count;
} sw_mesh_data;

/* Read a file's content; nothing else is opened, whatever it refers to. format
 * is a file extension without the dot. On failure nothing is held. */
sw_status sw_mesh_read(const char *object, const char *bytes, size_t byte_count, const char *format,
                       sw_mesh_data *out, sw_error *err);

#endif
