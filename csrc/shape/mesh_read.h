/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh files: checks before reading, and the choice of the reader. */
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

/* Makes triangles from a file. On failure nothing is allocated. */
typedef sw_status (*sw_mesh_reader)(const sw_mesh_file *file, sw_mesh_data *out, sw_error *err);

/* Checks that a file has all the data it declares: counts of points and triangles, lengths, closing
 * words. This finds truncated files before memory of the declared size is allocated. Not all damage
 * is found: SW_OK promises nothing. */
sw_status sw_mesh_check(const sw_mesh_file *file, sw_error *err);

/* Such checks of OFF files, in which Assimp reads wrong indices and words as other points, in
 * silence, and of PLY files. */
sw_status sw_mesh_check_off(const sw_mesh_file *file, sw_error *err);
sw_status sw_mesh_check_ply(const sw_mesh_file *file, sw_error *err);
/* SW_EFORMAT for a damaged file; why: by a printf format. */
__attribute__((format(printf, 3, 4))) sw_status sw_mesh_unreadable(const sw_mesh_file *file,
                                                                   sw_error *err, const char *why,
                                                                   ...);

/* Reads a file by Assimp in this process; a damaged file may crash the process. No other file is
 * opened, whatever the file refers to. */
sw_status sw_mesh_read(const sw_mesh_file *file, sw_mesh_data *out, sw_error *err);

/* Sets the reader of mesh files; NULL restores sw_mesh_read, the default. */
void sw_mesh_set_reader(sw_mesh_reader reader);
sw_mesh_reader sw_mesh_get_reader(void);

#endif
