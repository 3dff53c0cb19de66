/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh files: what is looked at before one is read, and who reads it. */
#ifndef SW_SHAPE_MESH_READ_H
#define SW_SHAPE_MESH_READ_H

#include <stddef.h>

#include "base/status.h"

/* Content of a mesh file. Errors begin with the object's name. */
typedef struct sw_mesh_file {
  const char *object; /* "obstacle mesh" */
  const char *bytes;
  size_t byte_count;  /* [B] */
  const char *format; /* the file's extension without the dot */
} sw_mesh_file;

typedef struct sw_mesh_data {
  double *vertices; /* vertex_count x 3, for sw_free */
  int *indices;     /* triangle_count x 3, each below vertex_count, for sw_free */
  size_t vertex_count, triangle_count;
} sw_mesh_data;

/* Makes triangles of a file. On failure nothing is held. */
typedef sw_status (*sw_mesh_reader)(const sw_mesh_file *file, sw_mesh_data *out, sw_error *err);

/* Is all there that the file says it has? Looks at what the format declares: counts of points and
 * triangles, lengths, closing words. A file that was cut off is found here, before anything is
 * made as large as it says. Not every damage shows; SW_OK promises nothing. */
sw_status sw_mesh_check(const sw_mesh_file *file, sw_error *err);

/* By Assimp in this process, which a damaged file may end. Nothing else is opened, whatever the
 * file refers to. */
sw_status sw_mesh_read(const sw_mesh_file *file, sw_mesh_data *out, sw_error *err);

/* Who reads the mesh files from now on; sw_mesh_read when nobody was set. */
void sw_mesh_set_reader(sw_mesh_reader reader);
sw_mesh_reader sw_mesh_get_reader(void);

#endif
