/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of wires that roll: friction acts on the wire's surface, which also moves when
 * edges turn about themselves. A turn of edge e shifts the surface, which is -r n from
 * the axis, by r n x t. The turn at a node is the mean of its edges', each for the half
 * of the node's share that is on it. */
#include <math.h>

#include "contact/touch.h"

static sw_vec lever(const sw_body *b, size_t edge, sw_vec normal, double weight) {
  double *const *t = b->field.tangent;
  const sw_vec along = sw_v(t[0][edge], t[1][edge], t[2][edge]);
  return sw_scale(sw_cross(normal, along), weight * b->plan->beam.radius);
}

void sw_touch_take_levers(const sw_system *s, sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  const sw_plan *p = b->plan;
  const size_t i = t->node - b->first_node;
  t->levers = 0;
  if (!b->roll_block) return;
  if (t->segment || i == 0 || i == p->edges) {
    t->edge = i < p->edges ? i : i - 1;
    t->lever[0] = lever(b, t->edge, t->normal, 1.0);
    t->levers = 1;
    return;
  }
  const double after = p->rest[i] / (p->rest[i - 1] + p->rest[i]);
  t->edge = i - 1;
  t->lever[0] = lever(b, i - 1, t->normal, 1.0 - after);
  t->lever[1] = lever(b, i, t->normal, after);
  t->levers = 2;
}

sw_vec sw_touch_surface_shift(const sw_touch *t, const double *turn, size_t stride) {
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < t->levers; k++)
    sum = sw_madd(sum, t->lever[k], turn[(t->edge + k) * stride]);
  return sum;
}

/* out = K v, K by its upper half. */
static sw_vec times(const double K[6], sw_vec v) {
  return sw_v(K[0] * v.x + K[1] * v.y + K[2] * v.z, K[1] * v.x + K[3] * v.y + K[4] * v.z,
              K[2] * v.x + K[4] * v.y + K[5] * v.z);
}

/* What friction does to the turn of lever k and its coupling to the touch's nodes. */
static void add_lever(sw_body *b, const sw_touch *t, size_t k, const double K[6]) {
  const size_t i = t->node - b->first_node, e = t->edge + k;
  const sw_vec push = times(K, t->lever[k]);
  const double w[2] = {t->segment ? 1.0 - t->at : 1.0, t->at};
  for (size_t end = 0; end < (t->segment ? 2u : 1u); end++) {
    double *const *out = b->field.spin_node + (e == i + end ? 3 : 0);
    out[0][i + end] += w[end] * push.x;
    out[1][i + end] += w[end] * push.y;
    out[2][i + end] += w[end] * push.z;
  }
  b->field.spin_own[e] += sw_dot(t->lever[k], push);
  if (k + 1 < t->levers) b->field.spin_next[e + 1] += sw_dot(t->lever[k + 1], push);
}

void sw_touch_push_surface(sw_system *s, const sw_touch *t, const double K[6], unsigned want) {
  sw_body *b = &s->bodies[t->body];
  for (size_t k = 0; k < t->levers; k++) {
    b->field.spin[t->edge + k] -= sw_dot(t->lever[k], t->tangential);
    if (want & SW_WANT_STIFFNESS) add_lever(b, t, k, K);
  }
}

/* An impulse across the wire moves the surface more than the axis, by the inertia
 * against turning: by 1 + m r^2/I of it. */
sw_vec sw_touch_brake(const sw_system *s, const sw_touch *t, sw_vec slide, double most) {
  const sw_beam *beam = &s->bodies[t->body].plan->beam;
  sw_vec stop = slide, whole = t->lever[0];
  if (t->levers > 1) whole = sw_add(whole, t->lever[1]);
  if (t->levers && sw_norm2(whole) > 0) {
    const double more = beam->mass * sw_norm2(whole) / beam->spin_inertia;
    const sw_vec across = sw_scale(whole, 1.0 / sw_norm(whole));
    stop = sw_madd(slide, across, -sw_dot(slide, across) * more / (1.0 + more));
  }
  const double size = sw_norm(stop);
  return size > 0 ? sw_scale(stop, -fmin(size, most) / size) : sw_v(0, 0, 0);
}

void sw_touch_kick(const sw_system *s, const sw_touch *t, sw_vec impulse, double *rates) {
  const sw_body *b = &s->bodies[t->body];
  for (size_t k = 0; k < t->levers; k++) {
    const double inertia = b->plan->beam.spin_inertia * b->plan->rest[t->edge + k];
    rates[t->edge + k] += sw_dot(t->lever[k], impulse) / inertia;
  }
}
