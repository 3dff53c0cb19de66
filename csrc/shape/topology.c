/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges and corners of a mesh: their triangles, their normals that separate inside from outside
 * (the sum over the faces, at corners weighted by angle), and the flag of those that stick out. */
#include <stdlib.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "shape/trimesh.h"

typedef struct half_edge {
  int low, high; /* vertices */
  int tri, side; /* the triangle and its side */
} half_edge;

static int compare(const void *one, const void *two) {
  const half_edge *a = one, *b = two;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  if (a->high != b->high) return a->high < b->high ? -1 : 1;
  if (a->tri != b->tri) return a->tri < b->tri ? -1 : 1;
  return (a->side > b->side) - (a->side < b->side);
}

static half_edge side_of(const sw_trimesh *mesh, size_t i) {
  const size_t tri = i / 3, k = i % 3;
  const int from = mesh->indices[i], to = mesh->indices[3 * tri + (k + 1) % 3];
  return (half_edge){from < to ? from : to, from < to ? to : from, (int)tri, (int)k};
}

/* Lists all sides in order: a counting sort by lower vertex (first: vertices + 1 zeros), then a
 * sort at each vertex. */
static sw_status list_sides(const sw_trimesh *mesh, half_edge *halves, size_t *first) {
  const size_t n = 3 * mesh->triangle_count, vertices = mesh->vertex_count;
  for (size_t i = 0; i < n; i++) first[side_of(mesh, i).low + 1]++;
  for (size_t v = 0; v < vertices; v++) first[v + 1] += first[v];
  for (size_t i = n; i-- > 0;) {
    const half_edge h = side_of(mesh, i);
    halves[--first[h.low + 1]] = h; /* ends as the place of the first one */
  }
  for (size_t v = 0; v < vertices; v++) {
    const size_t begin = first[v + 1], end = v + 2 <= vertices ? first[v + 2] : n;
    if (sw_interrupted()) return SW_EINTR;
    if (end - begin > 1) qsort(halves + begin, end - begin, sizeof *halves, compare);
  }
  return SW_OK;
}

/* Returns the unit vector across a side into its triangle. */
static sw_vec into_triangle(const sw_trimesh *mesh, int tri, int side) {
  const sw_triangle t = sw_trimesh_triangle(mesh, tri);
  const sw_vec along = sw_sub(t.v[(side + 1) % 3], t.v[side]);
  return sw_unit_or(sw_cross(t.n, along), sw_perpendicular(t.n));
}

/* Sine of the angle below which faces are flat; the same for a hollow edge, above rounding in files
 * [-]. */
static const double BENT = 1e-6, FOLDED = 1e-3;
/* Files with floats round coordinates to 6e-8 of their size, and an edge may stick out of a flat
 * surface by three times this share of the largest extent. Wires on a turned plate with facets of
 * 2 mm rocked on such edges without end (spec/shape/rounded_mesh_spec) [-]. */
static const double ROUNDED = 2e-7;

/* Returns the slope that rounding may give to a face or edge of this length [-]. */
static double level(const sw_trimesh *mesh, double length) {
  return fmin(FOLDED, fmax(BENT, ROUNDED * mesh->size / fmax(length, 1e-300)));
}

/* Height of the triangle over this side of it [m]. */
static double height_over(const sw_trimesh *mesh, const half_edge *h) {
  const sw_triangle t = sw_trimesh_triangle(mesh, h->tri);
  const sw_vec into = into_triangle(mesh, h->tri, h->side);
  return sw_dot(into, sw_sub(t.v[(h->side + 2) % 3], t.v[h->side]));
}

static int runs_up(const sw_trimesh *mesh, const half_edge *h) {
  return mesh->indices[3 * (size_t)h->tri + (size_t)h->side] == h->low;
}

/* Makes one edge from the `count` sides on it. Returns 1 if two triangles run along it in the same
 * direction. */
static int make_edge(sw_trimesh *mesh, const half_edge *h, int count) {
  const int number = (int)mesh->edge_count++;
  sw_trimesh_edge *edge = &mesh->edges[number];
  *edge = (sw_trimesh_edge){.v = {h->low, h->high}, .tri = {h[0].tri, -1}};
  sw_vec sum = {0, 0, 0};
  for (int i = 0; i < count; i++) {
    sum = sw_add(sum, sw_load(mesh->normals + 3 * (size_t)h[i].tri));
    mesh->sides[3 * (size_t)h[i].tri + (size_t)h[i].side] = number;
    if (i < 2) edge->into[i] = into_triangle(mesh, h[i].tri, h[i].side);
  }
  const sw_vec first = sw_load(mesh->normals + 3 * (size_t)h->tri);
  edge->normal = sw_unit_or(sum, first);
  edge->sine = 1;
  edge->flags = SW_CONVEX | SW_RIM;
  mesh->open |= count == 1;
  if (count == 1) return 0;
  const sw_vec second = sw_load(mesh->normals + 3 * (size_t)h[1].tri);
  edge->tri[1] = h[1].tri;
  edge->sine = fmin(1, sw_norm(sw_cross(first, second)));
  if (sw_dot(first, second) < 0) edge->sine = 1;
  const double rise = sw_dot(edge->into[1], first);
  const double flat = level(mesh, fmin(height_over(mesh, &h[0]), height_over(mesh, &h[1])));
  edge->flags = count > 2 || rise < -flat ? SW_CONVEX : 0;
  mesh->hollow |= rise > FOLDED;
  return count == 2 && runs_up(mesh, &h[0]) == runs_up(mesh, &h[1]);
}

static int same_edge(const half_edge *a, const half_edge *b) {
  return a->low == b->low && a->high == b->high;
}

static size_t count_edges(const half_edge *halves, size_t sides) {
  size_t count = 0;
  for (size_t i = 0; i < sides; i++) count += i == 0 || !same_edge(&halves[i - 1], &halves[i]);
  return count;
}

static size_t make_edges(sw_trimesh *mesh, const half_edge *halves) {
  const size_t all = 3 * mesh->triangle_count;
  size_t twisted = 0;
  for (size_t i = 0, next; i < all; i = next) {
    for (next = i + 1; next < all && same_edge(&halves[next], &halves[i]);) next++;
    twisted += (size_t)make_edge(mesh, halves + i, (int)(next - i));
  }
  return twisted;
}

static void add_corner_normals(sw_trimesh *mesh) {
  for (size_t v = 0; v < mesh->vertex_count; v++) mesh->corners[v].owner = -1;
  for (size_t tri = 0; tri < mesh->triangle_count; tri++) {
    const sw_triangle t = sw_trimesh_triangle(mesh, (int)tri);
    for (int k = 0; k < 3; k++) {
      sw_trimesh_corner *corner = &mesh->corners[mesh->indices[3 * tri + (size_t)k]];
      const sw_vec one = sw_unit_or(sw_sub(t.v[(k + 1) % 3], t.v[k]), t.n);
      const sw_vec two = sw_unit_or(sw_sub(t.v[(k + 2) % 3], t.v[k]), t.n);
      const double angle = atan2(sw_norm(sw_cross(one, two)), sw_dot(one, two));
      corner->normal = sw_madd(corner->normal, t.n, angle);
      corner->into = sw_add(corner->into, sw_unit_or(sw_add(one, two), one));
      if (corner->owner < 0) corner->owner = (int)tri;
    }
  }
}

/* Lists the edges at every corner, one list after another. */
static void list_corner_edges(sw_trimesh *mesh) {
  for (size_t e = 0; e < mesh->edge_count; e++)
    for (int k = 0; k < 2; k++) mesh->corners[mesh->edges[e].v[k]].count++;
  int first = 0;
  for (size_t v = 0; v < mesh->vertex_count; v++) {
    mesh->corners[v].first = first;
    first += mesh->corners[v].count;
    mesh->corners[v].count = 0;
  }
  for (size_t e = 0; e < mesh->edge_count; e++)
    for (int k = 0; k < 2; k++) {
      sw_trimesh_corner *corner = &mesh->corners[mesh->edges[e].v[k]];
      mesh->corner_edges[corner->first + corner->count++] = (int)e;
    }
}

/* Normalises a corner and sets its flags. It sticks out if all its edges fall away from its
 * normal. */
static void finish_corner(sw_trimesh *mesh, int v) {
  sw_trimesh_corner *corner = &mesh->corners[v];
  const sw_vec fallback =
      corner->owner < 0 ? sw_v(0, 0, 1) : sw_load(mesh->normals + 3 * (size_t)corner->owner);
  corner->normal = sw_unit_or(corner->normal, fallback);
  corner->into = sw_unit_or(corner->into, sw_perpendicular(corner->normal));
  corner->flags = corner->count > 0 ? SW_CONVEX : 0;
  for (int i = 0; i < corner->count; i++) {
    const sw_trimesh_edge *edge = &mesh->edges[mesh->corner_edges[corner->first + i]];
    const int other = edge->v[0] == v ? edge->v[1] : edge->v[0];
    const sw_vec along = sw_sub(sw_trimesh_vertex(mesh, other), sw_trimesh_vertex(mesh, v));
    if (edge->flags & SW_RIM) corner->flags |= SW_RIM;
    const sw_vec out = corner->flags & SW_RIM ? sw_neg(corner->into) : corner->normal;
    const double length = sw_norm(along);
    if (sw_dot(along, out) > -level(mesh, length) * length) corner->flags &= ~SW_CONVEX;
  }
}

/* Makes edges and corners from the listed sides; *twisted counts edges whose faces face opposite
 * ways. */
static sw_status fill(sw_trimesh *mesh, const half_edge *halves, size_t *twisted) {
  const size_t edges = count_edges(halves, 3 * mesh->triangle_count);
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(mesh->edges, edges), SW_ROOM(mesh->corner_edges, 2 * edges),
                      SW_ROOM(mesh->corners, mesh->vertex_count)));
  *twisted = make_edges(mesh, halves);
  add_corner_normals(mesh);
  list_corner_edges(mesh);
  for (size_t v = 0; v < mesh->vertex_count; v++) finish_corner(mesh, (int)v);
  /* by Euler's formula for one closed surface without holes */
  mesh->hollow |= mesh->vertex_count + mesh->triangle_count != mesh->edge_count + 2;
  return SW_OK;
}

sw_status sw_trimesh_topology(sw_trimesh *mesh, const char *object, sw_error *err) {
  const size_t sides = 3 * mesh->triangle_count;
  size_t twisted = 0;
  sw_status status = SW_ENOMEM;
  half_edge *halves SW_LOCAL = sw_alloc(sides, sizeof *halves);
  mesh->sides = sw_alloc(sides, sizeof *mesh->sides);
  size_t *first SW_LOCAL = sw_alloc(mesh->vertex_count + 1, sizeof *first);
  if (halves && first && mesh->sides) {
    status = list_sides(mesh, halves, first);
    if (status == SW_OK) status = fill(mesh, halves, &twisted);
  }
  SW_TRY(status);
  if (twisted > 0)
    return sw_fail(err, SW_EINVAL,
                   "%s: at %zu of %zu edges the two triangles face opposite ways; give all "
                   "triangles the same winding",
                   object, twisted, mesh->edge_count);
  return SW_OK;
}
