/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangle mesh. A closed mesh is solid. An open mesh is a sheet: its back counts as inside for
 * places nearer to its triangles than to its border, within its bounds or within reach. */
#include "base/alloc.h"
#include "shape/mesh_read.h"
#include "shape/meshed.h"

typedef struct mesh_args {
  int format;   /* index into formats */
  double scale; /* [-] */
} mesh_args;

static const char object[] = "obstacle mesh";
static const char *const formats[] = {"stl", "obj", "ply", "off", "glb", "gltf", NULL};

static sw_status create(sw_shape *shape, const void *args, const sw_shape_source *source,
                        sw_error *err) {
  sw_meshed *self = (sw_meshed *)shape;
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

static void destroy(sw_shape *shape) { sw_trimesh_free(&((sw_meshed *)shape)->mesh); }

static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  return sw_trimesh_segment(sw_trimesh_of(shape), a, b, reach, out);
}

static int sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when) {
  return sw_trimesh_sweep(sw_trimesh_of(shape), path, out, when);
}

static int is_open(const sw_shape *shape) { return sw_trimesh_of(shape)->open; }

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
    .size = sizeof(sw_meshed),
    .create = create,
    .destroy = destroy,
    .distance = sw_meshed_distance,
    .beside = sw_meshed_beside,
    .segment = segment,
    .sweep = sweep,
    .triangles = sw_meshed_triangles,
    .bones = sw_meshed_bones,
    .sharp = sw_meshed_sharp,
    .faceted = sw_meshed_faceted,
    .facet = sw_meshed_facet,
    .open = is_open,
    .roundness = sw_meshed_roundness,
    .ridges = sw_meshed_ridges,
    .points_out = sw_meshed_points_out};
