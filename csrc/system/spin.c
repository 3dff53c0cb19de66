/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each edge's frame is stored as one vector, not as an angle. An update carries this vector with
 * the tangent and turns it about the tangent, so many turns cause no branch and no drift. Only the
 * twist of hinges needs its last value, to choose among equal angles; this is valid while an
 * iteration turns no hinge by more than pi. Spins have no inertia, unless the wire rolls (roll.h):
 * torsional waves are far faster than handling. */
#include "system/spin.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/simd.h"
#include "solve/band4.h"
#include "state/hinge.h"
#include "system/part.h"
#include "system/roll.h"
#include "system/twist.h"

size_t sw_spin_state_size(const sw_plan *p) {
  return p->rest_bend ? 3 * p->edges + p->nodes + p->clamp_count : 0;
}

sw_status sw_spin_new(sw_body *b) {
  const sw_plan *p = b->plan;
  const size_t n = p->nodes, stride = n + SW_LANES;
  if (!p->rest_bend) return SW_OK;
  double *w = sw_alloc(n + p->clamp_count + 18 * stride + (4 + SW_ROW4_SIZE) * n, sizeof *w);
  if (!w) return SW_ENOMEM;
  b->spin_block = w;
  for (size_t k = 0; k < 3; k++, w += 2 * stride) {
    b->spin_normal[k] = w;
    b->spin_tangent[k] = w + stride;
  }
  b->spin_twist = w;
  w += n + p->clamp_count;
  b->field.spin = w;
  b->field.spin_own = w + stride;
  b->field.spin_next = w + 2 * stride;
  for (size_t k = 0; k < 9; k++) b->field.spin_edge[k] = w + (3 + k) * stride;
  b->spin_delta = w + 12 * stride;
  b->spin_rows = b->spin_delta + 4 * n;
  for (size_t k = 0; k < 3; k++) b->field.normals[k] = b->spin_normal[k];
  return sw_roll_new(b);
}

static sw_vec direction(const double *x, size_t e) {
  return sw_unit_or(sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e)), sw_v(1, 0, 0));
}

static void set(double *const *a, size_t e, sw_vec v) {
  a[0][e] = v.x, a[1][e] = v.y, a[2][e] = v.z;
}

static double *state_of(const sw_system *s, const sw_body *b) { return s->frames + b->first_frame; }

void sw_spin_begin(sw_system *s, sw_body *b) {
  const sw_plan *p = b->plan;
  const double *state = state_of(s, b), *x = s->x + 3 * b->first_node;
  b->spin_inertia = 0;
  for (size_t k = 0; k < 3; k++)
    memcpy(b->spin_normal[k], state + k * p->edges, p->edges * sizeof *state);
  memcpy(b->spin_twist, state + 3 * p->edges, (p->nodes + p->clamp_count) * sizeof *state);
  for (size_t e = 0; e < p->edges; e++) set(b->spin_tangent, e, direction(x, e));
  sw_roll_begin(s, b);
}

void sw_spin_slow_down(sw_system *s, double rate2) {
  SW_PART_EACH(s, k) {
    sw_body *b = &s->bodies[k];
    const sw_beam *beam = &b->plan->beam;
    if (!b->spin_block || b->roll_block) continue;
    sw_spin_begin(s, b);
    b->spin_inertia = 0.5 * beam->mass * beam->radius * beam->radius * rate2;
  }
}

static sw_vec state_normal(const sw_system *s, const sw_body *b, size_t e) {
  const double *state = state_of(s, b) + e;
  return sw_v(state[0], state[b->plan->edges], state[2 * b->plan->edges]);
}

double sw_spin_turned(const sw_system *s, const sw_body *b, size_t e) {
  const sw_vec before = direction(s->x + 3 * b->first_node, e),
               t = sw_vec_across(b->spin_tangent, e);
  const sw_vec n = sw_carry_unit(state_normal(s, b, e), before, t);
  const sw_vec now = sw_vec_across(b->spin_normal, e);
  return atan2(sw_dot(sw_cross(n, now), t), sw_dot(n, now));
}

static sw_edge_frame edge_frame(const sw_body *b, size_t e) {
  return (sw_edge_frame){sw_vec_across(b->spin_tangent, e), sw_vec_across(b->spin_normal, e)};
}

/* sw_hinge_twist between all edges, usual case only. Returns the number of other cases. */
SW_HOT
static long small_twists(size_t n, const double *restrict tx, const double *restrict ty,
                         const double *restrict tz, const double *restrict nx,
                         const double *restrict ny, const double *restrict nz,
                         const double *restrict before, double *restrict out) {
  long others = 0;
  for (size_t i = 1; i + 1 < n; i++) {
    const size_t h = i - 1;
    const double dot = tx[h] * tx[i] + ty[h] * ty[i] + tz[h] * tz[i];
    const double share = (nx[h] * tx[i] + ny[h] * ty[i] + nz[h] * tz[i]) / (1.0 + dot);
    const double ux = nx[h] - share * (tx[h] + tx[i]), uy = ny[h] - share * (ty[h] + ty[i]);
    const double uz = nz[h] - share * (tz[h] + tz[i]);
    const double cx = uy * nz[i] - uz * ny[i], cy = uz * nx[i] - ux * nz[i];
    const double cz = ux * ny[i] - uy * nx[i];
    const double sine = cx * tx[i] + cy * ty[i] + cz * tz[i];
    const double half = sine / (1.0 + ux * nx[i] + uy * ny[i] + uz * nz[i]), y = half * half;
    others += !(y < 0.01) | !(before[i] * before[i] < 1.0);
    out[i] = SW_TWICE_ATAN(half, y);
  }
  return others;
}

static void measure_twist(const sw_system *s, sw_body *b) {
  const sw_plan *p = b->plan;
  double *const *t = b->spin_tangent, *const *n = b->spin_normal, *measured = b->field.scratch[3];
  if (small_twists(p->nodes, t[0], t[1], t[2], n[0], n[1], n[2], b->spin_twist, measured))
    for (size_t i = 1; i + 1 < p->nodes; i++) {
      const sw_edge_frame before = edge_frame(b, i - 1), after = edge_frame(b, i);
      if (p->hinge[i] > 0) measured[i] = sw_hinge_twist(&before, &after, b->spin_twist[i]);
    }
  if (p->nodes > 2) memcpy(b->spin_twist + 1, measured + 1, (p->nodes - 2) * sizeof *measured);
  for (size_t c = 0; c < p->clamp_count; c++) {
    const sw_clamp_hinge *h = &p->clamps[c];
    const size_t at = 2 * (size_t)h->hold + (h->side > 0 ? 1 : 0);
    const sw_edge_frame held = {sw_vec_at(s->directors_now, at), sw_vec_at(s->normals_now, at)};
    const sw_edge_frame edge = edge_frame(b, h->edge);
    double *twist = &b->spin_twist[p->nodes + c];
    *twist =
        h->side > 0 ? sw_hinge_twist(&held, &edge, *twist) : sw_hinge_twist(&edge, &held, *twist);
  }
}

long sw_spin_held_edge(const sw_system *s, const sw_body *b, size_t number) {
  if (number + 1 >= s->held_count) return -1;
  const sw_held_node *h = &s->held[number], *next = h + 1;
  if (&s->bodies[h->body] != b || next->hold != h->hold || next->node != h->node + 1) return -1;
  return (long)(h->node - b->first_node);
}

static sw_vec square_up(sw_vec n, sw_vec t) {
  return sw_unit_or(sw_madd(n, t, -sw_dot(n, t)), sw_perpendicular(t));
}

/* Turns edges between two nodes of one hold with that hold. */
static void turn_held_edges(const sw_system *s, sw_body *b) {
  for (size_t i = 0; i + 1 < s->held_count; i++) {
    const long held = sw_spin_held_edge(s, b, i);
    if (held < 0) continue;
    const size_t e = (size_t)held;
    const sw_held_node *h = &s->held[i];
    const double *q = s->turn + 4 * h->hold;
    const sw_quat before = {q[0], q[1], q[2], q[3]};
    const sw_vec n =
        sw_rotate(s->hold_states[h->hold].pose.q, sw_unrotate(before, state_normal(s, b, e)));
    const sw_vec t = sw_vec_across(b->spin_tangent, e);
    set(b->spin_normal, e, square_up(n, t));
    if (b->roll_block)
      b->roll_turn[e] += remainder(sw_spin_turned(s, b, e) - b->roll_turn[e], 6.283185307179586477);
  }
}

/* sw_carry_unit for all edges, usual case only. Returns the number of other cases. */
SW_HOT
static long carry_all(size_t m, const double *restrict tx, const double *restrict ty,
                      const double *restrict tz, const double *restrict bx,
                      const double *restrict by, const double *restrict bz, double *restrict nx,
                      double *restrict ny, double *restrict nz) {
  long others = 0;
  for (size_t e = 0; e < m; e++) {
    const double dot = bx[e] * tx[e] + by[e] * ty[e] + bz[e] * tz[e];
    const double share = (nx[e] * tx[e] + ny[e] * ty[e] + nz[e] * tz[e]) / (1.0 + dot);
    const double ux = nx[e] - share * (bx[e] + tx[e]), uy = ny[e] - share * (by[e] + ty[e]);
    const double uz = nz[e] - share * (bz[e] + tz[e]);
    const double along = ux * tx[e] + uy * ty[e] + uz * tz[e];
    const double wx = ux - along * tx[e], wy = uy - along * ty[e], wz = uz - along * tz[e];
    const double off = wx * wx + wy * wy + wz * wz - 1.0, f = 1.0 - 0.5 * off;
    others += !(off * off < 1e-16);
    nx[e] = f * wx, ny[e] = f * wy, nz[e] = f * wz;
  }
  return others;
}

/* Carries all frames to tangents t. */
static void carry_on(sw_body *b, double *const t[3]) {
  double *const *o = b->spin_tangent, *const *n = b->spin_normal;
  const size_t m = b->plan->edges;
  sw_roll_carry(b, t);
  if (carry_all(m, t[0], t[1], t[2], o[0], o[1], o[2], n[0], n[1], n[2]))
    for (size_t e = 0; e < m; e++) /* makes normals exact unit vectors across t */
      set(n, e, square_up(sw_vec_across(n, e), sw_vec_across(t, e)));
  for (size_t k = 0; k < 3; k++) memcpy(o[k], t[k], m * sizeof(double));
}

/* Carries all frames to the body's positions x. */
static void carry_to(sw_body *b, const double *x) {
  double *const *t = b->field.scratch;
  sw_edge_directions(0, b->plan->edges - 1, x, t[0], t[1], t[2]);
  carry_on(b, t);
}

static void point_field(const sw_system *s, sw_body *b, const double *normals, long stride,
                        const double *twist) {
  for (long k = 0; k < 3; k++) b->field.normals[k] = normals + k * stride;
  b->field.hinge_twist = twist;
  b->field.hold_normals = s->normals_now;
}

void sw_spin_carry(sw_system *s, sw_body *b) {
  carry_on(b, b->field.tangent);
  turn_held_edges(s, b);
  measure_twist(s, b);
  point_field(s, b, b->spin_normal[0], b->spin_normal[1] - b->spin_normal[0], b->spin_twist);
}

static void store(sw_system *s, sw_body *b) {
  const sw_plan *p = b->plan;
  double *state = state_of(s, b);
  measure_twist(s, b);
  for (size_t k = 0; k < 3; k++)
    memcpy(state + k * p->edges, b->spin_normal[k], p->edges * sizeof *state);
  memcpy(state + 3 * p->edges, b->spin_twist, (p->nodes + p->clamp_count) * sizeof *state);
}

void sw_spin_take(sw_system *s, sw_body *b, const double *x) {
  carry_to(b, x);
  store(s, b);
}

void sw_spin_follow(sw_system *s, sw_body *b, const double *x) {
  carry_to(b, x + 3 * b->first_node);
  if (b->roll_block) { /* the result of a method may differ from its last stage */
    sw_roll_rest(s, b, x, b->field.scratch[0]);
    sw_spin_turn_by(b, b->field.scratch[0], 1, 1.0);
  }
  turn_held_edges(s, b);
  store(s, b);
}

void sw_spin_begin_stage(sw_system *s, double rate2) {
  for (size_t k = 0; k < s->body_count; k++) sw_roll_predict(s, &s->bodies[k], rate2);
}

void sw_spin_end_stage(sw_system *s, double *y) {
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    if (!b->roll_block) continue;
    carry_to(b, y + 3 * b->first_node);
    turn_held_edges(s, b);
    sw_roll_store(s, b, y);
  }
}

void sw_spin_show(sw_system *s, sw_body *b) {
  const size_t m = b->plan->edges;
  point_field(s, b, state_of(s, b), (long)m, state_of(s, b) + 3 * m);
}

void sw_spin_turn(sw_body *b, double share) { sw_spin_turn_by(b, b->spin_delta + 3, 4, share); }

void sw_spin_turn_by(sw_body *b, const double *turns, size_t stride, double share) {
  sw_roll_add(b, turns, stride, share);
  for (size_t e = 0; e < b->plan->edges; e++) {
    const double angle = share * turns[stride * e];
    if (angle == 0) continue;
    const sw_vec n = sw_vec_across(b->spin_normal, e), t = sw_vec_across(b->spin_tangent, e);
    const double a2 = angle * angle;
    const int small = a2 < 1e-4; /* series, exact to rounding */
    const double c = small ? 1.0 - a2 * (0.5 - a2 * (1.0 / 24 - a2 / 720)) : cos(angle);
    const double sine =
        small ? angle * (1.0 - a2 * (1.0 / 6 - a2 * (1.0 / 120 - a2 / 5040))) : sin(angle);
    set(b->spin_normal, e, sw_madd(sw_scale(n, c), sw_cross(t, n), sine));
  }
}
