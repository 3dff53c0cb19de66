/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of wires that roll. Friction acts on the surface, which also moves if edges turn about
 * themselves. A turn of edge e shifts the surface point at -r n from the axis by r n x t. A node's
 * turn is the weighted mean of its edges' turns. */
#include <math.h>

#include "contact/touch.h"

static sw_vec arm(const sw_body *b, size_t edge, sw_vec normal, double weight) {
  double *const *t = b->field.tangent;
  const sw_vec along = sw_v(t[0][edge], t[1][edge], t[2][edge]);
  return sw_scale(sw_cross(normal, along), weight * b->plan->beam.radius);
}

sw_levers sw_levers_at(const sw_system *s, size_t body, size_t node, int segment, sw_vec normal) {
  const sw_body *b = &s->bodies[body];
  const sw_plan *p = b->plan;
  const size_t i = node - b->first_node;
  sw_levers l = {0};
  if (!b->roll_block) return l;
  if (segment || i == 0 || i == p->edges) {
    l.edge = i < p->edges ? i : i - 1;
    l.arm[0] = arm(b, l.edge, normal, 1.0);
    l.count = 1;
    return l;
  }
  const double after = p->rest[i] / (p->rest[i - 1] + p->rest[i]);
  l.edge = i - 1;
  l.arm[0] = arm(b, i - 1, normal, 1.0 - after);
  l.arm[1] = arm(b, i, normal, after);
  l.count = 2;
  return l;
}

sw_vec sw_levers_shift(const sw_levers *l, const double *turn, size_t stride) {
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < l->count; k++) sum = sw_madd(sum, l->arm[k], turn[(l->edge + k) * stride]);
  return sum;
}

/* Returns K v; K: upper half of a symmetric matrix. */
static sw_vec times(const double K[6], sw_vec v) {
  return sw_v(K[0] * v.x + K[1] * v.y + K[2] * v.z, K[1] * v.x + K[3] * v.y + K[4] * v.z,
              K[2] * v.x + K[4] * v.y + K[5] * v.z);
}

/* Adds friction's stiffness on the turn of lever k, and its coupling to the touch's nodes. */
static void add_lever(sw_body *b, const sw_touch *t, const sw_levers *l, size_t k,
                      const double K[6]) {
  const size_t i = t->node - b->first_node, e = l->edge + k;
  const sw_vec push = times(K, l->arm[k]);
  const double w[2] = {t->segment ? 1.0 - t->at : 1.0, t->at};
  for (size_t end = 0; end < (t->segment ? 2u : 1u); end++) {
    double *const *out = b->field.spin_node + (e == i + end ? 3 : 0);
    out[0][i + end] += w[end] * push.x;
    out[1][i + end] += w[end] * push.y;
    out[2][i + end] += w[end] * push.z;
  }
  b->field.spin_own[e] += sw_dot(l->arm[k], push);
  if (k + 1 < l->count) b->field.spin_next[e + 1] += sw_dot(l->arm[k + 1], push);
}

void sw_levers_push(sw_system *s, const sw_touch *t, const double K[6], unsigned want) {
  sw_body *b = &s->bodies[t->body];
  const sw_levers l = sw_touch_levers(s, t);
  for (size_t k = 0; k < l.count; k++) {
    b->field.spin[l.edge + k] -= sw_dot(l.arm[k], t->press.tangential);
    if (want & SW_WANT_STIFFNESS) add_lever(b, t, &l, k, K);
  }
}

/* An impulse across the wire moves the surface 1 + m r^2/I times as much as the axis. */
sw_vec sw_levers_brake(const sw_beam *beam, const sw_levers *l, sw_vec slide, double most) {
  const sw_vec whole = sw_add(l->arm[0], l->arm[1]);
  sw_vec stop = slide;
  if (l->count && sw_norm2(whole) > 0) {
    const double more = beam->mass * sw_norm2(whole) / beam->spin_inertia;
    const sw_vec across = sw_scale(whole, 1.0 / sw_norm(whole));
    stop = sw_madd(slide, across, -sw_dot(slide, across) * more / (1.0 + more));
  }
  const double size = sw_norm(stop);
  return size > 0 ? sw_scale(stop, -fmin(size, most) / size) : sw_v(0, 0, 0);
}

void sw_levers_kick(const sw_plan *p, const sw_levers *l, sw_vec impulse, double *rates) {
  for (size_t k = 0; k < l->count; k++) {
    const double inertia = p->beam.spin_inertia * p->rest[l->edge + k];
    rates[l->edge + k] += sw_dot(l->arm[k], impulse) / inertia;
  }
}
