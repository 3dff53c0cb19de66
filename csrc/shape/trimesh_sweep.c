/* SPDX-License-Identifier: GPL-3.0-or-later */
/* First touch of a moving segment and a mesh. Each triangle near the swept region is treated as a
 * convex thing. Gaps are unsigned here, so sheets without thickness stop a segment like solids
 * do. */
#include "shape/trimesh.h"

typedef struct moving {
  const sw_trimesh *mesh;
  const sw_sweep *path;
  sw_bounds swept;
  double level; /* as in sw_shape_sweep [m] */
  double first; /* earliest touch so far [-] */
  sw_closest *out;
  int found;
} moving;

/* --- the start ------------------------------------------------------------ */

typedef struct start {
  const sw_trimesh *mesh;
  sw_vec a, b; /* [m] */
  double gap;  /* smallest unsigned gap so far [m] */
  int tri;     /* its triangle, -1 = none */
} start;

static void look_at_start(void *context, int tri) {
  start *s = context;
  const sw_triangle t = sw_trimesh_triangle(s->mesh, tri);
  sw_closest c;
  sw_triangle_nearest(&t, s->a, s->b, &c);
  if (c.gap < s->gap) s->gap = c.gap, s->tri = tri;
}

static start look(const sw_trimesh *mesh, sw_vec a, sw_vec b, double reach) {
  start s = {mesh, a, b, reach, -1};
  sw_trimesh_near(mesh, a, b, reach, look_at_start, &s);
  return s;
}

/* --- the path ------------------------------------------------------------- */

static sw_bounds triangle_bounds(const sw_triangle *t) {
  const sw_bounds two = sw_bounds_of(t->v[0], t->v[1], 0);
  const sw_bounds low = sw_bounds_of(two.min, t->v[2], 0), high = sw_bounds_of(two.max, t->v[2], 0);
  return (sw_bounds){low.min, high.max};
}

static void advance(moving *m, int tri) {
  const sw_triangle t = sw_trimesh_triangle(m->mesh, tri);
  const sw_bounds box = triangle_bounds(&t);
  sw_closest begin, touch;
  double when;
  if (!sw_bounds_meet(&box, &m->swept)) return;
  sw_triangle_nearest(&t, m->path->a0, m->path->b0, &begin);
  if (begin.gap <= m->level + m->path->tolerance) return; /* pierced from the start */
  if (!sw_sweep_advance(sw_triangle_nearest, &t, m->path, &begin, m->level, m->first, &touch,
                        &when))
    return;
  m->found = 1;
  m->first = when;
  touch.feature = tri;
  *m->out = touch;
}

static sw_bounds swept_region(const sw_sweep *path, double margin) {
  const sw_bounds one = sw_bounds_of(path->a0, path->b0, margin);
  const sw_bounds two = sw_bounds_of(path->a1, path->b1, margin);
  const sw_bounds low = sw_bounds_of(one.min, two.min, 0), high = sw_bounds_of(one.max, two.max, 0);
  return (sw_bounds){low.min, high.max};
}

static void visit_all(moving *m) {
  int stack[SW_TREE_DEPTH], top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const int number = stack[--top];
    const sw_tree_node *node = &m->mesh->nodes[number];
    if (!sw_bounds_meet(&node->bounds, &m->swept)) continue;
    for (int i = 0; i < node->count; i++) advance(m, node->first + i);
    if (node->count > 0) continue;
    stack[top++] = node->first;
    stack[top++] = number + 1;
  }
}

/* Shifts the whole path by a few tolerances off the triangle it starts on, so that it starts on a
 * definite side. */
static void step_off(const sw_trimesh *mesh, int tri, sw_sweep *path) {
  const double steps = 8; /* shift over the tolerance [-] */
  const sw_vec n = sw_load(mesh->normals + 3 * (size_t)tri);
  const sw_vec off = sw_scale(n, steps * path->tolerance);
  path->a0 = sw_add(path->a0, off), path->b0 = sw_add(path->b0, off);
  path->a1 = sw_add(path->a1, off), path->b1 = sw_add(path->b1, off);
}

int sw_trimesh_sweep(const sw_trimesh *mesh, const sw_sweep *path, sw_closest *out, double *when) {
  const double touching = 4;     /* start gaps below this many tolerances count as 0 [-] */
  const double last = 1 + 1e-12; /* counts a touch at time 1 despite rounding */
  sw_sweep moved = *path;
  const double tolerance = path->tolerance;
  start s = look(mesh, path->a0, path->b0, path->margin + touching * tolerance);
  if (s.tri >= 0 && s.gap < touching * tolerance) {
    step_off(mesh, s.tri, &moved);
    s = look(mesh, moved.a0, moved.b0, path->margin + touching * tolerance);
  }
  const double level = fmax(sw_sweep_level(path, s.gap), 0);
  moving m = {mesh, &moved, swept_region(&moved, path->margin + tolerance), level, last, out, 0};
  visit_all(&m);
  if (m.found) *when = fmin(m.first, 1);
  return m.found;
}
