/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far inside the pads a rod's grip has to end.
 *
 * Sections give way under the pads: what a moment turns the wire by where it leaves them is more
 * than by a clamp there. The rod's grip ends as much further inside as makes it turn the same. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/frozen_inner.h"

/* Second moment of a ring's particles across the axis of a couple, and axial parts of a turn. */
static double couple(const sw_web *web, const double *x, size_t ring, sw_vec t, sw_vec axis,
                     double *load) {
  const sw_vec e = sw_cross(t, axis), middle = sw_strand_middle(web, x, ring);
  double sum = 0;
  for (size_t p = web->first[ring]; p < web->first[ring + 1]; p++) {
    const double arm = sw_dot(sw_sub(sw_vec_at(x, p), middle), e);
    sum += arm * arm;
    if (load) sw_store(load + 3 * p, sw_scale(t, arm));
  }
  return sum;
}

/* Turn of a ring by shifts of its particles [rad]. */
static double turn_of(const sw_web *web, const double *x, size_t ring, sw_vec t, sw_vec axis,
                      const double *shift) {
  const sw_vec e = sw_cross(t, axis), middle = sw_strand_middle(web, x, ring);
  double sum = 0;
  for (size_t p = web->first[ring]; p < web->first[ring + 1]; p++)
    sum += sw_dot(sw_vec_at(shift, p), t) * sw_dot(sw_sub(sw_vec_at(x, p), middle), e);
  return sum / couple(web, x, ring, t, axis, NULL);
}

enum { OUTSIDE = 3 }; /* the couple acts so many rings outside the pads [-] */

/* Of one side: -1 before, 1 after. Nothing where the wire ends between the pads. */
static sw_status find_inside(sw_scene *s, const sw_tool *tool, sw_frozen *f, int side, double *load,
                             sw_error *err) {
  size_t pads_only[SW_TOOL_PADS];
  for (size_t k = 0; k < tool->pads; k++) pads_only[k] = tool->pad[k].obstacle;
  const sw_body *b = &s->system.bodies[f->wire.slot];
  const sw_web *web = b->plan->web;
  const double *x = s->system.x + 3 * b->first_node;
  const size_t face = side < 0 ? f->first : f->last;
  size_t ring = face;
  for (int k = 0; k < OUTSIDE; k++) {
    const size_t next = side < 0 ? ring - 1 : ring + 1;
    if (next >= web->rings || !sw_web_is_ring(web, next)) break; /* below 0 is above all, too */
    ring = next;
  }
  f->inside[side > 0] = 0;
  if (ring == face) return SW_OK;
  const sw_vec t = sw_strand_facing(web, x, ring);
  const sw_vec pads = sw_rotate(f->pose.q, f->across);
  const sw_vec axis = sw_unit_or(sw_madd(pads, t, -sw_dot(pads, t)), sw_perpendicular(t));
  memset(load, 0, 3 * web->particles * sizeof *load);
  const double second = couple(web, x, ring, t, axis, load);
  for (size_t i = 0; i < 3 * web->particles; i++) load[i] /= second; /* a moment of 1 N m */
  SW_TRY(sw_scene_linearise(s, pads_only, tool->pads, err));
  SW_TRY(sw_system_deflect(&s->system, f->wire.slot, load));
  const double turn = turn_of(web, x, ring, t, axis, load); /* [rad/(N m)] */
  const double way = fabs(f->stations.s[ring] - f->stations.s[face]);
  f->inside[side > 0] = fmax(0.0, turn * b->plan->beam.EI - way);
  return SW_OK;
}

/* Both sides; together less than the pressed length. */
sw_status sw_frozen_find_give(sw_scene *s, const sw_tool *t, sw_frozen *f, sw_error *err) {
  static const double MOST = 0.45; /* of the pressed length, each [-] */
  const sw_body *b = &s->system.bodies[f->wire.slot];
  const double most = MOST * (f->stations.s[f->last] - f->stations.s[f->first]);
  double *load = sw_alloc(3 * b->plan->nodes, sizeof *load);
  if (!load) return SW_ENOMEM;
  f->across = sw_unit_or(s->obstacles[t->pad[0].obstacle].drive.opens, sw_v(0, 1, 0));
  sw_status status = find_inside(s, t, f, -1, load, err);
  if (status == SW_OK) status = find_inside(s, t, f, 1, load, err);
  for (int k = 0; k < 2; k++) f->inside[k] = fmin(f->inside[k], most);
  sw_free(load);
  return status;
}
