/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces of a section of springs, which show whether the section has folded through itself. Springs
 * only know lengths: a section pressed too far turns some faces over and pushes back less instead
 * of more. */
#include <math.h>

#include "base/alloc.h"
#include "strand/maker.h"
#include "strand/ring.h"

static void put(sw_strand_maker *m, uint32_t a, uint32_t b, uint32_t c) {
  if (m->web->face) {
    uint32_t *face = m->web->face + 3 * m->web->faces;
    face[0] = a, face[1] = b, face[2] = c;
  }
  m->web->faces++;
}

static void ring_faces(sw_strand_maker *m, size_t inner, size_t outer, size_t n) {
  for (size_t k = 0; k < n; k++) {
    const size_t next = (k + 1) % n;
    const uint32_t a = (uint32_t)(outer + k), b = (uint32_t)(outer + next);
    if (inner == SIZE_MAX) continue;
    put(m, (uint32_t)(inner + k), a, b);
    put(m, (uint32_t)(inner + k), b, (uint32_t)(inner + next));
  }
}

static void around_axis(sw_strand_maker *m, uint32_t axis, size_t first, size_t n) {
  for (size_t k = 0; k < n; k++)
    put(m, axis, (uint32_t)(first + k), (uint32_t)(first + (k + 1) % n));
}

/* Returns the particle at a place of the section, or the number of particles if there is none. */
static size_t particle_at(const sw_lattice *l, double x, double y, double near) {
  size_t i = 0;
  while (i < l->particles && hypot(l->at[3 * i] - x, l->at[3 * i + 1] - y) > near) i++;
  return i;
}

static void voxel_faces(sw_strand_maker *m) {
  const sw_lattice *l = m->lattice;
  double a = HUGE_VAL; /* side of a voxel */
  for (size_t i = 1; i < l->particles; i++) {
    const double d = hypot(l->at[3 * i] - l->at[0], l->at[3 * i + 1] - l->at[1]);
    a = fmin(a, d);
  }
  for (size_t i = 0; i < l->particles; i++) {
    const double x = l->at[3 * i], y = l->at[3 * i + 1], near = 1e-3 * a;
    const size_t b = particle_at(l, x + a, y, near), c = particle_at(l, x + a, y + a, near);
    const size_t d = particle_at(l, x, y + a, near);
    if (b == l->particles || c == l->particles || d == l->particles) continue;
    put(m, (uint32_t)i, (uint32_t)b, (uint32_t)c);
    put(m, (uint32_t)i, (uint32_t)c, (uint32_t)d);
  }
}

static void find(sw_strand_maker *m) {
  const int mesh = sw_calibrate_mesh(m->plan->mesh);
  m->web->faces = 0;
  if (m->lattice->solids) return; /* steps never turn solid elements over */
  if (mesh == SW_LATTICE_TUBE && m->plan->lattice.tube.core)
    around_axis(m, (uint32_t)m->plan->lattice.tube.particles, 0,
                (size_t)m->plan->lattice.tube.particles);
  if (mesh == SW_LATTICE_RADIAL) {
    const size_t n = (size_t)m->plan->lattice.radial.particles;
    around_axis(m, 0, 1, n);
    for (long k = 1; k < m->plan->lattice.radial.layers; k++)
      ring_faces(m, 1 + (size_t)(k - 1) * n, 1 + (size_t)k * n, n);
  }
  if (mesh == SW_LATTICE_CUBIC) voxel_faces(m);
}

sw_status sw_strand_find_faces(sw_strand_maker *m) {
  find(m);
  m->web->face = sw_alloc(3 * m->web->faces, sizeof *m->web->face);
  if (!m->web->face) return SW_ENOMEM;
  find(m);
  return SW_OK;
}

/* Returns twice the area of a face of the undeformed section. */
static double rest_area(const sw_web *w, const uint32_t *face) {
  const double *a = w->section + 2 * (size_t)face[0], *b = w->section + 2 * (size_t)face[1];
  const double *c = w->section + 2 * (size_t)face[2];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

sw_extreme sw_strand_folding(const sw_web *w, const double *x) {
  sw_extreme worst = {.value = -HUGE_VAL};
  for (size_t r = 0; r < w->rings && w->faces; r++) {
    if (!sw_web_is_ring(w, r)) continue;
    const double *at = x + 3 * w->first[r];
    const sw_vec t = sw_web_facing(w, x, r);
    for (size_t k = 0; k < w->faces; k++) {
      const uint32_t *face = w->face + 3 * k;
      const sw_vec a = sw_vec_at(at, face[0]);
      const sw_vec u = sw_sub(sw_vec_at(at, face[1]), a), v = sw_sub(sw_vec_at(at, face[2]), a);
      const double turned = -sw_dot(sw_cross(u, v), t) / rest_area(w, face);
      if (turned > worst.value) worst = (sw_extreme){.value = turned, .s = w->s[w->first[r]]};
    }
  }
  return worst;
}
