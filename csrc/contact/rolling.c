/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness of a wire that rolls on a round side. */
#include "contact/rolling.h"

#include <math.h>

#include "touch/bow.h"
#include "touch/load.h"

/* A wire that crosses the middle line of a round side at a smaller angle rolls little: sine squared
 * [-]. */
static const double ACROSS2 = 0.25;

/* Shares of the nodes in the derivative of a touch's position with respect to its place on the
 * wire, counted in edges; their sum is 0. */
static sw_mean slope_of(const sw_body *b, const sw_touch *t) {
  const size_t first = b->first_node, edges = b->plan->edges;
  const double s = (double)(t->node - first) + t->at, centre = floor(s + 0.5);
  const int curved = t->sharp && s > 0.5 && s < (double)edges - 0.5 && edges > 1;
  const sw_bow bow = curved ? sw_bow_around(first + (size_t)centre - 1, s - centre + 0.5)
                            : sw_bow_chord(t->node, t->at);
  sw_mean slope = bow.spot;
  for (uint32_t n = 0; n < slope.count; n++) slope.w[n] = bow.slope[n];
  return slope;
}

/* The derivative, with nodes at y [m]. */
static sw_vec along_of(const sw_mean *slope, const double *y) {
  sw_vec sum = sw_v(0, 0, 0);
  for (uint32_t n = 0; n < slope->count; n++)
    sum = sw_madd(sum, sw_vec_at(y, slope->node[n]), slope->w[n]);
  return sum;
}

/* 1 if the touch is on a round side and can move along the wire. */
static int moves_on(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  if (!(c->round[t->obstacle] > 0) || !(t->press.normal_force > 0) || !t->segment) return 0;
  if (c->candidates[t->candidate].samples || s->bodies[t->body].plan->web) return 0;
  if (t->sharp) return t->sharp == SW_SHARP_ROUND && !(t->friction > 0);
  return t->at > 0 && t->at < 1;
}

void sw_contact_add_rolling(const sw_contact *c, sw_system *s, const sw_touch *t, const double *y) {
  if (!moves_on(c, s, t)) return;
  sw_body *b = &s->bodies[t->body];
  sw_vec q, axis;
  (void)sw_shape_middle(c->obstacles[t->obstacle].shape, t->local, &q, &axis);
  const sw_mean slope = slope_of(b, t);
  const sw_vec along = along_of(&slope, y), n = t->press.normal;
  const double along2 = sw_norm2(along);
  const double parallel = sw_dot(sw_rotate(c->now[t->obstacle].pose.q, axis), along);
  if (!(along2 - parallel * parallel > ACROSS2 * along2)) return;
  const double R = c->round[t->obstacle] + c->candidates[t->candidate].skin;
  const double f = t->press.normal_force * R / along2;
  const double K[6] = {f * n.x * n.x, f * n.x * n.y, f * n.x * n.z,
                       f * n.y * n.y, f * n.y * n.z, f * n.z * n.z};
  sw_load_add(b, &slope, sw_v(0, 0, 0), K);
}
