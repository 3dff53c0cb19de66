/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How sharp a wire's largest curvature is against its edges. */
#include <math.h>

#include "body/spin.h"
#include "read/extremes.h"

/* Returns the curvature at node i along the axis about which the wire bends there. Beyond the
 * wire's ends and at nodes without a hinge it is that of a clamp there, along `along`, or zero. */
static sw_vec curvature_at(const sw_system *s, const sw_body *b, long i, sw_vec along) {
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  if (i > 0 && i + 1 < (long)p->nodes && p->hinge[i] > 0) {
    const sw_vec before = sw_field_tangent(f, (size_t)i - 1);
    const sw_vec axis = sw_cross(before, sw_field_tangent(f, (size_t)i));
    const double angle = sw_angle_of_chord(sw_scene_hinge_chord(f, (size_t)i));
    return sw_scale(sw_unit_or(axis, sw_v(0, 0, 0)), angle / p->hinge[i]);
  }
  double most = 0;
  for (size_t k = 0; k < p->clamp_count; k++)
    if ((long)p->clamps[k].node == i)
      most = fmax(most, sw_scene_clamp_curvature(s, b, &p->clamps[k]));
  return sw_scale(sw_unit_or(along, sw_v(0, 0, 0)), most);
}

double sw_scene_uneven(const sw_system *s, const sw_body *b, size_t node) {
  const sw_vec none = sw_v(0, 0, 0);
  const long i = (long)node;
  const sw_vec here = curvature_at(s, b, i, none);
  const sw_vec before = curvature_at(s, b, i - 1, here), after = curvature_at(s, b, i + 1, here);
  return sw_norm(sw_madd(sw_add(before, after), here, -2.0));
}

double sw_scene_uneven_at_clamp(const sw_system *s, const sw_body *b, const sw_clamp_hinge *h) {
  const long way = h->side, i = (long)h->node;
  const sw_vec next = curvature_at(s, b, i + way, sw_v(0, 0, 0));
  const sw_vec here = sw_scale(sw_unit_or(next, sw_v(0, 0, 0)), sw_scene_clamp_curvature(s, b, h));
  const sw_vec third = curvature_at(s, b, i + 2 * way, next);
  return sw_norm(sw_madd(sw_add(here, third), next, -2.0));
}
