/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads on the surface of a wire that is a mesh, and stresses of its solid elements. */
#include <math.h>
#include <string.h>

#include "body/build.h"
#include "contact/contact.h"
#include "force/solid.h"
#include "read/kept_frames.h"
#include "read/section.h"
#include "scene/parts.h"
#include "scene/review.h"
#include "scene/wire.h"
#include "strand/ring.h"

static sw_status open_mesh(sw_scene *s, sw_handle h, const char *what, const sw_body **body,
                           sw_error *err) {
  sw_scene_wire *wire;
  SW_TRY(sw_scene_open_wire(s, h, &wire, err));
  *body = &sw_scene_system(s)->bodies[h.slot];
  if (sw_scene_has_sections(wire)) return SW_OK;
  sw_scene_asks_other_model(s);
  return sw_fail(err, SW_EINVAL,
                 "wire:%s: wire '%s' is a %s, which has no surface of its own; this is for meshes "
                 "of particles (model = 'tube', 'radial', 'cubic', ...)",
                 what, wire->name, wire->cls->name);
}

/* --- contact ------------------------------------------------------------------------- */

void sw_strand_pressed(const sw_scene *s, const sw_body *b, double *normal, double *force) {
  const size_t n = b->plan->nodes,
               count = sw_scene_contact(s) ? sw_contact_touches(sw_scene_contact(s)) : 0;
  memset(normal, 0, n * sizeof *normal);
  if (force) memset(force, 0, 3 * n * sizeof *force);
  for (size_t k = 0; k < count; k++) {
    sw_contact_push push;
    if (!sw_contact_push_at(sw_scene_contact(s), sw_scene_system(s), k, &push)) continue;
    if (push.node < b->first_node || push.node >= b->first_node + n) continue;
    const size_t ends[2] = {push.node - b->first_node, push.other - b->first_node};
    const double share[2] = {1.0 - push.at, push.at};
    for (int i = 0; i < 2; i++) { /* a single particle that is pressed is both ends */
      const double part = push.node == push.other ? 0.5 : share[i];
      normal[ends[i]] += part * push.normal_force;
      if (force) sw_accumulate(force + 3 * ends[i], sw_scale(push.force, part));
    }
  }
}

/* Returns the length of a ring's outline that belongs to point k: half of both its sides, plus skin
 * times the angle between them. */
static double own_round(const double *outline, size_t n, size_t k, double skin, sw_vec tangent) {
  const sw_vec p = sw_vec_at(outline, k);
  const sw_vec a = sw_sub(p, sw_vec_at(outline, (k + n - 1) % n));
  const sw_vec b = sw_sub(sw_vec_at(outline, (k + 1) % n), p);
  const double angle = atan2(sw_dot(sw_cross(a, b), tangent), sw_dot(a, b));
  return fmax(0.0, 0.5 * (sw_norm(a) + sw_norm(b)) + skin * angle);
}

/* Returns the length along the wire that belongs to a particle: half the distances to both
 * neighbours. */
static double own_along(const sw_web *w, const double *x, size_t ring, size_t particle) {
  const sw_vec at = sw_vec_at(x, w->first[ring] + particle);
  const int before = ring > 0 && sw_web_is_ring(w, ring - 1);
  const int after = ring + 1 < w->rings && sw_web_is_ring(w, ring + 1);
  double sum = 0;
  if (before) sum += sw_dist(at, sw_vec_at(x, w->first[ring - 1] + particle));
  if (after) sum += sw_dist(at, sw_vec_at(x, w->first[ring + 1] + particle));
  return 0.5 * sum;
}

sw_status sw_scene_wire_pressed(sw_scene *s, sw_handle h, double *force, double *normal,
                                double *area, double *arc, sw_error *err) {
  const sw_body *b;
  double outline[3 * SW_OUTLINE];
  SW_TRY(open_mesh(s, h, "contact_pressure", &b, err));
  const sw_web *w = b->plan->web;
  const double *x = sw_scene_system(s)->x + 3 * b->first_node;
  sw_strand_pressed(s, b, normal, force);
  memset(area, 0, w->particles * sizeof *area);
  for (size_t p = 0; p < w->particles; p++) arc[p] = w->s[p] - w->s[0];
  for (size_t r = 0; r < w->rings; r++) {
    if (!sw_web_is_ring(w, r)) continue; /* a line has no surface of its own */
    const sw_vec t = sw_web_facing(w, x, r);
    sw_strand_outline(w, x, r, outline);
    for (size_t k = 0; k < w->around_count; k++)
      area[w->first[r] + w->around[k]] =
          own_round(outline, w->around_count, k, w->skin - w->proud, t) *
          own_along(w, x, r, w->around[k]);
  }
  return SW_OK;
}

/* --- solid elements -------------------------------------------------------------------- */

sw_status sw_scene_wire_elements(sw_scene *s, sw_handle h, size_t *count, sw_error *err) {
  const sw_body *b;
  SW_TRY(open_mesh(s, h, "von_mises", &b, err));
  *count = b->plan->web->shapes ? b->plan->web->solids : 0;
  if (*count > 0) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "wire:von_mises: wire '%s' is a mesh of springs; the von Mises stress is that of "
                 "solid elements",
                 sw_scene_wire_name(s, h));
}

sw_status sw_scene_wire_mises(sw_scene *s, sw_handle h, double *mises, double *middle, double *arc,
                              sw_error *err) {
  const sw_body *b;
  SW_TRY(open_mesh(s, h, "von_mises", &b, err));
  const sw_web *w = b->plan->web;
  for (size_t n = 0; n < w->solids; n++) {
    const sw_web_solid *e = &w->solid[n];
    double at[3 * SW_SOLID_NODES];
    sw_vec sum = sw_v(0, 0, 0);
    for (uint32_t i = 0; i < e->count; i++) {
      const sw_vec p = sw_vec_at(sw_scene_system(s)->x + 3 * b->first_node, e->node[i]);
      sw_store(at + 3 * i, p);
      sum = sw_add(sum, p);
    }
    sw_solid_stress((const sw_solid *)w->shapes + sw_plan_shape(b->plan, e), at, NULL, &mises[n],
                    NULL);
    sw_store(middle + 3 * n, sw_scale(sum, 1.0 / e->count));
    arc[2 * n] = w->s[e->node[0]] - w->s[0];
    arc[2 * n + 1] = w->s[e->node[e->count - 1]] - w->s[0];
  }
  return SW_OK;
}
