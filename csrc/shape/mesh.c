/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangle mesh. A closed one is solid inside; an open one is a sheet whose
 * back counts as inside for places nearer to its triangles than to its border,
 * and within its bounds or within reach. */
#include "base/alloc.h"
#include "shape/mesh_read.h"
#include "shape/trimesh.h"

typedef struct mesh {
  sw_shape base;
  sw_trimesh mesh;
} mesh;

typedef struct mesh_args {
  int format;   /* index into formats */
  double scale; /* [-] */
} mesh_args;

static const char object[] = "obstacle mesh";
static const char *const formats[] = {"stl", "obj", "ply", "off", "glb", "gltf", NULL};

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source,
                        sw_error *err) {
  mesh *self = (mesh *)shape;
  const mesh_args *given = args;
  sw_mesh_data data;
  if (!source->bytes || source->byte_count == 0)
    return sw_fail(err, SW_EINVAL, "%s: data is empty", object);
  const sw_mesh_file file = {object, source->bytes, source->byte_count, formats[given->format]};
  SW_TRY(sw_mesh_check(&file, err));
  SW_TRY(sw_mesh_get_reader()(&file, &data, err));
  for (size_t i = 0; i < 3 * data.vertex_count; i++) data.vertices[i] *= given->scale;
  const sw_status status = sw_trimesh_build(&self->mesh, object, data.vertices, data.vertex_count,
                                            data.indices, data.triangle_count, err);
  sw_free(data.vertices), sw_free(data.indices);
  shape->bounds = self->mesh.bounds;
  return status;
}

static void destroy(sw_shape *shape) { sw_trimesh_free(&((mesh *)shape)->mesh); }

static int distance(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  return sw_trimesh_distance(&((const mesh *)shape)->mesh, p, reach, out);
}

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  return sw_trimesh_segment(&((const mesh *)shape)->mesh, a, b, reach, out);
}

static int sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when) {
  return sw_trimesh_sweep(&((const mesh *)shape)->mesh, path, out, when);
}

static sw_status triangles(const sw_shape *shape, int around, sw_triangles *out) {
  (void)around;
  return sw_trimesh_triangles(&((const mesh *)shape)->mesh, out);
}

static void bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  sw_trimesh_bones(&((const mesh *)shape)->mesh, visit, user);
}

static sw_sharp sharp(const sw_shape *shape, int feature, sw_vec *along) {
  return sw_trimesh_sharp(&((const mesh *)shape)->mesh, feature, along);
}

static int faceted(const sw_shape *shape) {
  return sw_trimesh_faceted(&((const mesh *)shape)->mesh);
}

static void ridges(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                   void *user) {
  sw_trimesh_ridges(&((const mesh *)shape)->mesh, a, b, reach, visit, user);
}

static int points_out(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share) {
  return sw_trimesh_points_out(&((const mesh *)shape)->mesh, ridge, n, share);
}

static const sw_param rows[] = {
    {"data", SW_PARAM_OTHER, "-", NAN, -INFINITY, INFINITY, SW_PARAM_REQUIRED, NULL, 0,
     "content of a mesh file, as meshfile.read gives it"},
    {"format", SW_PARAM_CHOICE, "-", NAN, -INFINITY, INFINITY, SW_PARAM_REQUIRED, formats,
     offsetof(mesh_args, format), "kind of file the data comes from"},
    {"scale", SW_PARAM_NUMBER, "-", 1, 0, SW_SHAPE_LARGEST, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(mesh_args, scale), "metres per unit of the file, 0.001 for millimetres"},
};

static const sw_shape_wrong wrong[] = {{"data = '', format = 'obj'", "data is empty"},
                                       {"data = 'x', format = 'dwg'", "format"},
                                       {NULL, NULL}};

const sw_shape_class sw_shape_class_mesh = {
    .kind = "mesh",
    .summary = "triangles of a mesh file, closed or a sheet",
    .sample =
        "data = 'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nv 0 0 1\\nf 1 3 2\\nf 1 2 4\\nf 1 4 3\\nf 2 3 "
        "4\\n', format = 'obj'",
    .wrong = wrong,
    .traits = SW_SHAPE_FACED | SW_SHAPE_LISTED,

    .params = SW_PARAMS(object, rows),
    .args_size = sizeof(mesh_args),
    .size = sizeof(mesh),
    .create = create,
    .destroy = destroy,
    .distance = distance,
    .segment = segment,
    .sweep = sweep,
    .triangles = triangles,
    .bones = bones,
    .sharp = sharp,
    .faceted = faceted,
    .ridges = ridges,
    .points_out = points_out};
