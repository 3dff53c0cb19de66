/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small motions of a body about the state: stiffness K, consistent mass M, and factors of K - shift
 * M. Held nodes do not move. The product with K goes edge by edge. With the matrix's rows it would
 * add blocks that exceed the force of a smooth motion by up to the fourth power of the number of
 * segments, and their rounding would drown that force. */
#include "system/linear.h"

#include <math.h>
#include <string.h>

#include "base/simd.h"
#include "solve/band3.h"
#include "solve/band4.h"
#include "solve/blocks.h"
#include "system/assemble.h"
#include "system/bridge.h"
#include "system/join_twist.h"
#include "system/spin.h"
#include "system/system.h"
#include "system/twist.h"
#include "system/web.h"

sw_status sw_system_linearise(sw_system *s, double time, sw_error *err) {
  const sw_coupling *c = &s->coupling;
  SW_TRY(sw_system_place_holds(s, time, NULL, NULL, NULL, err));
  if (c->begin_stage) SW_TRY(c->begin_stage(c->user, s, time, 0, err));
  memset(s->velocity, 0, 3 * s->nodes * sizeof *s->velocity);
  sw_system_begin_step(s);
  sw_joins_twist(s, s->x);
  for (size_t b = 0; b < s->body_count; b++)
    SW_TRY(sw_body_evaluate(s, &s->bodies[b], time, HUGE_VAL, s->x, s->velocity, 1, 0, err));
  sw_bridges_begin(s);
  if (c->eval)
    SW_TRY(c->eval(c->user, s, time, HUGE_VAL, s->x, SW_WANT_FORCE | SW_WANT_STIFFNESS, err));
  SW_TRY(sw_joins_eval(s, s->x));
  for (size_t b = 0; b < s->body_count; b++) {
    const size_t at = 3 * s->bodies[b].first_node;
    sw_gather_residual(&s->bodies[b].field, 0.0, s->x + at, s->x + at, s->delta + at);
    if (s->bodies[b].has_twist) sw_twist_gather(&s->bodies[b]);
  }
  for (size_t i = 0; i < s->held_count; i++)
    sw_store(s->delta + 3 * s->held[i].node, sw_v(0, 0, 0));
  s->counters.evaluations++;
  return SW_OK;
}

/* --- sizes and layout --------------------------------------------------------- */

/* Unknowns of a node. */
static size_t width_of(const sw_body *b) { return b->spin_block ? 4 : 3; }

size_t sw_system_unknowns(const sw_system *s, size_t body) {
  return width_of(&s->bodies[body]) * s->bodies[body].plan->nodes;
}

size_t sw_system_free_unknowns(const sw_system *s, size_t body) {
  const sw_body *b = &s->bodies[body];
  size_t held = 0;
  for (size_t i = 0; i < s->held_count; i++) held += s->held[i].body == body;
  return 3 * (b->plan->nodes - held) + (b->spin_block ? sw_spin_free_turns(s, b) : 0);
}

/* A factor is the band's factor; with twist also the band's inverse times the spans' slopes (nodes
 * x 3), and each span's term of Sherman and Morrison. With frames it is the band of four, and work
 * space for a band of three. */
size_t sw_system_factor_size(const sw_system *s, size_t body) {
  const sw_body *b = &s->bodies[body];
  if (b->spin_block) return (SW_ROW4_SIZE + SW_ROW_SIZE) * b->plan->nodes;
  return SW_ROW_SIZE * b->plan->nodes +
         (b->has_twist ? 3 * b->plan->nodes + b->plan->span_count : 0);
}

void sw_system_residual(const sw_system *s, size_t body, double *out) {
  const sw_body *b = &s->bodies[body];
  const size_t w = width_of(b), n = b->plan->nodes;
  for (size_t i = 0; i < n; i++) {
    memcpy(out + w * i, s->delta + 3 * (b->first_node + i), 3 * sizeof *out);
    if (w > 3) out[w * i + 3] = i + 1 < n ? -b->field.spin[i] : 0.0;
  }
  if (b->spin_block) sw_spin_fix_held(s, b, out);
}

void sw_system_shifts(const sw_system *s, size_t body, const double *motion, double *out) {
  const size_t w = width_of(&s->bodies[body]);
  for (size_t i = 0; i < s->bodies[body].plan->nodes; i++)
    memcpy(out + 3 * i, motion + w * i, 3 * sizeof *out);
}

double sw_system_axial_error(const sw_system *s, size_t body, const double *motion) {
  const sw_body *b = &s->bodies[body];
  const sw_plan *p = b->plan;
  const double *T = s->tension + b->first_edge;
  const size_t w = width_of(b);
  const double weight = p->beam.mass * p->length * sw_norm(sw_load(s->gravity));
  double most = fmax(weight, p->beam.EI / (p->length * p->length)), error = 0;
  for (size_t e = 0; e < p->edges; e++) {
    double length = b->field.length[e];
    for (size_t k = 0; k < 3; k++)
      length += b->field.tangent[k][e] * (motion[w * (e + 1) + k] - motion[w * e + k]);
    const double strain = length / p->rest[e] - 1.0;
    most = fmax(most, fabs(T[e]));
    error = fmax(error, fabs((strain >= 0 ? b->EA : b->EA_push) * strain - T[e]));
  }
  return error > 0 ? error / most : error;
}

void sw_system_fix_held(const sw_system *s, size_t body, double *motion) {
  const sw_body *b = &s->bodies[body];
  for (size_t i = 0; i < s->held_count; i++)
    if (s->held[i].body == body)
      sw_store(motion + width_of(b) * (s->held[i].node - b->first_node), sw_v(0, 0, 0));
  if (b->spin_block) sw_spin_fix_held(s, b, motion);
}

/* --- factors ------------------------------------------------------------------ */

static void shifted_rows(const sw_system *s, size_t body, double shift, double *rows) {
  const sw_body *b = &s->bodies[body];
  memcpy(rows, b->field.rows, SW_ROW_SIZE * b->plan->nodes * sizeof *rows);
  sw_gather_rows(&b->field, -shift, rows);
  for (size_t i = 0; i < s->held_count; i++)
    if (s->held[i].body == body) sw_drop_row(rows, s->held[i].node - b->first_node);
}

/* A held node separates the spans in the matrix, so each has its own correction. */
static size_t factor_twist(const sw_system *s, size_t body, double *factor) {
  const sw_body *b = &s->bodies[body];
  double *solved = factor + SW_ROW_SIZE * b->plan->nodes, *self = solved + 3 * b->plan->nodes;
  size_t negative = 0;
  memcpy(solved, b->twist_rank, 3 * b->plan->nodes * sizeof *solved);
  sw_system_fix_held(s, body, solved);
  sw_band3_solve(factor, b->plan->nodes, solved);
  for (size_t k = 0; k < b->plan->span_count; k++) {
    self[k] = 1.0 + b->field.twist_stiffness[k] * sw_twist_dot(b, &b->plan->spans[k], solved);
    negative += self[k] < 0;
  }
  return negative;
}

sw_status sw_system_factor(const sw_system *s, size_t body, double shift, double *factor,
                           size_t *below) {
  const sw_body *b = &s->bodies[body];
  size_t negative = 0;
  if (b->spin_block) {
    double *rows = factor + SW_ROW4_SIZE * b->plan->nodes;
    shifted_rows(s, body, shift, rows);
    sw_spin_assemble(b, rows, factor);
    sw_spin_shift_rows(s, b, shift, factor);
    return sw_band4_factor(factor, b->plan->nodes, below);
  }
  shifted_rows(s, body, shift, factor);
  SW_TRY(sw_band3_factor(factor, b->plan->nodes, factor, &negative));
  if (b->has_twist) negative -= factor_twist(s, body, factor);
  if (below) *below = negative;
  return SW_OK;
}

void sw_system_factor_solve(const sw_system *s, size_t body, const double *factor, double *x) {
  const sw_body *b = &s->bodies[body];
  const double *solved = factor + SW_ROW_SIZE * b->plan->nodes;
  const double *self = solved + 3 * b->plan->nodes;
  if (b->spin_block) {
    sw_band4_solve(factor, b->plan->nodes, x);
    return;
  }
  sw_band3_solve(factor, b->plan->nodes, x);
  for (size_t k = 0; b->has_twist && k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    const double share = b->field.twist_stiffness[k] * sw_twist_dot(b, span, x) / self[k];
    for (size_t i = 3 * span->first; i < 3 * (span->last + 2); i++) x[i] -= share * solved[i];
  }
}

double sw_system_stiffest(const sw_system *s, size_t body, double *work) {
  static const int diagonal[3] = {0, 3, 5};
  const sw_plan *p = s->bodies[body].plan;
  double most = 0;
  shifted_rows(s, body, 0.0, work);
  for (size_t i = 0; i < p->nodes; i++)
    for (int k = 0; k < 3 && p->held[i] == SW_FREE; k++)
      most = fmax(most, fabs(work[SW_ROW_SIZE * i + (size_t)diagonal[k]]) / p->mass_own[i]);
  return most;
}

/* --- products ----------------------------------------------------------------- */

/* g = second derivatives with respect to edge e, times the edges of d */
static inline void edge_gradient(const sw_field *f, size_t e, const double *restrict d,
                                 double g[3]) {
  static const int whole[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  const double *at = d + 3 * e;
  for (int i = 0; i < 3; i++) {
    g[i] = 0;
    for (int j = 0; j < 3; j++) g[i] += f->own[whole[3 * i + j]][e] * (at[3 + j] - at[j]);
    for (int j = 0; e > 0 && j < 3; j++) g[i] += f->next[3 * j + i][e] * (at[j] - *(at + j - 3));
    for (int j = 0; e + 1 < f->plan->edges && j < 3; j++)
      g[i] += f->next[3 * i + j][e + 1] * (at[6 + j] - at[3 + j]);
  }
}

static void field_stiffness_times(const sw_field *f, const double *d, double *out) {
  sw_band3_multiply(f->rows, f->plan->nodes, d, out);
  for (size_t e = 0; e < f->plan->edges; e++) {
    double g[3];
    edge_gradient(f, e, d, g);
    for (size_t k = 0; k < 3; k++) {
      out[3 * e + k] -= g[k];
      out[3 * e + 3 + k] += g[k];
    }
  }
}

void sw_body_stiffness_times(sw_body *b, const double *d, double *out) {
  if (!b->plan->web) {
    field_stiffness_times(&b->field, d, out);
    return;
  }
  sw_web_gather(b);
  sw_blocks_multiply(b->blocks, d, out);
}

/* Copies the nodes' part of a motion (unknowns) to (nodes x 3), and back. */
static void take_nodes(size_t n, const double *motion, double *out) {
  for (size_t i = 0; i < n; i++) memcpy(out + 3 * i, motion + 4 * i, 3 * sizeof *out);
}

static void put_nodes(size_t n, const double *nodes, double *out) {
  for (size_t i = 0; i < n; i++) {
    memcpy(out + 4 * i, nodes + 3 * i, 3 * sizeof *out);
    out[4 * i + 3] = 0;
  }
}

/* The same with frames; uses the memory of the last update as work space. */
static void framed_stiffness_times(const sw_body *b, const double *motion, double *out) {
  const size_t n = b->plan->nodes;
  double *nodes = b->spin_delta, *pushes = b->spin_rows;
  take_nodes(n, motion, nodes);
  field_stiffness_times(&b->field, nodes, pushes);
  put_nodes(n, pushes, out);
  sw_spin_stiffness_times(b, motion, out);
}

void sw_system_stiffness_times(const sw_system *s, size_t body, const double *motion, double *out) {
  const sw_body *b = &s->bodies[body];
  if (b->spin_block)
    framed_stiffness_times(b, motion, out);
  else
    field_stiffness_times(&b->field, motion, out);
  for (size_t k = 0; b->has_twist && k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    const double torque = b->field.twist_stiffness[k] * sw_twist_dot(b, span, motion);
    for (size_t i = 3 * span->first; i < 3 * (span->last + 2); i++)
      out[i] += torque * b->twist_rank[i];
  }
  sw_system_fix_held(s, body, out);
}

SW_HOT
static void mass_times(size_t n, size_t w, const double *restrict own, const double *restrict next,
                       const double *restrict x, double *restrict y) {
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < 3; k++) y[w * i + k] = own[i] * x[w * i + k];
  for (size_t i = 0; i + 1 < n; i++)
    for (size_t k = 0; k < 3; k++) {
      y[w * i + k] += next[i] * x[w * (i + 1) + k];
      y[w * (i + 1) + k] += next[i] * x[w * i + k];
    }
}

void sw_system_mass_times(const sw_system *s, size_t body, const double *motion, double *out) {
  const sw_body *b = &s->bodies[body];
  const sw_plan *p = b->plan;
  mass_times(p->nodes, width_of(b), p->mass_own, p->mass_next, motion, out);
  if (b->spin_block) sw_spin_mass_times(b, motion, out);
  sw_system_fix_held(s, body, out);
}
