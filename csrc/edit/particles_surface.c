/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the surface of an object of particles: edges as given, its links, or the edges of faces
 * that belong to one element only. The inside of a face is no surface: bodies smaller than the
 * surface's meshes may pass through. */
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/couple.h"
#include "edit/particles.h"

typedef struct face {
  uint32_t node[4], key[4]; /* in order round the face; sorted. The last of a triangle is
                               UINT32_MAX */
} face;

static int by_number(const void *left, const void *right) {
  const uint32_t *p = left, *q = right;
  return *p < *q ? -1 : *p > *q;
}

static int by_key(const void *left, const void *right) {
  const face *p = left, *q = right;
  for (int k = 0; k < 4; k++)
    if (p->key[k] != q->key[k]) return p->key[k] < q->key[k] ? -1 : 1;
  return 0;
}

/* Sorts the edges, drops doubles, and gives them to the web. */
static sw_status take_edges(sw_web *w, sw_couple *list, size_t count) {
  size_t n = 0;
  for (size_t i = 0; i < count; i++)
    if (list[i].i > list[i].j) list[i] = (sw_couple){list[i].j, list[i].i};
  qsort(list, count, sizeof *list, sw_couple_order);
  for (size_t i = 0; i < count; i++)
    if (i == 0 || sw_couple_order(&list[i], &list[i - 1])) list[n++] = list[i];
  w->side = sw_alloc(n, sizeof *w->side);
  if (!w->side) return SW_ENOMEM;
  size_t at = 0;
  for (size_t p = 0; p < w->particles; p++) {
    w->side_first[p] = at;
    for (; at < n && list[at].i == p; at++) {
      w->side[at] = list[at].j;
      w->outer[p] = w->outer[list[at].j] = 1;
    }
  }
  w->side_first[w->particles] = at;
  return SW_OK;
}

static face face_of(const sw_web_solid *s, const int *corner, int count) {
  face f = {{0, 0, 0, UINT32_MAX}, {0, 0, 0, UINT32_MAX}};
  for (int k = 0; k < count; k++) f.node[k] = f.key[k] = s->node[corner[k]];
  qsort(f.key, 4, sizeof *f.key, by_number);
  return f;
}

/* Writes all faces of an element; returns their number. */
static size_t faces_of(const sw_web_solid *s, face *out) {
  const int n = (int)s->count / 2;
  int low[4], high[4];
  size_t count = 0;
  for (int k = 0; k < n; k++) {
    const int next = (k + 1) % n, side[4] = {k, next, n + next, n + k};
    low[k] = k, high[k] = n + k;
    out[count++] = face_of(s, side, 4);
  }
  out[count++] = face_of(s, low, n);
  out[count++] = face_of(s, high, n);
  return count;
}

/* Writes the edges of faces that occur once; returns their number. */
static size_t boundary_edges(face *faces, size_t count, sw_couple *out) {
  size_t edges = 0;
  qsort(faces, count, sizeof *faces, by_key);
  for (size_t i = 0; i < count; i++) {
    if (i > 0 && !by_key(&faces[i], &faces[i - 1])) continue;
    if (i + 1 < count && !by_key(&faces[i], &faces[i + 1])) continue;
    const size_t n = faces[i].node[3] == UINT32_MAX ? 3 : 4;
    for (size_t k = 0; k < n; k++)
      out[edges++] = (sw_couple){faces[i].node[k], faces[i].node[(k + 1) % n]};
  }
  return edges;
}

static sw_status outside_of_elements(sw_web *w) {
  enum { FACES = 6, EDGES = 4 * FACES };
  face *faces SW_LOCAL = sw_alloc(FACES * w->solids, sizeof *faces);
  sw_couple *edges SW_LOCAL = sw_alloc(EDGES * w->solids, sizeof *edges);
  size_t count = 0;
  if (!faces || !edges) return SW_ENOMEM;
  for (size_t i = 0; i < w->solids; i++) count += faces_of(&w->solid[i], faces + count);
  return take_edges(w, edges, boundary_edges(faces, count, edges));
}

sw_status sw_particles_add_surface(const maker *m) {
  const sw_particles_parts *p = m->parts;
  sw_web *w = m->web;
  const int given = p->surface == SW_SURFACE_EDGES;
  if (p->surface == SW_SURFACE_USUAL && w->solids) return outside_of_elements(w);
  const size_t count = given ? p->edges : w->links;
  if (p->surface == SW_SURFACE_PARTICLES || count == 0) {
    memset(w->outer, 1, w->particles);
    return SW_OK;
  }
  sw_couple *list SW_LOCAL = sw_alloc(count, sizeof *list);
  if (!list) return SW_ENOMEM;
  for (size_t i = 0; i < count; i++)
    list[i] = given ? (sw_couple){p->edge[2 * i], p->edge[2 * i + 1]}
                    : (sw_couple){w->link[i].a, w->link[i].b};
  const sw_status status = take_edges(w, list, count);
  if (!given) memset(w->outer, 1, w->particles);
  return status;
}
