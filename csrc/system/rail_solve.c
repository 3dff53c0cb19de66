/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves the rails' own equations: the effect of a shift of each rail's node on all other unknowns,
 * and the step of each rail. */
#include <math.h>
#include <string.h>

#include "solve/band3.h"
#include "solve/band4.h"
#include "solve/dense.h"
#include "system/bridge.h"
#include "system/part.h"
#include "system/rail_inner.h"
#include "system/twist.h"

/* Largest turn of the curve's tangent in one update [rad]. */
static const double LARGEST_TURN = 0.5;
/* Relative accuracy of the friction's balance with the force across [-]. */
static const double KNOWN = 1e-7;

/* --- effect of a shift on the others ------------------------------------------------ */

static sw_vec transposed_times(const double K[9], sw_vec d) {
  return sw_v(K[0] * d.x + K[3] * d.y + K[6] * d.z, K[1] * d.x + K[4] * d.y + K[7] * d.z,
              K[2] * d.x + K[5] * d.y + K[8] * d.z);
}

void sw_rail_take(sw_rail *r, const sw_body *b, size_t i) {
  static const int whole[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (int k = 0; k < 9; k++) r->own[k] = b->field.rows[SW_ROW_SIZE * i + (size_t)whole[k]];
}

/* Offsets of the four neighbours in a held node's saved blocks. */
static const long BESIDE[4] = {-2, -1, 1, 2};

static int is_free(const sw_body *b, size_t i, long beside) {
  const long j = (long)i + beside;
  return j >= 0 && j < (long)b->plan->nodes && b->plan->held[j] == SW_FREE;
}

/* Returns the slope of the twist of a body's span at node i, or zero. */
static sw_vec slope_of(const sw_body *b, const sw_span *span, size_t i) {
  if (i <= span->first || i > span->last) return sw_v(0, 0, 0); /* clamps are at the span's ends */
  return sw_vec_at(b->twist_rank, i);
}

static void add_spin_rights(const sw_body *b, size_t i, sw_vec d, double *spins) {
  const sw_field *f = &b->field;
  const size_t edges = b->plan->edges;
  for (int side = 0; side < 2; side++) {
    const size_t e = side ? i : i - 1;
    const sw_vec way = side ? d : sw_neg(d); /* minus the change of the edge */
    if ((!side && i == 0) || e >= edges) continue;
    spins[e] += sw_dot(sw_vec_across(f->spin_edge, e), way);
    if (e > 0) spins[e - 1] += sw_dot(sw_vec_across(f->spin_edge + 3, e), way);
    if (e + 1 < edges) spins[e + 1] += sw_dot(sw_vec_across(f->spin_edge + 6, e + 1), way);
  }
  if (!b->roll_block) return;
  if (i > 0) spins[i - 1] -= sw_dot(sw_vec_across(f->spin_node, i), d);
  if (i < edges) spins[i] -= sw_dot(sw_vec_across(f->spin_node + 3, i), d);
}

/* Computes the right-hand sides of all nodes (nodes x 3) and spins (nodes) for a shift d of a
 * rail's node. */
static void load_shift(const sw_system *s, const sw_rail *r, sw_vec d, double *nodes,
                       double *spins) {
  const sw_held_node *h = sw_rail_node(s, r);
  const sw_body *b = &s->bodies[h->body];
  const size_t i = h->node - b->first_node;
  double *own = nodes + 3 * b->first_node;
  memset(nodes, 0, 4 * s->nodes * sizeof *nodes);
  for (int k = 0; k < 4; k++)
    if (is_free(b, i, BESIDE[k]))
      sw_store(own + 3 * ((long)i + BESIDE[k]), sw_neg(transposed_times(h->saved + 9 * k, d)));
  for (size_t k = 0; b->has_twist && k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    const double torque = b->field.twist_stiffness[k] * sw_dot(slope_of(b, span, i), d);
    for (size_t j = span->first; torque != 0 && j <= span->last + 1; j++)
      if (b->plan->held[j] == SW_FREE)
        sw_accumulate(own + 3 * j, sw_scale(sw_vec_at(b->twist_rank, j), -torque));
  }
  if (b->spin_block) add_spin_rights(b, i, d, spins + b->first_node);
  for (size_t k = 0; s->bridges && k < s->bridges->count; k++) {
    const sw_bridge *l = &s->bridges->list[k];
    if (l->i == h->node) sw_accumulate(nodes + 3 * l->j, sw_neg(transposed_times(l->k, d)));
    if (l->j == h->node) sw_accumulate(nodes + 3 * l->i, sw_neg(sw_rail_times(l->k, d)));
  }
}

static void solve_shift(sw_system *s, const sw_body *b, double *nodes, double *spins) {
  const size_t n = b->plan->nodes;
  double *own = nodes + 3 * b->first_node, *turn = spins + b->first_node;
  if (b->bridged && sw_bridges_any(s)) {
    sw_bridges_solve_shift(s, nodes, spins);
  } else if (b->spin_block) {
    double *d = s->rail_room + s->rail_count * (4 * s->nodes + s->rail_count + 1);
    for (size_t i = 0; i < n; i++)
      memcpy(d + 4 * i, own + 3 * i, 3 * sizeof *d), d[4 * i + 3] = turn[i];
    sw_band4_solve(b->spin_rows, n, d);
    for (size_t i = 0; i < n; i++)
      memcpy(own + 3 * i, d + 4 * i, 3 * sizeof *d), turn[i] = d[4 * i + 3];
  } else {
    sw_body_solve_again(b, own);
  }
}

/* Returns the change of the reaction of a rail's node from updates of nodes and spins and from its
 * own shift d. spins: every stride-th value from the body's first edge. */
static sw_vec reaction_of(const sw_system *s, const sw_rail *r, const double *nodes,
                          const double *spins, size_t stride, sw_vec d) {
  const sw_held_node *h = sw_rail_node(s, r);
  const sw_body *b = &s->bodies[h->body];
  const size_t i = h->node - b->first_node, edges = b->plan->edges;
  const double *own = nodes + 3 * b->first_node;
  sw_vec f = sw_rail_times(r->own, d);
  for (int k = 0; k < 4; k++)
    if (is_free(b, i, BESIDE[k]))
      f = sw_add(f, sw_rail_times(h->saved + 9 * k, sw_load(own + 3 * ((long)i + BESIDE[k]))));
  for (size_t k = 0; b->has_twist && k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    const sw_vec g = slope_of(b, span, i);
    if (sw_norm2(g) > 0)
      f = sw_madd(f, g, b->field.twist_stiffness[k] * (sw_twist_dot(b, span, own) + sw_dot(g, d)));
  }
  for (int side = 0; b->spin_block && side < 2; side++) {
    const size_t e = side ? i : i - 1;
    const double sign = side ? -1.0 : 1.0;
    if ((!side && i == 0) || e >= edges) continue;
    f = sw_madd(f, sw_vec_across(b->field.spin_edge, e), sign * spins[stride * e]);
    if (e > 0)
      f = sw_madd(f, sw_vec_across(b->field.spin_edge + 3, e), sign * spins[stride * (e - 1)]);
    if (e + 1 < edges)
      f = sw_madd(f, sw_vec_across(b->field.spin_edge + 6, e + 1), sign * spins[stride * (e + 1)]);
  }
  if (b->roll_block && i > 0)
    f = sw_madd(f, sw_vec_across(b->field.spin_node, i), spins[stride * (i - 1)]);
  if (b->roll_block && i < edges)
    f = sw_madd(f, sw_vec_across(b->field.spin_node + 3, i), spins[stride * i]);
  for (size_t k = 0; s->bridges && k < s->bridges->count; k++) {
    const sw_bridge *l = &s->bridges->list[k];
    if (l->i == h->node) f = sw_add(f, sw_rail_times(l->k, sw_load(nodes + 3 * l->j)));
    if (l->j == h->node) f = sw_add(f, transposed_times(l->k, sw_load(nodes + 3 * l->i)));
  }
  return f;
}

/* Returns the reaction after the system's update and the node's own shift d. */
static sw_vec reaction_now(const sw_system *s, const sw_rail *r, sw_vec d) {
  const sw_held_node *h = sw_rail_node(s, r);
  const sw_body *b = &s->bodies[h->body];
  const double *spins = b->spin_block ? b->spin_delta + 3 : NULL;
  return sw_add(h->own_force, reaction_of(s, r, s->delta, spins, 4, d));
}

/* --- the rails' own equations ----------------------------------------------------------- */

/* Returns the direction in which the reaction must vanish. For a moving node it includes friction:
 * the force across, in its present direction. */
static sw_vec test_of(const sw_rail *r) {
  const sw_vec n = sw_unit_or(sw_rail_across(r, r->before), sw_v(0, 0, 0));
  return sw_madd(r->along, n, r->way * r->friction);
}

/* Sets the step of a node that sticks or is at an end. Returns 1 for such a node. */
static int is_given(const sw_rail *r, const sw_stage *stage, size_t at, double *step) {
  const double to = r->state == SW_RAIL_STICKS    ? stage->xhat[at]
                    : r->state == SW_RAIL_AT_FROM ? r->from
                                                  : r->to;
  *step = to - stage->y[at];
  return r->state != SW_RAIL_GOES;
}

static double *shift_of(const sw_system *s, size_t k) { return s->rail_room + 4 * s->nodes * k; }

/* A shift of the node by 1 along the curve changes its reaction by f. In steps this contains the
 * wire's inertia. */
static double share_left(const sw_rail *r, sw_vec test, sw_vec f) {
  const double without = sw_dot(r->along, f);
  return r->friction > 0 && without > 0 ? sw_dot(test, f) / without : HUGE_VAL;
}

/* Sets up the rails' equations in A and b. Rails of other parts do not move. */
static void set_up(sw_system *s, const sw_stage *stage, double *A, double *b) {
  const size_t m = s->rail_count;
  memset(A, 0, (m * m + m) * sizeof *A);
  for (size_t k = 0; k < m; k++) {
    sw_rail *r = &s->rails[k];
    double *nodes = shift_of(s, k);
    A[m * k + k] = 1;
    if (!sw_rail_is_part(s, r)) continue;
    load_shift(s, r, r->along, nodes, nodes + 3 * s->nodes);
    solve_shift(s, &s->bodies[sw_rail_node(s, r)->body], nodes, nodes + 3 * s->nodes);
    r->before = reaction_now(s, r, sw_v(0, 0, 0));
  }
  for (size_t k = 0; k < m; k++) {
    sw_rail *r = &s->rails[k];
    r->left = HUGE_VAL;
    if (!sw_rail_is_part(s, r) || is_given(r, stage, sw_rail_freedom(s, k), &b[k])) continue;
    const sw_vec test = test_of(r);
    const size_t first = s->bodies[sw_rail_node(s, r)->body].first_node;
    for (size_t j = 0; j < m; j++) {
      const double *nodes = shift_of(s, j), *spins = nodes + 3 * s->nodes + first;
      if (!sw_rail_is_part(s, &s->rails[j])) continue; /* its column stays 0 */
      const sw_vec own = j == k ? r->along : sw_v(0, 0, 0);
      const sw_vec f = reaction_of(s, r, nodes, spins, 1, own);
      A[m * k + j] = sw_dot(test, f);
      if (j == k) r->left = share_left(r, test, f);
    }
    A[m * k + k] += sw_dot(r->bend, r->before);
    b[k] = -sw_dot(test, r->before);
  }
}

/* Adds the effect of rail k's step to all unknowns. */
static void carry(sw_system *s, size_t k) {
  const sw_rail *r = &s->rails[k];
  const double *nodes = shift_of(s, k), *spins = nodes + 3 * s->nodes;
  const size_t node = sw_rail_node(s, r)->node;
  for (size_t i = 0; i < 3 * s->nodes; i++) s->delta[i] += r->step * nodes[i];
  SW_PART_EACH(s, b) {
    const sw_body *body = &s->bodies[b];
    for (size_t i = 0; body->spin_block && i < body->plan->nodes; i++) {
      for (size_t c = 0; c < 3; c++)
        body->spin_delta[4 * i + c] += r->step * nodes[3 * (body->first_node + i) + c];
      body->spin_delta[4 * i + 3] += r->step * spins[body->first_node + i];
    }
  }
  sw_store(s->delta + 3 * node, sw_scale(r->along, r->step));
}

/* Computes the torques of spans from the update, including the rails' nodes. */
static void take_gains(sw_system *s) {
  if (sw_bridges_any(s)) sw_bridges_take_solution(s);
  SW_PART_EACH(s, b) {
    sw_body *body = &s->bodies[b];
    if (body->has_twist && !(body->bridged && sw_bridges_any(s)))
      sw_twist_gain(body, s->delta + 3 * body->first_node);
  }
  for (size_t k = 0; k < s->rail_count; k++) {
    const sw_held_node *h = sw_rail_node(s, &s->rails[k]);
    sw_body *b = &s->bodies[h->body];
    if (!sw_rail_is_part(s, &s->rails[k])) continue;
    for (size_t j = 0; b->has_twist && j < b->plan->span_count; j++)
      b->twist_gain[j] += b->field.twist_stiffness[j] *
                          sw_dot(slope_of(b, &b->plan->spans[j], h->node - b->first_node),
                                 sw_load(s->delta + 3 * h->node));
  }
}

/* The force along the curve exceeds the friction limit: the node starts to slide. */
static void let_go(sw_rail *r, double along) {
  r->state = SW_RAIL_GOES;
  r->way = along > 0 ? -1.0 : 1.0;
  r->open = 1;
}

/* After the update: checks if the node still stands, or still moves the same way. */
static void review(const sw_system *s, const sw_stage *stage, size_t k) {
  sw_rail *r = &s->rails[k];
  const size_t at = sw_rail_freedom(s, k);
  const double to = stage->y[at] + r->step, gone = to - stage->xhat[at];
  const sw_vec f = reaction_now(s, r, sw_scale(r->along, r->step));
  const double along = sw_dot(f, r->along), most = r->friction * sw_norm(sw_rail_across(r, f));
  const double near = most * (1.0 + KNOWN);
  r->open = 0;
  if (r->state == SW_RAIL_STICKS) {
    if (fabs(along) > near) let_go(r, along);
  } else if (r->state == SW_RAIL_AT_FROM) {
    if (along < -near) let_go(r, along);
  } else if (r->state == SW_RAIL_AT_TO) {
    if (along > near) let_go(r, along);
  } else if (to < r->from || to > r->to) {
    r->state = to < r->from ? SW_RAIL_AT_FROM : SW_RAIL_AT_TO;
    r->step = (to < r->from ? r->from : r->to) - stage->y[at], r->open = 1;
  } else if (r->friction > 0 && gone * r->way < 0) {
    r->state = SW_RAIL_STICKS;
    r->step = stage->xhat[at] - stage->y[at], r->open = 1;
  } else if (r->friction > 0) {
    r->open = fabs(along + r->way * most) > KNOWN * (most + fabs(along));
  }
}

void sw_rails_solve(sw_system *s, const sw_stage *stage, size_t *negative) {
  const size_t m = s->rail_count;
  double *A = s->rail_room + 4 * s->nodes * m, *step = A + m * m;
  if (!m) return;
  set_up(s, stage, A, step);
  *negative += sw_dense_eliminate(A, m, step, SW_DENSE_SWAPS);
  for (size_t k = 0; k < m; k++) {
    sw_rail *r = &s->rails[k];
    if (!sw_rail_is_part(s, r)) continue;
    const double most = LARGEST_TURN / sw_norm(r->bend);
    r->step = fabs(step[k]) > most ? copysign(most, step[k]) : step[k];
    carry(s, k);
  }
  take_gains(s);
  for (size_t k = 0; k < m; k++)
    if (sw_rail_is_part(s, &s->rails[k])) review(s, stage, k);
}
