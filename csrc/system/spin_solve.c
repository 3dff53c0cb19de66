/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The equations of a body with frames: each node has four unknowns, its place and the turn of the
 * edge from there. */
#include <math.h>

#include "base/simd.h"
#include "solve/band3.h"
#include "solve/band4.h"
#include "system/roll.h"
#include "system/spin.h"

/* Stiffness against spin of an edge that turns freely, over the edge's own torsional stiffness [-].
 * It is only in the matrix, so equilibria stay exact. */
static const double LEAST_STIFFNESS = 1e-9;

/* Widens a row of three to one of four. */
static inline void widen(const double *restrict from, double last, double *restrict out) {
  out[0] = from[0], out[1] = from[1], out[2] = from[2], out[3] = last;
}

/* Writes the couplings of nodes to spins: node i (component k) with spins i and i + 1; nodes i + 1
 * and i + 2 with spin i. An edge's own spin and those of its neighbours act on both its ends. */
static inline void couple(const sw_body *b, size_t i, double *restrict row) {
  double *const *c = b->field.spin_edge;
  const int *held = b->plan->held;
  const size_t n = b->plan->nodes, last = n - 1;
  const double here = held[i] == SW_FREE, next = i < last && held[i + 1] == SW_FREE;
  const double after = i + 1 < last && held[i + 2] == SW_FREE;
  for (int k = 0; k < 3; k++) {
    const double own = c[k][i], back = c[3 + k][i + 1], ahead = c[6 + k][i + 1];
    const double mine = here * (c[6 + k][i] - own);
    row[4 * k + 3] = row[12 + k] = mine;
    row[SW_ROW4_NEXT + 4 * k + 3] = -here * ahead;
    row[SW_ROW4_NEXT + 12 + k] = next * (own - back);
    row[SW_ROW4_SECOND + 12 + k] = after * back;
  }
}

/* Adds the couplings of node i to the spins of both its edges. */
static inline void add_node_couplings(const sw_body *b, size_t i, double *rows) {
  double *row = rows + SW_ROW4_SIZE * i, *const *c = b->field.spin_node;
  if (b->plan->held[i] != SW_FREE) return;
  for (int k = 0; k < 3; k++) {
    if (i > 0) (row - SW_ROW4_SIZE)[SW_ROW4_NEXT + 12 + k] += c[k][i];
    row[4 * k + 3] += c[3 + k][i], row[12 + k] += c[3 + k][i];
  }
}

SW_HOT
void sw_spin_assemble(const sw_body *b, const double *rows, double *out) {
  const sw_field *f = &b->field;
  const sw_plan *p = b->plan;
  for (size_t i = 0; i < p->nodes; i++) {
    const double *from = rows + SW_ROW_SIZE * i, *next = from + SW_ROW_NEXT;
    const double *second = from + SW_ROW_SECOND;
    const double own[9] = {from[0], from[1], from[2], from[1], from[3],
                           from[4], from[2], from[4], from[5]};
    double *row = out + SW_ROW4_SIZE * i;
    for (int k = 0; k < 3; k++) {
      widen(own + 3 * k, 0, row + 4 * k);
      widen(next + 3 * k, 0, row + SW_ROW4_NEXT + 4 * k);
      widen(second + 3 * k, 0, row + SW_ROW4_SECOND + 4 * k);
    }
    couple(b, i, row);
    row[15] = i < p->edges ? f->spin_own[i] + LEAST_STIFFNESS * p->beam.GJ / p->rest[i] : 1.0;
    row[SW_ROW4_NEXT + 15] = i + 1 < p->edges ? f->spin_next[i + 1] : 0.0;
    row[SW_ROW4_SECOND + 15] = 0;
  }
  if (b->roll_block)
    for (size_t i = 0; i < p->nodes; i++) add_node_couplings(b, i, out);
}

void sw_spin_load(const sw_system *s, sw_body *b, const double *delta) {
  const size_t n = b->plan->nodes;
  double *d = b->spin_delta;
  sw_spin_assemble(b, b->field.rows, b->spin_rows);
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < 3; k++) d[4 * i + k] = delta[3 * i + k];
    d[4 * i + 3] = i + 1 < n ? -b->field.spin[i] : 0.0;
  }
  sw_roll_load(s, b, d);
  for (size_t e = 0; b->spin_inertia > 0 && !b->roll_block && e + 1 < n; e++) {
    const double inertia = b->spin_inertia * b->plan->rest[e];
    b->spin_rows[SW_ROW4_SIZE * e + 15] += inertia;
    d[4 * e + 3] -= inertia * sw_spin_turned(s, b, e);
  }
}

sw_status sw_spin_solve(const sw_system *s, sw_body *b, double *delta, size_t *negative) {
  const size_t n = b->plan->nodes;
  double *d = b->spin_delta;
  sw_spin_load(s, b, delta);
  SW_TRY(sw_band4_factor(b->spin_rows, n, negative));
  sw_band4_solve(b->spin_rows, n, d);
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < 3; k++) delta[3 * i + k] = d[4 * i + k];
  return SW_OK;
}

/* Returns the square of the largest turn, or a NaN if any turn is not finite. */
SW_HOT
static double largest_turn2(size_t m, const double *restrict delta) {
  double most = 0, any = 0;
  for (size_t e = 0; e < m; e++) {
    const double turn2 = delta[4 * e + 3] * delta[4 * e + 3];
    most = most > turn2 ? most : turn2;
    any += 0.0 * turn2;
  }
  return most + any;
}

double sw_spin_largest(const sw_body *b) {
  return sqrt(largest_turn2(b->plan->edges, b->spin_delta));
}

/* Returns the change of edge e's gradient by the spins of the last solve. */
static sw_vec spin_push(const sw_body *b, size_t e) {
  const sw_field *f = &b->field;
  const double *d = b->spin_delta + 4 * e;
  sw_vec sum = sw_scale(sw_vec_across(f->spin_edge, e), d[3]);
  if (e > 0) sum = sw_madd(sum, sw_vec_across(f->spin_edge + 3, e), *(d - 1));
  if (e + 1 < b->plan->edges) sum = sw_madd(sum, sw_vec_across(f->spin_edge + 6, e + 1), d[7]);
  return sum;
}

void sw_spin_react(sw_held_node *h, const sw_body *b) {
  const size_t i = h->node - b->first_node;
  if (i > 0) h->reaction = sw_add(h->reaction, spin_push(b, i - 1));
  if (i < b->plan->edges) h->reaction = sw_sub(h->reaction, spin_push(b, i));
  if (!b->roll_block) return;
  const double *d = b->spin_delta + 4 * i;
  if (i > 0) h->reaction = sw_madd(h->reaction, sw_vec_across(b->field.spin_node, i), *(d - 1));
  h->reaction = sw_madd(h->reaction, sw_vec_across(b->field.spin_node + 3, i), d[3]);
}
