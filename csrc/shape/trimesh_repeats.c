/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangles that a file lists more than once. At their edges more than two faces would meet, and
 * each would push a wire. Copies are dropped. */
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "shape/trimesh.h"

/* A triangle's corners with the smallest first, in the triangle's winding. */
typedef struct corners {
  int v[3];
} corners;

static corners corners_of(const sw_trimesh *mesh, size_t tri) {
  const int *at = mesh->indices + 3 * tri;
  int first = 0;
  for (int k = 1; k < 3; k++)
    if (at[k] < at[first]) first = k;
  return (corners){{at[first], at[(first + 1) % 3], at[(first + 2) % 3]}};
}

/* The same for both windings. */
static size_t hash_of(corners c) {
  const uint64_t mix = 0x9e3779b97f4a7c15u; /* odd, with well spread bits (golden ratio) */
  const int low = c.v[1] < c.v[2] ? c.v[1] : c.v[2], high = c.v[1] < c.v[2] ? c.v[2] : c.v[1];
  const int all[3] = {c.v[0], low, high};
  uint64_t hash = 0;
  for (int k = 0; k < 3; k++) {
    hash = (hash ^ (uint64_t)all[k]) * mix;
    hash ^= hash >> 29;
  }
  return (size_t)hash;
}

/* 0: other corners; 1: the same winding; -1: the opposite one. */
static int same(corners a, corners b) {
  if (a.v[0] != b.v[0]) return 0;
  if (a.v[1] == b.v[1] && a.v[2] == b.v[2]) return 1;
  return a.v[1] == b.v[2] && a.v[2] == b.v[1] ? -1 : 0;
}

typedef struct table {
  int *slots; /* kept triangles by hash; -1 = free */
  size_t mask;
} table;

/* Finds the kept triangle with these corners, or enters `tri`, which has them, and returns -1. */
static int find_or_enter(const sw_trimesh *mesh, const table *t, size_t tri, int *winding) {
  const corners own = corners_of(mesh, tri);
  for (size_t slot = hash_of(own) & t->mask;; slot = (slot + 1) & t->mask) {
    const int there = t->slots[slot];
    if (there < 0) {
      t->slots[slot] = (int)tri;
      return -1;
    }
    *winding = same(own, corners_of(mesh, (size_t)there));
    if (*winding != 0) return there;
  }
}

static void move_triangle(sw_trimesh *mesh, int *numbers, size_t from, size_t to) {
  memmove(mesh->indices + 3 * to, mesh->indices + 3 * from, 3 * sizeof *mesh->indices);
  memmove(mesh->normals + 3 * to, mesh->normals + 3 * from, 3 * sizeof *mesh->normals);
  numbers[to] = numbers[from];
}

static sw_status drop(sw_trimesh *mesh, const char *object, int *numbers, const table *t,
                      sw_error *err) {
  size_t kept = 0;
  for (size_t tri = 0; tri < mesh->triangle_count; tri++) {
    int winding = 0;
    if (sw_interrupted()) return SW_EINTR;
    move_triangle(mesh, numbers, tri, kept);
    const int there = find_or_enter(mesh, t, kept, &winding);
    if (there < 0) kept++;
    if (winding < 0)
      return sw_fail(err, SW_EINVAL,
                     "%s: triangles %d and %d have the same corners in opposite windings, so they "
                     "face both ways; keep the one that faces away from the solid",
                     object, numbers[there] + 1, numbers[kept] + 1);
  }
  mesh->triangle_count = kept;
  return SW_OK;
}

sw_status sw_trimesh_drop_repeats(sw_trimesh *mesh, const char *object, int *numbers,
                                  sw_error *err) {
  size_t slots = 1;
  while (slots < 2 * mesh->triangle_count) slots *= 2;
  int *room SW_LOCAL = sw_alloc(slots, sizeof *room);
  if (!room) return SW_ENOMEM;
  for (size_t i = 0; i < slots; i++) room[i] = -1;
  return drop(mesh, object, numbers, &(table){room, slots - 1}, err);
}
