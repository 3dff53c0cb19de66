/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Refuses closed surfaces that face inwards: nothing would be solid within them, and wires would
 * fall through. Legal are those that bound a cavity within another surface. */
#include "base/alloc.h"
#include "base/interrupt.h"
#include "shape/trimesh.h"

typedef struct shell {
  double volume; /* signed: below 0 if it faces inwards [m3] */
  double area;   /* [m2] */
  size_t count;  /* triangles */
  int open;
} shell;

typedef struct shells {
  const sw_trimesh *mesh;
  int *root;  /* of every triangle: one triangle for all that are joined by edges */
  shell *all; /* at the roots */
} shells;

static int root_of(int *root, int tri) {
  while (root[tri] != tri) {
    root[tri] = root[root[tri]];
    tri = root[tri];
  }
  return tri;
}

/* Joins neighbours and measures the surfaces that result. */
static void measure(shells *s) {
  const sw_trimesh *mesh = s->mesh;
  const int n = (int)mesh->triangle_count;
  for (int i = 0; i < n; i++) s->root[i] = i;
  for (int i = 0; i < 3 * n; i++) {
    const int a = root_of(s->root, i / 3), b = root_of(s->root, mesh->edges[mesh->sides[i]].tri[0]);
    s->root[a < b ? b : a] = a < b ? a : b;
  }
  for (int i = 0; i < n; i++) s->all[i] = (shell){0};
  for (int i = 0; i < n; i++) {
    const int root = s->root[i] = root_of(s->root, i);
    const sw_triangle t = sw_trimesh_triangle(mesh, i);
    const sw_vec base = sw_trimesh_triangle(mesh, root).v[0], a = sw_sub(t.v[0], base);
    const sw_vec twice = sw_cross(sw_sub(t.v[1], t.v[0]), sw_sub(t.v[2], t.v[0]));
    s->all[root].volume += sw_dot(a, twice) / 6;
    s->all[root].area += 0.5 * sw_norm(twice);
    s->all[root].count++;
    for (int k = 0; k < 3; k++) s->all[root].open |= mesh->edges[mesh->sides[3 * i + k]].tri[1] < 0;
  }
}

typedef struct ray {
  const shells *shells;
  sw_vec from, way; /* [m] */
  int root;         /* the surface that it leaves, which is not counted */
  int wraps;        /* surfaces that it leaves from inside less those that it enters */
} ray;

/* On which side of the edge the ray passes; the same number for both triangles at the edge. */
static double side(const ray *r, int from, int to) {
  const sw_trimesh *mesh = r->shells->mesh;
  const sw_vec low = sw_sub(sw_trimesh_vertex(mesh, from < to ? from : to), r->from);
  const sw_vec high = sw_sub(sw_trimesh_vertex(mesh, from < to ? to : from), r->from);
  const double value = sw_dot(r->way, sw_cross(low, high));
  return (from < to) == (value >= 0) ? 1 : -1;
}

static void cross(void *context, int tri) {
  ray *r = context;
  const sw_trimesh *mesh = r->shells->mesh;
  const int *v = mesh->indices + 3 * (size_t)tri;
  if (r->shells->root[tri] == r->root) return;
  const double first = side(r, v[0], v[1]);
  if (side(r, v[1], v[2]) != first || side(r, v[2], v[0]) != first) return;
  const sw_triangle t = sw_trimesh_triangle(mesh, tri);
  const double along = sw_dot(r->way, t.n), height = sw_dot(t.n, sw_sub(t.v[0], r->from));
  if (along * height > 0) r->wraps += along > 0 ? 1 : -1; /* in front of the ray's start */
}

/* 1 if another surface is round this one. It may have a hole, so two opposite rays look for it. */
static int is_cavity(const shells *s, int root) {
  const sw_vec any = sw_scale(sw_v(0.5377, 0.6411, 0.5475), 4 * s->mesh->size); /* no usual way */
  const sw_triangle t = sw_trimesh_triangle(s->mesh, root);
  for (int k = -1; k <= 1; k += 2) {
    ray r = {.shells = s, .from = t.v[0], .way = sw_scale(any, k), .root = root};
    sw_trimesh_near(s->mesh, r.from, sw_add(r.from, r.way), 0, cross, &r);
    if (r.wraps > 0) return 1;
  }
  return 0;
}

static sw_status judge(const shells *s, const char *object, sw_error *err) {
  const double flat = 1e-9; /* thickness over size below which a surface has no inside [-] */
  for (int i = 0; i < (int)s->mesh->triangle_count; i++) {
    const shell *one = &s->all[i];
    if (sw_interrupted()) return SW_EINTR;
    if (one->open || one->volume >= -flat * one->area * s->mesh->size || is_cavity(s, i)) continue;
    const sw_vec p = sw_trimesh_triangle(s->mesh, i).v[0];
    return sw_fail(err, SW_EINVAL,
                   "%s: the closed surface of %zu triangles with a corner at (%.4g, %.4g, %.4g) m "
                   "faces inwards, as after a mirrored export, and would hold nothing; give its "
                   "triangles the opposite winding (for a room that holds a wire: add its outside)",
                   object, one->count, p.x, p.y, p.z);
  }
  return SW_OK;
}

sw_status sw_trimesh_check_shells(const sw_trimesh *mesh, const char *object, sw_error *err) {
  int *root SW_LOCAL = sw_alloc(mesh->triangle_count, sizeof *root);
  shell *all SW_LOCAL = (shell *)sw_alloc(mesh->triangle_count, sizeof *all);
  shells s = {mesh, root, all};
  if (!root || !all) return SW_ENOMEM;
  measure(&s);
  return judge(&s, object, err);
}
