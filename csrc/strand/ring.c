/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Positions and directions of the rings of a mesh of particles. */
#include "strand/ring.h"

#include <math.h>

void sw_strand_rings(const sw_mesh *m, double *s1, double *s2) {
  const double middle = 0.5 * (*s1 + *s2), slack = 1e-9 * m->s[m->n - 1];
  size_t first = 0, last = m->n - 1, nearest = 0;
  while (first + 1 < m->n && m->s[first] < *s1 - slack) first++;
  while (last > 0 && m->s[last] > *s2 + slack) last--;
  for (size_t i = 1; i < m->n; i++)
    if (fabs(m->s[i] - middle) < fabs(m->s[nearest] - middle)) nearest = i;
  if (first > last) first = last = nearest;
  *s1 = m->s[first], *s2 = m->s[last];
}

double sw_strand_turned(const sw_web *w, const double *x, size_t ring, sw_vec t, sw_vec u) {
  const double *at = x + 3 * w->first[ring];
  const sw_vec middle = sw_web_centre(w, x, ring), v = sw_cross(t, u);
  double sine = 0, cosine = 0;
  for (size_t k = 0; k < w->around_count; k++) {
    const double *rest = w->section + 2 * (size_t)w->around[k];
    const sw_vec p = sw_sub(sw_vec_at(at, w->around[k]), middle);
    const double a = sw_dot(p, u), b = sw_dot(p, v);
    cosine += rest[0] * a + rest[1] * b;
    sine += rest[0] * b - rest[1] * a;
  }
  return atan2(sine, cosine);
}
