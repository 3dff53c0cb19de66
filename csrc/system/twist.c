/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Advances the twist of spans from step to step. From tangents (a0, b0) to (a, b) the twist of a
 * hinge changes by minus the area of the spherical triangles (a0, a, b) and (a0, b, b0). This is
 * exact for any step, and has no branch cuts while a step turns nothing by pi. Summed over a span
 * it is Fuller's writhe formula, so many turns add up without error. */
#include "system/twist.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/simd.h"
#include "solve/band3.h"
#include "system/join.h"

sw_status sw_system_enable_twist(sw_system *s, size_t body) {
  sw_body *b = &s->bodies[body];
  const size_t n = b->plan->nodes, spans = b->plan->span_count;
  if (!spans || b->has_twist) return SW_OK;
  double *p = sw_alloc(9 * n + 3 * spans, sizeof *p);
  if (!p) return SW_ENOMEM;
  b->twist_block = p;
  b->twist_rank = p;
  b->twist_solved = p + 3 * n;
  for (size_t k = 0; k < 3; k++) b->field.twist_slope[k] = p + (6 + k) * n;
  b->twist_now = p + 9 * n;
  b->twist_gain = b->twist_now + spans;
  b->field.twist_stiffness = b->twist_gain + spans;
  b->has_twist = 1;
  return SW_OK;
}

/* Returns the signed area of the spherical triangle a, b, c [rad]. */
static double triangle(sw_vec a, sw_vec b, sw_vec c) {
  return 2.0 * atan2(sw_dot(a, sw_cross(b, c)), 1.0 + sw_dot(a, b) + sw_dot(b, c) + sw_dot(c, a));
}

double sw_hinge_change(sw_vec a0, sw_vec b0, sw_vec a, sw_vec b) {
  return -(triangle(a0, a, b) + triangle(a0, b, b0));
}

/* Returns the angle of a turn about its director, beyond carrying the director along. */
static double own_turn(sw_quat before, sw_quat now, sw_vec local) {
  const sw_vec d0 = sw_rotate(before, local), d = sw_rotate(now, local);
  const sw_vec local_side = sw_perpendicular(sw_unit_or(local, sw_v(1, 0, 0)));
  const sw_vec u0 = sw_rotate(before, local_side), u = sw_rotate(now, local_side);
  const sw_vec axis = sw_cross(d0, d);
  const double dot = sw_dot(d0, d);
  /* u0 carried from d0 to d along the great circle */
  const sw_vec carried = sw_add(sw_add(sw_scale(u0, dot), sw_cross(axis, u0)),
                                sw_scale(axis, sw_dot(axis, u0) / fmax(1e-12, 1.0 + dot)));
  return atan2(sw_dot(sw_cross(carried, u), d), sw_dot(carried, u));
}

static sw_quat turn_of(const sw_system *s, int hold) {
  const double *q = s->turn + 4 * hold;
  return (sw_quat){q[0], q[1], q[2], q[3]};
}

sw_clamp_change sw_clamp_change_of(const sw_system *s, const sw_clamp_hinge *h) {
  if ((size_t)h->hold >= s->hold_count) {
    const sw_join_hub *hub;
    const struct sw_join_arm *arm = sw_join_arm_at(s, h, &hub);
    const double turn = hub->line ? 0.0 : own_turn(hub->before, hub->now, arm->rest);
    return (sw_clamp_change){arm->before, arm->now, turn};
  }
  const size_t at = 3 * (2 * (size_t)h->hold + (h->side > 0 ? 1 : 0));
  const sw_vec local = sw_load(s->directors + at);
  const sw_quat before = turn_of(s, h->hold);
  sw_clamp_change c = {.before = sw_rotate(before, local), .now = sw_load(s->directors_now + at)};
  c.turn = own_turn(before, s->hold_states[h->hold].pose.q, local);
  return c;
}

SW_HOT
void sw_edge_directions(size_t first, size_t last, const double *restrict x, double *restrict tx,
                        double *restrict ty, double *restrict tz) {
  for (size_t e = first; e <= last; e++) {
    const double dx = x[3 * e + 3] - x[3 * e], dy = x[3 * e + 4] - x[3 * e + 1];
    const double dz = x[3 * e + 5] - x[3 * e + 2];
    const double r = 1.0 / sqrt(dx * dx + dy * dy + dz * dz + DBL_MIN);
    tx[e] = dx * r, ty[e] = dy * r, tz[e] = dz * r;
  }
}

/* Computes the areas of (a0, a, b) and (a0, b, b0) at hinges first + 1 .. last: tan of half of
 * each, then 2 atan by its series, whose error is below 1e-16 for |tan| < SMALL. Returns the number
 * of hinges with larger turns. */
static const double SMALL = 0.03;

SW_HOT
static long small_areas(size_t first, size_t last, const double *restrict ox,
                        const double *restrict oy, const double *restrict oz,
                        const double *restrict nx, const double *restrict ny,
                        const double *restrict nz, double *restrict area) {
  long large = 0;
  for (size_t i = first + 1; i <= last; i++) {
    const double ax = nx[i - 1], ay = ny[i - 1], az = nz[i - 1], bx = nx[i], by = ny[i], bz = nz[i];
    const double px = ox[i - 1], py = oy[i - 1], pz = oz[i - 1], qx = ox[i], qy = oy[i], qz = oz[i];
    const double pb = px * bx + py * by + pz * bz; /* a0 . b */
    const double pa = px * ax + py * ay + pz * az, ab = ax * bx + ay * by + az * bz;
    const double pq = px * qx + py * qy + pz * qz, bq = bx * qx + by * qy + bz * qz;
    /* a0 . (a x b) and a0 . (b x b0) = (a0 x b) . b0 */
    const double one =
        px * (ay * bz - az * by) + py * (az * bx - ax * bz) + pz * (ax * by - ay * bx);
    const double two =
        px * (by * qz - bz * qy) + py * (bz * qx - bx * qz) + pz * (bx * qy - by * qx);
    const double d1 = 1.0 + pa + ab + pb, d2 = 1.0 + pb + bq + pq;
    const double z1 = one / d1, z2 = two / d2, s1 = z1 * z1, s2 = z2 * z2;
    large += !((s1 < SMALL * SMALL) & (s2 < SMALL * SMALL) & (d1 > 0) & (d2 > 0));
    const double f1 = 1.0 - s1 * (1.0 / 3 - s1 * (1.0 / 5 - s1 * (1.0 / 7 - s1 * (1.0 / 9))));
    const double f2 = 1.0 - s2 * (1.0 / 3 - s2 * (1.0 / 5 - s2 * (1.0 / 7 - s2 * (1.0 / 9))));
    area[i] = 2.0 * (z1 * f1 + z2 * f2);
  }
  return large;
}

/* Returns the change of a span's twist from the state to positions x (of the body). Work space:
 * twist_rank and twist_solved; sw_twist_gather fills them anew. */
static double span_change(const sw_system *s, const sw_body *b, const sw_span *span,
                          const double *x) {
  const size_t n = b->plan->nodes, first = span->first, last = span->last;
  double *const w = b->twist_rank, *const v = b->twist_solved, *const area = b->field.scratch[3];
  double *const old[3] = {w, w + n, w + 2 * n}, *const now[3] = {v, v + n, v + 2 * n};
  sw_edge_directions(first, last, s->x + 3 * b->first_node, old[0], old[1], old[2]);
  sw_edge_directions(first, last, x, now[0], now[1], now[2]);
  const long large = small_areas(first, last, old[0], old[1], old[2], now[0], now[1], now[2], area);
  const sw_clamp_change left = sw_clamp_change_of(s, &b->plan->clamps[span->left]);
  const sw_clamp_change right = sw_clamp_change_of(s, &b->plan->clamps[span->right]);
  double sum = right.turn - left.turn;
  sum +=
      sw_hinge_change(left.before, sw_vec_across(old, first), left.now, sw_vec_across(now, first));
  for (size_t i = first + 1; i <= last; i++)
    sum += large ? sw_hinge_change(sw_vec_across(old, i - 1), sw_vec_across(old, i),
                                   sw_vec_across(now, i - 1), sw_vec_across(now, i))
                 : -area[i];
  return sum + sw_hinge_change(sw_vec_across(old, last), right.before, sw_vec_across(now, last),
                               right.now);
}

double sw_twist_change(const sw_system *s, const sw_body *b, size_t span, const double *x) {
  return span_change(s, b, &b->plan->spans[span], x + 3 * b->first_node);
}

double sw_system_twist_change(const sw_system *s, const sw_body *b, size_t span, const double *x) {
  return sw_twist_change(s, b, span, x);
}

void sw_twist_measure(sw_system *s, sw_body *b) {
  for (size_t k = 0; k < b->plan->span_count; k++) {
    b->field.twist_stiffness[k] = 0;
    if (b->plan->stops) continue; /* see sw_joins_twist */
    b->twist_now[k] =
        s->twist[b->first_span + k] + span_change(s, b, &b->plan->spans[k], b->field.x);
  }
  b->field.twist = b->twist_now;
}

void sw_twist_gather(sw_body *b) {
  const size_t n = b->plan->nodes;
  double *const *slope = b->field.twist_slope;
  memset(b->twist_rank, 0, 3 * n * sizeof(double));
  for (size_t k = 0; k < b->plan->span_count; k++)
    for (size_t e = b->plan->spans[k].first; e <= b->plan->spans[k].last; e++)
      for (size_t c = 0; c < 3; c++) {
        b->twist_rank[3 * e + c] -= slope[c][e];
        b->twist_rank[3 * e + 3 + c] += slope[c][e];
      }
  memcpy(b->twist_solved, b->twist_rank, 3 * n * sizeof(double));
  for (size_t i = 0; i < n; i++)
    if (b->plan->held[i] != SW_FREE) sw_store(b->twist_solved + 3 * i, sw_v(0, 0, 0));
}

double sw_twist_dot(const sw_body *b, const sw_span *span, const double *x) {
  double sum = 0;
  for (size_t i = span->first; i <= span->last + 1; i++) {
    if (b->plan->held[i] != SW_FREE) continue;
    sum += sw_dot(sw_vec_at(b->twist_rank, i), sw_vec_at(x, i));
  }
  return sum;
}

/* A clamp holds the node between two spans, so spans are separate in the matrix. One solve serves
 * all, and each has its correction by Sherman and Morrison's formula. */
size_t sw_twist_correct(sw_body *b, double *delta) {
  sw_twist_gather(b);
  sw_band3_solve(b->field.rows, b->plan->nodes, b->twist_solved);
  const size_t fewer = sw_twist_correct_again(b, delta);
  sw_twist_gain(b, delta);
  return fewer;
}

size_t sw_twist_correct_again(const sw_body *b, double *more) {
  size_t fewer = 0;
  for (size_t k = 0; k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    const double stiffness = b->field.twist_stiffness[k];
    const double self = 1.0 + stiffness * sw_twist_dot(b, span, b->twist_solved);
    const double share = stiffness * sw_twist_dot(b, span, more) / self;
    fewer += self < 0;
    for (size_t i = 3 * span->first; i < 3 * (span->last + 2); i++)
      more[i] -= share * b->twist_solved[i];
  }
  return fewer;
}

void sw_twist_gain(sw_body *b, const double *delta) {
  for (size_t k = 0; k < b->plan->span_count; k++)
    b->twist_gain[k] = b->field.twist_stiffness[k] * sw_twist_dot(b, &b->plan->spans[k], delta);
}

static sw_vec slope_at(const sw_body *b, size_t e) {
  return sw_vec_across(b->field.twist_slope, e);
}

void sw_twist_react(sw_held_node *h, const sw_body *b) {
  const size_t i = h->node - b->first_node;
  for (size_t k = 0; k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    if (i < span->first || i > span->last + 1) continue;
    sw_vec slope = sw_v(0, 0, 0); /* of this span alone */
    if (i > span->first) slope = sw_add(slope, slope_at(b, i - 1));
    if (i <= span->last) slope = sw_sub(slope, slope_at(b, i));
    h->reaction = sw_madd(h->reaction, slope, b->twist_gain[k]);
  }
}
