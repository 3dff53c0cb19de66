/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rings of a mesh of particles: where they are, and which way they face. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/line.h"

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

sw_vec sw_strand_middle(const sw_web *w, const double *x, size_t ring) {
  double at[3];
  sw_web_middle(w, x, ring, at);
  return sw_load(at);
}

sw_status sw_strand_take(sw_scene_wire *wire, const sw_system *s, const sw_body *b) {
  sw_strand *p = &wire->strand;
  const size_t at = 3 * b->first_node, size = 3 * b->plan->nodes * sizeof(double);
  memcpy(p->x, s->x + at, size);
  memcpy(p->v, s->v + at, size);
  memcpy(p->a, s->a + at, size);
  memcpy(p->axial, s->tension + b->first_edge, p->web->links * sizeof(double));
  sw_free(p->rate);
  p->rate = b->axial_time > 0 ? sw_alloc(p->web->links, sizeof *p->rate) : NULL;
  if (p->rate)
    memcpy(p->rate, s->strain_rate + b->first_edge, p->web->links * sizeof(double));
  else if (b->axial_time > 0)
    return SW_ENOMEM;
  for (size_t r = 0; r < p->web->rings; r++) {
    sw_store(wire->mesh.x + 3 * r, sw_strand_middle(p->web, p->x, r));
    sw_store(wire->mesh.v + 3 * r, sw_strand_middle(p->web, p->v, r));
  }
  return SW_OK;
}

/* Direction of a line of particles at one of them: of both parts beside it, the shorter one's
 * counting more. */
static sw_vec line_direction(const sw_web *w, const double *x, size_t ring) {
  const sw_vec at = sw_strand_middle(w, x, ring);
  sw_vec before = sw_v(0, 0, 0), after = before;
  if (ring > 0) before = sw_sub(at, sw_strand_middle(w, x, ring - 1));
  if (ring + 1 < w->rings) after = sw_sub(sw_strand_middle(w, x, ring + 1), at);
  const double b2 = sw_norm2(before), a2 = sw_norm2(after);
  if (!(b2 > 0) || !(a2 > 0)) return sw_unit_or(sw_add(before, after), sw_v(1, 0, 0));
  return sw_unit_or(sw_add(sw_scale(before, a2), sw_scale(after, b2)), sw_v(1, 0, 0));
}

sw_vec sw_strand_facing(const sw_web *w, const double *x, size_t ring) {
  if (!sw_web_is_ring(w, ring)) return line_direction(w, x, ring);
  const double *at = x + 3 * w->first[ring];
  const sw_vec middle = sw_strand_middle(w, x, ring);
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < w->around_count; k++) {
    const sw_vec p = sw_sub(sw_vec_at(at, w->around[k]), middle);
    const sw_vec q = sw_sub(sw_vec_at(at, w->around[(k + 1) % w->around_count]), middle);
    sum = sw_add(sum, sw_cross(p, q));
  }
  return sw_unit_or(sum, sw_v(1, 0, 0));
}
