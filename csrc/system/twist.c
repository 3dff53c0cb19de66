/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Following the twist of spans. The twist of a hinge changes, from tangents
 * (a0, b0) to (a, b), by minus the area of the two spherical triangles
 * (a0, a, b) and (a0, b, b0): exact for any step and free of branch cuts while
 * one step turns nothing by pi. Summed over a span that is Fuller's writhe
 * formula, so many turns add up without error. */
#include "system/twist.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "solve/band3.h"
#include "system/spin.h"

sw_status sw_system_enable_twist(sw_system *s, size_t body) {
  sw_body *b = &s->bodies[body];
  const size_t n = b->plan->nodes, spans = b->plan->span_count;
  if (!spans || b->has_twist) return SW_OK;
  double *p = sw_alloc(9 * n + 3 * spans, sizeof *p);
  if (!p) return SW_ENOMEM;
  b->twist_block = p;
  b->twist_rank = p;
  b->twist_solved = p + 3 * n;
  b->field.twist_slope = p + 6 * n;
  b->twist_now = p + 9 * n;
  b->twist_gain = b->twist_now + spans;
  b->field.twist_stiffness = b->twist_gain + spans;
  b->has_twist = 1;
  return SW_OK;
}

/* Signed area of the spherical triangle a, b, c [rad]. */
static double triangle(sw_vec a, sw_vec b, sw_vec c) {
  return 2.0 * atan2(sw_dot(a, sw_cross(b, c)), 1.0 + sw_dot(a, b) + sw_dot(b, c) + sw_dot(c, a));
}

static double hinge_change(sw_vec a0, sw_vec b0, sw_vec a, sw_vec b) {
  return -(triangle(a0, a, b) + triangle(a0, b, b0));
}

/* Angle by which a hold turned about its director, beyond carrying it along. */
static double own_turn(sw_quat before, sw_quat now, sw_vec local) {
  const sw_vec d0 = sw_rotate(before, local), d = sw_rotate(now, local);
  const sw_vec local_side = sw_perpendicular(sw_unit_or(local, sw_v(1, 0, 0)));
  const sw_vec u0 = sw_rotate(before, local_side), u = sw_rotate(now, local_side);
  const sw_vec axis = sw_cross(d0, d);
  const double dot = sw_dot(d0, d);
  /* u0 carried from d0 to d along the great circle */
  const sw_vec carried =
      sw_add(sw_add(sw_scale(u0, dot), sw_cross(axis, u0)),
             sw_scale(axis, sw_dot(axis, u0) / fmax(1e-12, 1.0 + dot)));
  return atan2(sw_dot(sw_cross(carried, u), d), sw_dot(carried, u));
}

static sw_quat turn_of(const sw_system *s, int hold) {
  const double *q = s->turn + 4 * hold;
  return (sw_quat){q[0], q[1], q[2], q[3]};
}

/* A clamp's director before and now, and its own turn in between. */
typedef struct clamp_change {
  sw_vec before, now;
  double turn;
} clamp_change;

static clamp_change change_of(const sw_system *s, const sw_clamp_hinge *h) {
  const size_t at = 3 * (2 * (size_t)h->hold + (h->side > 0 ? 1 : 0));
  const sw_vec local = sw_load(s->directors + at);
  const sw_quat before = turn_of(s, h->hold);
  clamp_change c = {.before = sw_rotate(before, local), .now = sw_load(s->directors_now + at)};
  c.turn = own_turn(before, s->hold_states[h->hold].pose.q, local);
  return c;
}

static sw_vec edge_direction(const double *x, size_t e) {
  return sw_unit_or(sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e)), sw_v(1, 0, 0));
}

/* Change of a span's twist from the state to positions x (of the body). */
static double span_change(const sw_system *s, const sw_body *b, const sw_span *span,
                          const double *x) {
  const double *x0 = s->x + 3 * b->first_node;
  const clamp_change left = change_of(s, &b->plan->clamps[span->left]);
  const clamp_change right = change_of(s, &b->plan->clamps[span->right]);
  double sum = right.turn - left.turn;
  sw_vec a0 = left.before, a = left.now;
  for (size_t e = span->first; e <= span->last; e++) {
    const sw_vec b0 = edge_direction(x0, e), t = edge_direction(x, e);
    sum += hinge_change(a0, b0, a, t);
    a0 = b0, a = t;
  }
  return sum + hinge_change(a0, right.before, a, right.now);
}

void sw_twist_measure(sw_system *s, sw_body *b) {
  for (size_t k = 0; k < b->plan->span_count; k++) {
    b->twist_now[k] =
        s->twist[b->first_span + k] + span_change(s, b, &b->plan->spans[k], b->field.x);
    b->field.twist_stiffness[k] = 0;
  }
  b->field.twist = b->twist_now;
}

void sw_twist_gather(sw_body *b) {
  const size_t n = b->plan->nodes;
  const double *slope = b->field.twist_slope;
  memset(b->twist_rank, 0, 3 * n * sizeof(double));
  for (size_t k = 0; k < b->plan->span_count; k++)
    for (size_t e = b->plan->spans[k].first; e <= b->plan->spans[k].last; e++)
      for (size_t c = 0; c < 3; c++) {
        b->twist_rank[3 * e + c] -= slope[3 * e + c];
        b->twist_rank[3 * e + 3 + c] += slope[3 * e + c];
      }
  memcpy(b->twist_solved, b->twist_rank, 3 * n * sizeof(double));
  for (size_t i = 0; i < n; i++)
    if (b->plan->held[i] != SW_FREE)
      sw_store(b->twist_solved + 3 * i, sw_v(0, 0, 0));
}

double sw_twist_dot(const sw_body *b, const sw_span *span, const double *x) {
  double sum = 0;
  for (size_t i = span->first; i <= span->last + 1; i++) {
    if (b->plan->held[i] != SW_FREE) continue;
    sum += sw_dot(sw_vec_at(b->twist_rank, i), sw_vec_at(x, i));
  }
  return sum;
}

/* The spans are apart in the matrix (a clamp holds the node between them), so
 * one solve serves all, and Sherman and Morrison's formula each. */
size_t sw_twist_correct(sw_body *b, double *delta) {
  size_t fewer = 0;
  sw_twist_gather(b);
  sw_band3_solve(b->field.rows, b->plan->nodes, b->twist_solved);
  for (size_t k = 0; k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    const double stiffness = b->field.twist_stiffness[k];
    const double self = 1.0 + stiffness * sw_twist_dot(b, span, b->twist_solved);
    const double share = stiffness * sw_twist_dot(b, span, delta) / self;
    fewer += self < 0;
    for (size_t i = 3 * span->first; i < 3 * (span->last + 2); i++)
      delta[i] -= share * b->twist_solved[i];
    b->twist_gain[k] = stiffness * sw_twist_dot(b, span, delta);
  }
  return fewer;
}

void sw_twist_react(sw_held_node *h, const sw_body *b) {
  const size_t i = h->node - b->first_node;
  for (size_t k = 0; k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    if (i < span->first || i > span->last + 1) continue;
    sw_vec slope = sw_v(0, 0, 0); /* of this span alone */
    if (i > span->first) slope = sw_add(slope, sw_vec_at(b->field.twist_slope, i - 1));
    if (i <= span->last) slope = sw_sub(slope, sw_vec_at(b->field.twist_slope, i));
    h->reaction = sw_madd(h->reaction, slope, b->twist_gain[k]);
  }
}

void sw_system_take_turns(sw_system *s) {
  for (size_t k = 0; k < s->hold_count; k++) {
    const sw_quat q = s->hold_states[k].pose.q;
    double *out = s->turn + 4 * k;
    out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
  }
}

void sw_system_follow(sw_system *s, const double *x) {
  for (size_t b = 0; b < s->body_count; b++) {
    sw_body *body = &s->bodies[b];
    if (body->spin_block) sw_spin_follow(s, body, x + 3 * body->first_node);
    for (size_t k = 0; body->has_twist && k < body->plan->span_count; k++)
      s->twist[body->first_span + k] +=
          span_change(s, body, &body->plan->spans[k], x + 3 * body->first_node);
  }
  sw_system_take_turns(s);
}
