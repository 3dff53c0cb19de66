/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes a web, its surface, and the bounds of its frequencies. */
#include "state/web.h"

#include <math.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/halving.h"

sw_status sw_web_new(size_t particles, size_t links, size_t folds, size_t solids, sw_web **out) {
  sw_web *w = sw_alloc(1, sizeof *w);
  if (!w) return SW_ENOMEM;
  *w = (sw_web){
      .references = 1, .particles = particles, .links = links, .folds = folds, .solids = solids};
  const sw_status status = SW_ALLOC_ALL(
      SW_ROOM(w->link, links), SW_ROOM(w->fold, folds), SW_ROOM(w->solid, solids),
      SW_ROOM(w->mass, particles), SW_ROOM(w->s, particles), SW_ROOM(w->behind, particles),
      SW_ROOM(w->outer, particles), SW_ROOM(w->side_first, particles + 1));
  if (status != SW_OK)
    sw_web_release(w);
  else
    *out = w;
  return status;
}

sw_web *sw_web_retain(sw_web *web) {
  if (web) web->references++;
  return web;
}

void sw_web_release(sw_web *w) {
  if (!w || --w->references > 0) return;
  SW_FREE_ALL(w->link, w->first, w->fold, w->solid, w->shapes, w->ring_links, w->mass, w->s,
              w->share, w->section, w->ring_solids, w->outer, w->around, w->side, w->side_first,
              w->yield, w->hardening, w->along, w->slide, w->face, w->crease, w->behind, w);
}

/* Edges of the surface: around each ring, and along the wire to the next ring. */
sw_status sw_web_add_surface(sw_web *w) {
  const size_t n = w->around_count;
  if (!w->per_ring) return SW_OK; /* no rings */
  sw_free(w->side);
  w->side = sw_alloc(2 * w->particles, sizeof *w->side);
  if (!w->side) return SW_ENOMEM;
  uint32_t *next SW_LOCAL =
      sw_alloc(w->per_ring, sizeof *next); /* next around the section; itself: inside */
  if (!next) return SW_ENOMEM;
  for (size_t i = 0; i < w->per_ring; i++) next[i] = (uint32_t)i;
  for (size_t k = 0; k < n; k++) next[w->around[k]] = w->around[(k + 1) % n];
  size_t count = 0;
  for (size_t r = 0; r < w->rings; r++)
    for (size_t p = w->first[r]; p < w->first[r + 1]; p++) {
      const size_t i = p - w->first[r];
      const int ring = sw_web_is_ring(w, r), more = r + 1 < w->rings;
      w->side_first[p] = count;
      if (ring && next[i] == i) continue;
      w->outer[p] = 1;
      if (ring) w->side[count++] = (uint32_t)(w->first[r] + next[i]);
      if (more && ring == sw_web_is_ring(w, r + 1))
        w->side[count++] = (uint32_t)(w->first[r + 1] + i);
    }
  w->side_first[w->particles] = count;
  return SW_OK;
}

size_t sw_web_ring_of(const sw_web *w, size_t particle) {
  size_t after;
  SW_FIRST_NOT(w->first[after] <= particle, after, 1, w->rings);
  return after - 1;
}

sw_status sw_web_bound_rate(sw_web *w) {
  double *sum SW_LOCAL = sw_alloc(w->particles, sizeof *sum);
  if (!sum) return SW_ENOMEM;
  for (size_t e = 0; e < w->links; e++) {
    sum[w->link[e].a] += w->link[e].k;
    sum[w->link[e].b] += w->link[e].k;
  }
  w->rate2 = 0;
  for (size_t p = 0; p < w->particles; p++) {
    w->rate2 = fmax(w->rate2, 2.0 * sum[p] / w->mass[p]);
    w->behind[p] += sum[p];
  }
  return SW_OK;
}

/* Along the edges, the force on one edge has the distance of the other one as its lever. */
sw_status sw_web_bound_slides(sw_web *w) {
  double *sum SW_LOCAL = sw_alloc(w->particles, sizeof *sum);
  if (!sum) return SW_ENOMEM;
  SW_ITEMS(const sw_web_slide, s, w->slide, w->slides) {
    const double h = fabs(w->s[s->node[1]] - w->s[s->node[0]]), lever = 0.5 * s->apart / h;
    const double along = w->friction > 0 ? s->stick * (0.5 + lever) * (2.0 + 4.0 * lever) : 0.0;
    for (int k = 0; k < SW_SLIDE_NODES; k++) sum[s->node[k]] += fmax(s->press, along);
  }
  w->slide_rate2 = 0;
  for (size_t p = 0; p < w->particles; p++)
    w->slide_rate2 = fmax(w->slide_rate2, sum[p] / w->mass[p]);
  return SW_OK;
}

void sw_web_middle(const sw_web *w, const double *x, size_t ring, double out[3]) {
  const double *at = x + 3 * w->first[ring];
  if (!sw_web_is_ring(w, ring)) {
    out[0] = at[0], out[1] = at[1], out[2] = at[2];
    return;
  }
  out[0] = out[1] = out[2] = 0;
  for (size_t i = 0; i < w->per_ring; i++)
    for (size_t k = 0; k < 3; k++) out[k] += w->share[i] * at[3 * i + k];
}

sw_vec sw_web_centre(const sw_web *w, const double *x, size_t ring) {
  double at[3];
  sw_web_middle(w, x, ring, at);
  return sw_load(at);
}

/* Returns the direction of a line of particles at one of them: the mean of the two adjacent edges,
 * the shorter edge weighing more. */
static sw_vec line_direction(const sw_web *w, const double *x, size_t ring) {
  const sw_vec at = sw_web_centre(w, x, ring);
  sw_vec before = sw_v(0, 0, 0), after = before;
  if (ring > 0) before = sw_sub(at, sw_web_centre(w, x, ring - 1));
  if (ring + 1 < w->rings) after = sw_sub(sw_web_centre(w, x, ring + 1), at);
  const double b2 = sw_norm2(before), a2 = sw_norm2(after);
  if (!(b2 > 0) || !(a2 > 0)) return sw_unit_or(sw_add(before, after), sw_v(1, 0, 0));
  return sw_unit_or(sw_add(sw_scale(before, a2), sw_scale(after, b2)), sw_v(1, 0, 0));
}

sw_vec sw_web_facing(const sw_web *w, const double *x, size_t ring) {
  if (!sw_web_is_ring(w, ring)) return line_direction(w, x, ring);
  const double *at = x + 3 * w->first[ring];
  const sw_vec middle = sw_web_centre(w, x, ring);
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < w->around_count; k++) {
    const sw_vec p = sw_sub(sw_vec_at(at, w->around[k]), middle);
    const sw_vec q = sw_sub(sw_vec_at(at, w->around[(k + 1) % w->around_count]), middle);
    sum = sw_add(sum, sw_cross(p, q));
  }
  return sw_unit_or(sum, sw_v(1, 0, 0));
}
