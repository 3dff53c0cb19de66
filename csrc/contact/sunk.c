/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moves the outer particles of some meshes inwards, for contact only. These particles lie outside
 * the section that they represent, because this gives the right bending stiffness. Contact must use
 * the surface of the section. So it moves the particles inwards, along the normal of their
 * neighbours at the step's start. */
#include <string.h>

#include "base/alloc.h"
#include "contact/touch.h"

static sw_vec particle(const double *x, size_t i) { return sw_load(x + 3 * i); }

/* Outward direction at particle k of a ring's outline. Particles of the same number lie along the
 * wire; the outline goes anticlockwise round it. */
static sw_vec outward(const sw_web *w, const double *x, size_t ring, size_t k) {
  const size_t n = w->around_count, own = w->around[k];
  const size_t before = ring > 0 && sw_web_is_ring(w, ring - 1) ? ring - 1 : ring;
  const size_t after = ring + 1 < w->rings && sw_web_is_ring(w, ring + 1) ? ring + 1 : ring;
  const sw_vec along =
      sw_sub(particle(x, w->first[after] + own), particle(x, w->first[before] + own));
  const double *at = x + 3 * w->first[ring];
  const sw_vec here = particle(at, own), none = sw_v(0, 0, 0);
  const sw_vec a = sw_sub(here, particle(at, w->around[(k + n - 1) % n]));
  const sw_vec b = sw_sub(particle(at, w->around[(k + 1) % n]), here);
  const sw_vec sum =
      sw_add(sw_unit_or(sw_cross(a, along), none), sw_unit_or(sw_cross(b, along), none));
  return sw_unit_or(sum, none);
}

static void sink(const sw_web *w, const double *x, double *out) {
  for (size_t r = 0; r < w->rings; r++) {
    if (!sw_web_is_ring(w, r)) continue;
    for (size_t k = 0; k < w->around_count; k++)
      sw_store(out + 3 * (w->first[r] + w->around[k]), sw_scale(outward(w, x, r, k), w->proud));
  }
}

sw_status sw_contact_sink(sw_contact *c, const sw_system *s) {
  int any = 0;
  for (size_t b = 0; b < s->body_count; b++)
    any |= s->bodies[b].plan->web && s->bodies[b].plan->web->proud > 0;
  if (!any) {
    sw_free(c->sunk);
    c->sunk = NULL, c->sunk_capacity = 0;
    return SW_OK;
  }
  SW_TRY(SW_GROW(c->sunk, c->sunk_capacity, 3 * s->nodes));
  memset(c->sunk, 0, 3 * s->nodes * sizeof *c->sunk);
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    const sw_web *w = body->plan->web;
    if (w && w->proud > 0) sink(w, s->x + 3 * body->first_node, c->sunk + 3 * body->first_node);
  }
  return SW_OK;
}
