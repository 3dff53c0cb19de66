/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of wires that roll. Friction acts on the surface, at -r n from the axis (normal n). This
 * point also moves
 * - across the wire, if edges turn about themselves: a turn of edge e shifts it by r n x t (tangent
 *   t). A node's turn is the weighted mean of its edges' turns;
 * - along the wire, if it tilts: a section stays at right angles to the tangent and carries the
 * point at the speed r (n . dt/dt) along t. A drum that turns at w drives a wire's surface at w R
 * and its axis at w (R + r). The couple of friction about the axis is the other side of it: round a
 * fixed peg dT/dphi = mu T R / (R + r). */
#include "contact/surface.h"

#include <math.h>

#include "solve/band3.h"
#include "touch/load.h"

static sw_vec tangent_of(const sw_body *b, size_t edge) {
  double *const *t = b->field.tangent;
  return sw_v(t[0][edge], t[1][edge], t[2][edge]);
}

static sw_vec arm(const sw_body *b, size_t edge, sw_vec normal, double weight) {
  return sw_scale(sw_cross(normal, tangent_of(b, edge)), weight * b->plan->beam.radius);
}

/* Sets the effect of tilts, from the chord between nodes i and j of a body. A chord along the
 * normal, as of a wire that stands on its end, has none. */
static void tilt_of(const sw_body *b, size_t i, size_t j, sw_vec normal, sw_levers *l) {
  sw_vec chord = sw_v(0, 0, 0);
  for (size_t e = i; e < j; e++) chord = sw_madd(chord, tangent_of(b, e), b->field.length[e]);
  const double length2 = sw_norm2(chord);
  const sw_vec flat = sw_madd(chord, normal, -sw_dot(chord, normal));
  const double flat2 = sw_norm2(flat);
  if (!(flat2 > 0)) return;
  l->node[0] = b->first_node + i, l->node[1] = b->first_node + j;
  l->along = sw_scale(flat, 1.0 / sqrt(flat2));
  const sw_vec across = sw_madd(normal, chord, -sw_dot(normal, chord) / length2);
  l->pry = sw_scale(across, b->plan->beam.radius / sqrt(length2));
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
    tilt_of(b, l.edge, l.edge + 1, normal, &l);
    return l;
  }
  const double after = p->rest[i] / (p->rest[i - 1] + p->rest[i]);
  l.edge = i - 1;
  l.arm[0] = arm(b, i - 1, normal, 1.0 - after);
  l.arm[1] = arm(b, i, normal, after);
  l.count = 2;
  tilt_of(b, i - 1, i + 1, normal, &l);
  return l;
}

sw_vec sw_levers_shift(const sw_levers *l, const double *turn, size_t stride) {
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < l->count; k++) sum = sw_madd(sum, l->arm[k], turn[(l->edge + k) * stride]);
  return sum;
}

sw_vec sw_levers_tilt(const sw_levers *l, const double *motion) {
  const sw_vec chord = sw_sub(sw_vec_at(motion, l->node[1]), sw_vec_at(motion, l->node[0]));
  return sw_scale(l->along, sw_dot(l->pry, chord));
}

sw_vec sw_obstacle_velocity_before(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_contact_at *from = &c->start[t->obstacle];
  const sw_body *b = &s->bodies[t->body];
  const double lies = b->roll_block ? sw_norm(t->edge) : 0.0;
  const double lever = b->roll_block ? b->plan->beam.radius - lies : 0.0;
  const sw_vec n = t->press.normal, axis = sw_madd(t->acts, n, lever);
  const sw_vec back = sw_sub(sw_mean_of(s->x, 0, &t->spot), axis);
  const sw_vec v = sw_obstacle_velocity(from, sw_add(t->point, back));
  if (!(lies > 0)) return v;
  const sw_vec along = t->edge_now;
  return sw_madd(v, along, sw_dot(along, sw_cross(from->omega, n)) / lies);
}

sw_vec sw_touch_moment(const sw_touch *t, sw_vec about, sw_vec f) {
  const sw_vec moment = sw_cross(sw_sub(t->acts, about), f);
  const double lever = t->sharp ? 0.0 : sw_norm(t->edge);
  if (!(lever > 0)) return moment;
  const sw_vec along = sw_scale(t->edge_now, 1.0 / lever);
  return sw_madd(moment, along, lever * sw_dot(sw_cross(t->press.normal, along), f));
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

/* Adds the coupling of two nodes in any order: left between the first and the second one, and its
 * transpose `right` [N/m]. */
static void couple(sw_body *b, uint32_t i, uint32_t j, const double left[9],
                   const double right[9]) {
  if (i != j) {
    sw_load_couple(b, i < j ? i : j, i < j ? j : i, i < j ? left : right);
    return;
  }
  static const size_t upper[6] = {0, 1, 2, 4, 5, 8};
  double *own = b->field.rows + SW_ROW_SIZE * (i - b->first_node) + SW_ROW_OWN;
  for (int m = 0; m < 6; m++) own[m] += left[upper[m]] + right[upper[m]];
}

/* Adds the coupling of the chord's edges to the turn of lever k; push: K along. */
static void couple_turn(sw_body *b, const sw_levers *l, size_t k, sw_vec push) {
  const size_t spin = l->edge + k;
  const sw_vec c = sw_scale(l->pry, sw_dot(l->arm[k], push));
  for (size_t e = l->node[0] - b->first_node; e < l->node[1] - b->first_node; e++) {
    double *const *out = b->field.spin_edge + (spin == e ? 0 : spin < e ? 3 : 6);
    const size_t at = spin > e ? spin : e;
    out[0][at] += c.x, out[1][at] += c.y, out[2][at] += c.z;
  }
}

/* Adds friction's stiffness on tilts, and its coupling to turns and to the touch's nodes. */
static void add_tilt(sw_body *b, const sw_touch *t, const sw_levers *l, const double K[6]) {
  const sw_mean chord = {2, {(uint32_t)l->node[0], (uint32_t)l->node[1], 0}, {-1.0, 1.0, 0}};
  const sw_vec push = times(K, l->along), p = l->pry;
  const double f = sw_dot(push, l->along);
  const double own[6] = {f * p.x * p.x, f * p.x * p.y, f * p.x * p.z,
                         f * p.y * p.y, f * p.y * p.z, f * p.z * p.z};
  sw_load_add(b, &chord, sw_v(0, 0, 0), own);
  for (size_t k = 0; k < l->count; k++) couple_turn(b, l, k, push);
  for (uint32_t i = 0; i < t->spot.count; i++) {
    for (uint32_t k = 0; k < 2; k++) {
      double left[9] = {0}, right[9] = {0};
      sw_add_outer(left, push, p, t->spot.w[i] * chord.w[k]);
      sw_add_outer(right, p, push, t->spot.w[i] * chord.w[k]);
      couple(b, t->spot.node[i], chord.node[k], left, right);
    }
  }
}

static void push_tilt(sw_body *b, const sw_touch *t, const sw_levers *l, const double K[6],
                      unsigned want) {
  const double friction = sw_dot(t->press.tangential, l->along);
  const sw_mean chord = {2, {(uint32_t)l->node[0], (uint32_t)l->node[1], 0}, {-1.0, 1.0, 0}};
  if (!(sw_norm2(l->pry) > 0)) return;
  sw_load_force(b, &chord, sw_scale(l->pry, friction));
  if (want & SW_WANT_STIFFNESS) add_tilt(b, t, l, K);
}

void sw_levers_push(sw_system *s, const sw_touch *t, const double K[6], unsigned want) {
  sw_body *b = &s->bodies[t->body];
  const sw_levers l = sw_touch_levers(s, t);
  for (size_t k = 0; k < l.count; k++) {
    b->field.spin[l.edge + k] -= sw_dot(l.arm[k], t->press.tangential);
    if (want & SW_WANT_STIFFNESS) add_lever(b, t, &l, k, K);
  }
  push_tilt(b, t, &l, K, want);
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

sw_vec sw_levers_struck(const sw_levers *l, sw_vec slide, const double *velocities) {
  const double axis = sw_dot(slide, l->along);
  const double surface = axis + sw_dot(sw_levers_tilt(l, velocities), l->along);
  const double both = fabs(surface) < fabs(axis) ? surface : axis;
  return sw_madd(slide, l->along, (axis * surface > 0 ? both : 0.0) - axis);
}
