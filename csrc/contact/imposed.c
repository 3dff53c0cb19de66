/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds depth that holds impose, which no force can remove. */
#include <math.h>

#include "contact/touch.h"

double sw_contact_imposed(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                          const sw_touch *t, const double *y) {
  const sw_body *b = &s->bodies[k->body];
  const int first = b->plan->held[k->node - b->first_node] != SW_FREE;
  const int last = b->plan->held[k->other - b->first_node] != SW_FREE;
  sw_closest near;
  if (!k->segment || first == last) return 0;
  const sw_vec held = sw_vec_at(y, first ? k->node : k->other);
  const sw_pose pose = c->now[k->obstacle].pose;
  const sw_vec local = sw_pose_local(pose, held);
  if (!sw_shape_point(c->obstacles[k->obstacle].shape, local, k->skin, &near)) return 0;
  const double plane = sw_dot(t->press.normal, sw_sub(held, t->point));
  const double at = fmin(fmax(t->at, 0.0), 1.0);
  const double deep = k->skin - fmax(near.gap, plane);
  return (first ? 1.0 - at : at) * fmax(0.0, deep);
}
