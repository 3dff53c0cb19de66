/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Convex hull of points. qhull makes the polytope, libccd rejects distant queries early, the mesh
 * code gives the exact answers. */
#include <string.h>

#include "base/alloc.h"
#include "shape/ccd_adapter.h"
#include "shape/hull_qhull.h"
#include "shape/meshed.h"

enum {
  FEWEST_POINTS = 4,
  MOST_POINTS = 1 << 20 /* [-] */
};

typedef struct hull {
  sw_meshed as;
  double *corners; /* corner_count x 3: only the points on the hull [m] */
  size_t corner_count;
  sw_vec centre; /* [m] */
} hull;

typedef struct hull_args {
  char none; /* all input comes from the source */
} hull_args;

static const char object[] = "obstacle hull";

static sw_status check_points(const sw_shape_source *source, sw_error *err) {
  const size_t count = source->points ? source->point_count : 0;
  if (count < FEWEST_POINTS)
    return sw_fail(err, SW_EINVAL, "%s: points has %zu point%s; a hull needs at least %d", object,
                   count, count == 1 ? "" : "s", FEWEST_POINTS);
  if (source->point_count > MOST_POINTS)
    return sw_fail(err, SW_ELIMIT, "%s: points has %zu points; at most %d are allowed", object,
                   source->point_count, MOST_POINTS);
  for (size_t i = 0; i < source->point_count; i++) {
    const sw_vec p = sw_load(source->points + 3 * i);
    const double most = fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z)));
    if (!sw_finite(p) || most > SW_SHAPE_LARGEST)
      return sw_fail(err, SW_EINVAL, "%s: points, number %zu is not within %g m", object, i + 1,
                     SW_SHAPE_LARGEST);
  }
  return SW_OK;
}

static sw_status keep_corners(hull *self) {
  const sw_trimesh *mesh = &self->as.mesh;
  self->corners = sw_alloc(3 * mesh->vertex_count, sizeof *self->corners);
  if (!self->corners) return SW_ENOMEM;
  for (size_t v = 0; v < mesh->vertex_count; v++)
    if (mesh->corners[v].owner >= 0)
      memcpy(self->corners + 3 * self->corner_count++, mesh->vertices + 3 * v, 3 * sizeof(double));
  return SW_OK;
}

static sw_status create(sw_shape *shape, const void *args SW_UNUSED, const sw_shape_source *source,
                        sw_error *err) {
  hull *self = (hull *)shape;
  int *indices = NULL;
  size_t triangles = 0;
  SW_TRY(check_points(source, err));
  SW_TRY(sw_hull_triangles(object, source->points, source->point_count, &indices, &triangles, err));
  sw_status status = sw_trimesh_build(&self->as.mesh, object, source->points, source->point_count,
                                      indices, triangles, err);
  sw_free(indices);
  SW_TRY(status);
  if (keep_corners(self) != SW_OK) return sw_fail(err, SW_ENOMEM, "%s: out of memory", object);
  for (size_t i = 0; i < self->corner_count; i++)
    self->centre =
        sw_madd(self->centre, sw_load(self->corners + 3 * i), 1.0 / (double)self->corner_count);
  shape->bounds = self->as.mesh.bounds;
  return SW_OK;
}

static void destroy(sw_shape *shape) {
  hull *self = (hull *)shape;
  sw_trimesh_free(&self->as.mesh);
  sw_free(self->corners);
}

static sw_vec support(const sw_shape *shape, sw_vec n) {
  const hull *self = (const hull *)shape;
  size_t best = 0;
  double most = -HUGE_VAL;
  for (size_t i = 0; i < self->corner_count; i++) {
    const double height = sw_dot(n, sw_load(self->corners + 3 * i));
    if (height > most) most = height, best = i;
  }
  return sw_load(self->corners + 3 * best);
}

static int apart(const hull *self, const sw_vec *corners, int count, double reach) {
  return sw_ccd_apart(self->corners, self->corner_count, self->centre, self->as.mesh.size, corners,
                      count, reach);
}

/* Edges and corners are tried first. The convex search handles a segment deeper than reach. */
static int segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const hull *self = (const hull *)shape;
  const sw_vec ends[2] = {a, b};
  if (apart(self, ends, 2, fmax(reach, 0))) return 0;
  const int count = sw_trimesh_segment(&self->as.mesh, a, b, reach, out);
  return count > 0 ? count : sw_convex_segment(shape, a, b, reach, out);
}

/* The swept region lies in the hull of the segment's four end places. */
static int sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when) {
  const hull *self = (const hull *)shape;
  const sw_vec ends[4] = {path->a0, path->b0, path->a1, path->b1};
  if (apart(self, ends, 4, path->margin)) return 0;
  return sw_convex_sweep(shape, path, out, when);
}

static const sw_param rows[] = {
    {"points", SW_PARAM_OTHER, "m", NAN, -SW_SHAPE_LARGEST, SW_SHAPE_LARGEST, SW_PARAM_REQUIRED,
     NULL, 0, "points whose convex hull is the solid, at least four: {x, y, z, x, y, z, ...}"},
};

static const sw_shape_wrong wrong[] = {
    {"points = { 0, 0, 0, 1, 0, 0, 0, 1, 0 }", "a hull needs at least 4"},
    {"points = { 0, 0, 0, 1 }", "it must have three for each point"},
    {NULL, NULL}};

const sw_shape_class sw_shape_class_hull = {
    .kind = "hull",
    .summary = "smallest convex solid around points",
    .sample =
        "points = { -0.4, -0.3, -0.3, 0.4, -0.3, -0.3, 0, 0.5, -0.2, 0, 0.1, 0.5, 0.3, 0.3, 0.3 }",
    .wrong = wrong,
    .traits = SW_SHAPE_FACED | SW_SHAPE_LISTED,

    .params = SW_PARAMS(object, rows),
    .size = sizeof(hull),
    .create = create,
    .destroy = destroy,
    .distance = sw_meshed_distance,
    .support = support,
    .segment = segment,
    .sweep = sweep,
    .triangles = sw_meshed_triangles,
    .bones = sw_meshed_bones,
    .sharp = sw_meshed_sharp,
    .faceted = sw_meshed_faceted,
    .facet = sw_meshed_facet,
    .roundness = sw_meshed_roundness,
    .ridges = sw_meshed_ridges,
    .points_out = sw_meshed_points_out};
