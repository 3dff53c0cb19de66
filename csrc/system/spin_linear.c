/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small motions of bodies with frames. Turns have inertia in wires that roll; in others they have
 * no mass and follow the nodes. */
#include "solve/band4.h"
#include "system/spin.h"

/* Called for each edge inside a hold; such an edge does not turn by itself. */
typedef void (*visit)(double *turns, size_t edge);

static void each_held(const sw_system *s, const sw_body *b, visit what, double *turns) {
  for (size_t i = 0; i < s->held_count; i++) {
    const long e = sw_spin_held_edge(s, b, i);
    if (e >= 0) what(turns, (size_t)e);
  }
}

static void count(double *turns, size_t edge SW_UNUSED) { *turns += 1; }
static void stop(double *turns, size_t edge) { turns[4 * edge] = 0; }
static void fix(double *turns, size_t edge) { turns[SW_ROW4_SIZE * edge] = 1; }

size_t sw_spin_free_turns(const sw_system *s, const sw_body *b) {
  double held = 0;
  each_held(s, b, count, &held);
  return b->roll_block ? b->plan->edges - (size_t)held : 0;
}

void sw_spin_fix_held(const sw_system *s, const sw_body *b, double *motion) {
  each_held(s, b, stop, motion + 3);
  motion[4 * b->plan->edges + 3] = 0; /* no edge starts at the last node */
}

/* out += c times turn, with c from three arrays at an index. */
static void add_product(double *const *c, size_t at, double turn, double *out) {
  for (int k = 0; k < 3; k++) out[k] += c[k][at] * turn;
}

static double product(double *const *c, size_t at, const double *v) {
  return c[0][at] * v[0] + c[1][at] * v[1] + c[2][at] * v[2];
}

/* The part of edge e: its own spin and its neighbours' spins. */
static void edge_part(const sw_body *b, size_t e, const double *d, double *out) {
  double *const *c = b->field.spin_edge;
  const double *at = d + 4 * e;
  const double stretch[3] = {at[4] - at[0], at[5] - at[1], at[6] - at[2]};
  const int after = e + 1 < b->plan->edges;
  double g[3] = {0, 0, 0};
  add_product(c, e, at[3], g);
  out[4 * e + 3] += product(c, e, stretch);
  if (e > 0) {
    add_product(c + 3, e, *(at - 1), g);
    out[4 * e - 1] += product(c + 3, e, stretch);
  }
  if (after) {
    add_product(c + 6, e + 1, at[7], g);
    out[4 * e + 7] += product(c + 6, e + 1, stretch);
  }
  for (size_t k = 0; k < 3; k++) out[4 * e + k] -= g[k], out[4 * e + 4 + k] += g[k];
}

/* The part of node i with the spins of both its edges: friction. */
static void node_part(const sw_body *b, size_t i, const double *d, double *out) {
  double *const *c = b->field.spin_node;
  const double *at = d + 4 * i;
  add_product(c + 3, i, at[3], out + 4 * i);
  out[4 * i + 3] += product(c + 3, i, at);
  if (i == 0) return;
  add_product(c, i, *(at - 1), out + 4 * i);
  out[4 * i - 1] += product(c, i, at);
}

void sw_spin_stiffness_times(const sw_body *b, const double *d, double *out) {
  const sw_field *f = &b->field;
  for (size_t e = 0; e < b->plan->edges; e++) {
    out[4 * e + 3] += f->spin_own[e] * d[4 * e + 3];
    if (e > 0) {
      out[4 * e + 3] += f->spin_next[e] * d[4 * e - 1];
      out[4 * e - 1] += f->spin_next[e] * d[4 * e + 3];
    }
    edge_part(b, e, d, out);
  }
  for (size_t i = 0; b->roll_block && i < b->plan->nodes; i++) node_part(b, i, d, out);
}

void sw_spin_mass_times(const sw_body *b, const double *d, double *out) {
  const double inertia = b->roll_block ? b->plan->beam.spin_inertia : 0.0;
  for (size_t e = 0; e < b->plan->edges; e++)
    out[4 * e + 3] = inertia * b->plan->rest[e] * d[4 * e + 3];
  out[4 * b->plan->edges + 3] = 0;
}

void sw_spin_shift_rows(const sw_system *s, const sw_body *b, double shift, double *rows) {
  const double inertia = b->roll_block ? b->plan->beam.spin_inertia : 0.0;
  for (size_t e = 0; e < b->plan->edges; e++)
    rows[SW_ROW4_SIZE * e + 15] -= shift * inertia * b->plan->rest[e];
  each_held(s, b, fix, rows + 15);
}
