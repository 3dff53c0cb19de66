/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth that holds impose and no force can take away. */
#include <math.h>

#include "contact/round.h"
#include "contact/touch.h"

/* Height of a node over a round surface that the wire touches with its edges' middles: h^2/(8 R)
 * [m]. A node held on the surface itself lacks this height. Unless the height is allowed for, the
 * wire bends half as much again beside the held node as it does further on. */
static double bulge(const sw_contact *c, const sw_candidate *k, sw_vec held, sw_vec other) {
  const sw_vec edge = sw_sub(other, held);
  const double radius = c->round[k->obstacle] + k->skin, length = sw_norm(edge);
  sw_vec q, along;
  if (k->round || !(c->round[k->obstacle] > 0) || !(radius > SW_THICK * length)) return 0;
  if (!(sw_shape_middle(c->obstacles[k->obstacle].shape, held, &q, &along) > 0)) return 0;
  return sw_norm2(sw_madd(edge, along, -sw_dot(along, edge))) / (8.0 * radius);
}

double sw_contact_imposed(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                          const sw_touch *t, const double *y) {
  const sw_body *b = &s->bodies[k->body];
  const int first = b->plan->held[k->node - b->first_node] != SW_FREE;
  const int last = b->plan->held[k->other - b->first_node] != SW_FREE;
  sw_closest near;
  if (!k->segment || first == last) return 0;
  const sw_vec held = sw_vec_at(y, first ? k->node : k->other);
  const sw_vec other = sw_vec_at(y, first ? k->other : k->node);
  const sw_pose pose = c->now[k->obstacle].pose;
  const sw_vec local = sw_pose_local(pose, held);
  const double more = bulge(c, k, local, sw_pose_local(pose, other));
  if (!sw_shape_point(c->obstacles[k->obstacle].shape, local, k->skin + more, &near)) return 0;
  const double plane = sw_dot(t->press.normal, sw_sub(held, t->point));
  const double at = fmin(fmax(t->at, 0.0), 1.0);
  const double deep = k->skin + more - fmax(near.gap, plane);
  return (first ? 1.0 - at : at) * fmax(0.0, deep);
}
