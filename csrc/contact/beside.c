/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds round obstacles beside a node of a wire. */
#include <math.h>

#include "contact/touch.h"

double sw_contact_round_beside(const sw_contact *c, const sw_system *s, size_t node) {
  size_t first = 0, end = 0;
  double radius = 0;
  if (c) sw_contact_touches_of(c, node > 0 ? node - 1 : 0, node + 2, &first, &end);
  for (size_t k = first; k < end; k++) {
    sw_contact_push push;
    sw_vec q, along;
    if (!sw_contact_push_at(c, s, k, &push)) continue;
    const size_t o = sw_contact_index(c, push.obstacle);
    const sw_vec point = sw_pose_local(c->now[o].pose, push.point);
    radius = fmax(radius, sw_shape_middle(c->obstacles[o].shape, point, &q, &along));
  }
  return radius;
}
