/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cleaning of a triangle surface, the tree over its triangles, and the sequence of its build. */
#include "shape/trimesh.h"

#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "shape/meshed.h"

/* Vertices nearer than this share of the largest extent are joined. Files with floats round
 * coordinates to 6e-8 of their size [-]. */
static const double weld_part = 2e-7;
/* A triangle is dropped if its height over its longest side is below this [-]. */
static const double flat_part = 1e-9;

typedef struct welder {
  double cell; /* side of the hash grid's cells [m] */
  double near; /* vertices nearer than this are joined [m] */
  sw_vec origin;
  int *head, *next; /* chains of kept vertices with equal hash; -1 = end */
  size_t mask;
  double *kept; /* (x 3) vertices kept so far [m] */
  int count;
} welder;

static size_t slot_of(const welder *w, const int64_t at[3]) {
  uint64_t hash = 0;
  const uint64_t mix = 0x9e3779b97f4a7c15u; /* odd, with well spread bits (golden ratio) */
  for (int i = 0; i < 3; i++) {
    hash = (hash ^ (uint64_t)at[i]) * mix;
    hash ^= hash >> 29;
  }
  return (size_t)hash & w->mask;
}

static int find_in_slot(const welder *w, size_t slot, sw_vec p) {
  for (int v = w->head[slot]; v >= 0; v = w->next[v])
    if (sw_dist(p, sw_load(w->kept + 3 * (size_t)v)) <= w->near) return v;
  return -1;
}

static void cell_of(const welder *w, sw_vec p, int64_t at[3]) {
  const sw_vec q = sw_sub(p, w->origin);
  at[0] = (int64_t)floor(q.x / w->cell);
  at[1] = (int64_t)floor(q.y / w->cell);
  at[2] = (int64_t)floor(q.z / w->cell);
}

/* Returns the number of the kept vertex at p, new or old. */
static int weld(welder *w, sw_vec p) {
  const sw_vec step = sw_v(w->near, w->near, w->near);
  int64_t low[3], high[3], at[3];
  cell_of(w, sw_sub(p, step), low);
  cell_of(w, sw_add(p, step), high);
  for (at[0] = low[0]; at[0] <= high[0]; at[0]++)
    for (at[1] = low[1]; at[1] <= high[1]; at[1]++)
      for (at[2] = low[2]; at[2] <= high[2]; at[2]++) {
        const int v = find_in_slot(w, slot_of(w, at), p);
        if (v >= 0) return v;
      }
  cell_of(w, p, at);
  const size_t slot = slot_of(w, at);
  sw_store(w->kept + 3 * (size_t)w->count, p);
  w->next[w->count] = w->head[slot];
  w->head[slot] = w->count;
  return w->count++;
}

static sw_status measure(sw_trimesh *mesh, const char *object, const double *vertices,
                         size_t vertex_count, sw_error *err) {
  sw_bounds all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (size_t i = 0; i < vertex_count; i++) {
    const sw_vec p = sw_load(vertices + 3 * i);
    const double most = fabs(p.x) + fabs(p.y) + fabs(p.z);
    if (!isfinite(most))
      return sw_fail(err, SW_EINVAL, "%s: point %zu has a coordinate that is not a number", object,
                     i + 1);
    if (most > SW_SHAPE_LARGEST)
      return sw_fail(err, SW_EINVAL, "%s: point %zu is further out than %g m", object, i + 1,
                     SW_SHAPE_LARGEST);
    all.min = sw_v(fmin(all.min.x, p.x), fmin(all.min.y, p.y), fmin(all.min.z, p.z));
    all.max = sw_v(fmax(all.max.x, p.x), fmax(all.max.y, p.y), fmax(all.max.z, p.z));
  }
  mesh->bounds = all;
  const sw_vec extent = sw_sub(all.max, all.min);
  mesh->size = fmax(extent.x, fmax(extent.y, extent.z));
  return SW_OK;
}

/* Keeps the triangle unless it has no area. Returns 1 if it is kept. */
static int keep_triangle(sw_trimesh *mesh, const int corner[3]) {
  sw_vec v[3];
  double longest2 = 0;
  for (int k = 0; k < 3; k++) v[k] = sw_trimesh_vertex(mesh, corner[k]);
  for (int k = 0; k < 3; k++) longest2 = fmax(longest2, sw_norm2(sw_sub(v[(k + 1) % 3], v[k])));
  const sw_vec n = sw_cross(sw_sub(v[1], v[0]), sw_sub(v[2], v[0]));
  if (!(sw_norm(n) > flat_part * longest2)) return 0;
  memcpy(mesh->indices + 3 * mesh->triangle_count, corner, 3 * sizeof(int));
  sw_store(mesh->normals + 3 * mesh->triangle_count, sw_unit_or(n, sw_v(0, 0, 1)));
  mesh->triangle_count++;
  return 1;
}

/* numbers: room for the kept triangles' numbers in the file. */
static sw_status weld_all(sw_trimesh *mesh, welder *w, const double *vertices, size_t vertex_count,
                          const int *indices, size_t triangle_count, int *number, int *numbers) {
  for (size_t i = 0; i <= w->mask; i++) w->head[i] = -1;
  for (size_t i = 0; i < vertex_count; i++) {
    if (sw_interrupted()) return SW_EINTR;
    number[i] = weld(w, sw_load(vertices + 3 * i));
  }
  mesh->vertex_count = (size_t)w->count;
  for (size_t i = 0; i < triangle_count; i++) {
    if (sw_interrupted()) return SW_EINTR;
    const int *from = indices + 3 * i;
    const int corner[3] = {number[from[0]], number[from[1]], number[from[2]]};
    if (keep_triangle(mesh, corner)) numbers[mesh->triangle_count - 1] = (int)i;
  }
  return SW_OK;
}

static sw_status clean(sw_trimesh *mesh, const char *object, const double *vertices,
                       size_t vertex_count, const int *indices, size_t triangle_count,
                       sw_error *err) {
  const double cells = 8; /* cell side over weld distance; few vertices search two cells [-] */
  size_t slots = 1;
  SW_TRY(measure(mesh, object, vertices, vertex_count, err));
  while (slots < 2 * vertex_count) slots *= 2;
  const double near = weld_part * mesh->size + 1e-300; /* above 0 even for a single point */
  welder w = {cells * near, near, mesh->bounds.min, NULL, NULL, slots - 1, NULL, 0};
  int *number, *numbers;
  sw_status status = SW_ALLOC_ALL(
      SW_ROOM(number, vertex_count), SW_ROOM(w.head, slots), SW_ROOM(w.next, vertex_count),
      SW_ROOM(mesh->vertices, 3 * vertex_count), SW_ROOM(mesh->indices, 3 * triangle_count),
      SW_ROOM(mesh->normals, 3 * triangle_count), SW_ROOM(numbers, triangle_count));
  w.kept = mesh->vertices;
  if (status == SW_OK)
    status = weld_all(mesh, &w, vertices, vertex_count, indices, triangle_count, number, numbers);
  if (status == SW_OK) status = sw_trimesh_drop_repeats(mesh, object, numbers, err);
  sw_free(numbers), sw_free(number), sw_free(w.head), sw_free(w.next);
  return status;
}

static sw_bounds box_of(const sw_triangle *t) {
  const sw_vec a = t->v[0], b = t->v[1], c = t->v[2];
  return (sw_bounds){
      sw_v(fmin(fmin(a.x, b.x), c.x), fmin(fmin(a.y, b.y), c.y), fmin(fmin(a.z, b.z), c.z)),
      sw_v(fmax(fmax(a.x, b.x), c.x), fmax(fmax(a.y, b.y), c.y), fmax(fmax(a.z, b.z), c.z))};
}

/* Puts the triangles into leaf order. */
static void reorder(sw_trimesh *mesh, const int *order, int *indices, double *normals) {
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    memcpy(indices + 3 * i, mesh->indices + 3 * (size_t)order[i], 3 * sizeof *indices);
    memcpy(normals + 3 * i, mesh->normals + 3 * (size_t)order[i], 3 * sizeof *normals);
  }
  sw_free(mesh->indices), sw_free(mesh->normals);
  mesh->indices = indices, mesh->normals = normals;
}

static sw_status build_tree(sw_trimesh *mesh) {
  const size_t n = mesh->triangle_count;
  sw_box_tree tree = {.nodes = NULL};
  double *centres = sw_alloc(3 * n, sizeof *centres), *normals = sw_alloc(3 * n, sizeof *normals);
  int *indices = sw_alloc(3 * n, sizeof *indices);
  sw_bounds *boxes = (sw_bounds *)sw_alloc(n, sizeof *boxes);
  sw_status status = centres && normals && indices && boxes ? SW_OK : SW_ENOMEM;
  for (size_t i = 0; status == SW_OK && i < n; i++) {
    const sw_triangle t = sw_trimesh_triangle(mesh, (int)i);
    boxes[i] = box_of(&t);
    sw_store(centres + 3 * i, sw_scale(sw_add(sw_add(t.v[0], t.v[1]), t.v[2]), 1.0 / 3));
  }
  if (status == SW_OK) status = sw_box_tree_new(boxes, centres, n, &tree);
  if (status == SW_OK) {
    reorder(mesh, tree.order, indices, normals);
    mesh->nodes = tree.nodes, mesh->node_count = tree.node_count;
    tree.nodes = NULL;
  } else {
    sw_free(normals), sw_free(indices);
  }
  sw_box_tree_free(&tree);
  sw_free(centres), sw_free(boxes);
  return status;
}

static sw_status check_counts(const char *object, size_t vertex_count, const int *indices,
                              size_t triangle_count, sw_error *err) {
  if (vertex_count == 0 || triangle_count == 0)
    return sw_fail(err, SW_EINVAL, "%s: there are no triangles", object);
  if (vertex_count > 3u * SW_TRIMESH_MOST || triangle_count > SW_TRIMESH_MOST)
    return sw_fail(err, SW_ELIMIT, "%s: %zu triangles are more than %d", object, triangle_count,
                   (int)SW_TRIMESH_MOST);
  for (size_t i = 0; i < 3 * triangle_count; i++)
    if (indices[i] < 0 || (size_t)indices[i] >= vertex_count)
      return sw_fail(err, SW_EFORMAT, "%s: triangle %zu names point %d, and there are %zu points",
                     object, i / 3 + 1, indices[i] + 1, vertex_count);
  return SW_OK;
}

sw_status sw_trimesh_build(sw_trimesh *mesh, const char *object, const double *vertices,
                           size_t vertex_count, const int *indices, size_t triangle_count,
                           sw_error *err) {
  SW_TRY(check_counts(object, vertex_count, indices, triangle_count, err));
  sw_status status = clean(mesh, object, vertices, vertex_count, indices, triangle_count, err);
  if (status == SW_OK && mesh->triangle_count == 0)
    return sw_fail(err, SW_EINVAL, "%s: none of the %zu triangles has an area", object,
                   triangle_count);
  if (status == SW_OK) status = build_tree(mesh);
  if (status == SW_OK) status = sw_trimesh_topology(mesh, object, err);
  if (status == SW_OK) status = sw_trimesh_check_shells(mesh, object, err);
  if (status == SW_OK) mesh->facet = sw_trimesh_facet(mesh, &mesh->facet_radius);
  if (status == SW_ENOMEM) return sw_fail(err, status, "%s: out of memory", object);
  return status;
}

void sw_trimesh_free(sw_trimesh *mesh) {
  SW_FREE_ALL(mesh->vertices, mesh->indices, mesh->sides, mesh->normals, mesh->edges, mesh->corners,
              mesh->corner_edges, mesh->nodes);
  memset(mesh, 0, sizeof *mesh);
}

sw_status sw_meshed_triangles(const sw_shape *shape, int around SW_UNUSED, sw_triangles *out) {
  const sw_trimesh *mesh = sw_trimesh_of(shape);
  SW_TRY(sw_triangles_new(mesh->vertex_count, mesh->triangle_count, out));
  memcpy(out->vertices, mesh->vertices, 3 * mesh->vertex_count * sizeof *out->vertices);
  memcpy(out->indices, mesh->indices, 3 * mesh->triangle_count * sizeof *out->indices);
  return SW_OK;
}

void sw_meshed_bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  const sw_trimesh *mesh = sw_trimesh_of(shape);
  for (size_t v = 0; v < mesh->vertex_count; v++) {
    const sw_vec corner = sw_trimesh_vertex(mesh, (int)v);
    visit(user, corner, corner, 0);
  }
  for (size_t e = 0; e < mesh->edge_count; e++)
    visit(user, sw_trimesh_vertex(mesh, mesh->edges[e].v[0]),
          sw_trimesh_vertex(mesh, mesh->edges[e].v[1]), 0);
}
