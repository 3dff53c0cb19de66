/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gauss-Newton iteration for the turns of a chain's links. The rotation vectors of links have a
 * tridiagonal matrix, the same for all three components. Fixed places are constraints; their
 * multipliers are found first. */
#include "body/chain.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "solve/dense.h"

enum { MOST_ITERATIONS = 20 };
static const double FOUND = 1e-11, NEARLY = 1e-7; /* largest rotation of a last iteration [rad] */
static const double FARTHEST = 0.6; /* a link that turned more is where another shape is [rad] */
/* Keeps chains solvable whose links are free on both sides, over the chain's mean joint [-]. */
static const double STEADY = 1e-9;

typedef struct chain {
  sw_chain_link *link;
  size_t n;
  double give;
  size_t sections;      /* stretches between fixed places in which a link can turn */
  size_t *first, *last; /* (sections) links */
  double *diagonal, *next;
  sw_vec *theta, *column; /* (n), (3 sections x n) */
  double *matrix, *force; /* of the multipliers */
} chain;

sw_vec sw_chain_turn(sw_vec from, sw_vec to) {
  const sw_vec axis = sw_cross(from, to);
  const double sine = sw_norm(axis);
  if (!(sine > 0)) return sw_v(0, 0, 0);
  return sw_scale(axis, 2.0 * asin(fmin(1.0, 0.5 * sw_dist(from, to))) / sine);
}

static void find_sections(chain *c, int start_free) {
  size_t first = 0;
  int skip = start_free;
  for (size_t k = 0; k < c->n; k++) {
    if (!c->link[k].ends) continue;
    int turns = 0;
    for (size_t i = first; i <= k; i++) turns |= !c->link[i].stays && c->link[i].length > 0;
    if (turns && !skip) c->first[c->sections] = first, c->last[c->sections++] = k;
    first = k + 1, skip = 0;
  }
}

/* Factorises the matrix of the turns. */
static void factorise(chain *c) {
  double sum = 0;
  for (size_t k = 0; k < c->n; k++) sum += c->link[k].joint;
  const double steady = STEADY * (double)c->n / sum;
  for (size_t k = 0; k < c->n; k++) {
    const sw_chain_link *l = &c->link[k];
    const double after = k + 1 < c->n && l->joint > 0 ? 1.0 / l->joint : 0;
    const double before = k > 0 && c->link[k - 1].joint > 0 ? 1.0 / c->link[k - 1].joint : 0;
    c->diagonal[k] = l->stays ? 1.0 : before + after + steady;
    c->next[k] = l->stays || k + 1 == c->n || c->link[k + 1].stays ? 0.0 : -after;
    if (k > 0) c->diagonal[k] -= c->next[k - 1] * c->next[k - 1] / c->diagonal[k - 1];
  }
}

static void solve(const chain *c, sw_vec *b) {
  for (size_t k = 0; k < c->n; k++) {
    if (c->link[k].stays) b[k] = sw_v(0, 0, 0);
    if (k > 0) b[k] = sw_madd(b[k], b[k - 1], -c->next[k - 1] / c->diagonal[k - 1]);
  }
  for (size_t k = c->n; k-- > 0;) {
    if (k + 1 < c->n) b[k] = sw_madd(b[k], b[k + 1], -c->next[k]);
    b[k] = sw_scale(b[k], 1.0 / c->diagonal[k]);
  }
}

/* Computes the right-hand side: at each joint the difference of the links' turn from the wanted
 * one, across the wire, over the links' lengths. */
static void load(const chain *c, sw_vec *b) {
  memset(b, 0, c->n * sizeof *b);
  for (size_t k = 0; k + 1 < c->n; k++) {
    const sw_chain_link *l = &c->link[k];
    if (!(l->joint > 0)) continue;
    const sw_vec along = sw_unit_or(sw_add(l->u, l[1].u), l->u);
    const sw_vec off = sw_sub(l->turn, sw_chain_turn(l->u, l[1].u));
    const sw_vec pull = sw_scale(sw_madd(off, along, -sw_dot(off, along)), 1.0 / l->joint);
    b[k + 1] = sw_add(b[k + 1], pull), b[k] = sw_sub(b[k], pull);
  }
}

/* Returns the way of a section's end for these rotations [m]. */
static sw_vec way_of(const chain *c, size_t section, const sw_vec *theta) {
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = c->first[section]; k <= c->last[section]; k++)
    sum = sw_madd(sum, sw_cross(theta[k], c->link[k].u), c->link[k].length);
  return sum;
}

static sw_vec gap_of(const chain *c, size_t section, double *length) {
  sw_vec gap = sw_neg(c->link[c->last[section]].span);
  *length = 0;
  for (size_t k = c->first[section]; k <= c->last[section]; k++) {
    gap = sw_madd(gap, c->link[k].u, c->link[k].length);
    *length += c->link[k].length;
  }
  return gap;
}

/* Finds the rotations of one iteration. Returns 0 if there are none. */
static int find_rotations(chain *c) {
  const size_t m = 3 * c->sections;
  factorise(c);
  load(c, c->theta);
  solve(c, c->theta);
  for (size_t i = 0; i < m; i++) {
    sw_vec *column = c->column + i * c->n;
    const double axis[3] = {i % 3 == 0, i % 3 == 1, i % 3 == 2};
    memset(column, 0, c->n * sizeof *column);
    for (size_t k = c->first[i / 3]; k <= c->last[i / 3]; k++)
      column[k] = sw_scale(sw_cross(c->link[k].u, sw_load(axis)), c->link[k].length);
    solve(c, column);
    for (size_t j = 0; j < c->sections; j++) {
      const sw_vec way = way_of(c, j, column);
      c->matrix[(3 * j) * m + i] = way.x, c->matrix[(3 * j + 1) * m + i] = way.y;
      c->matrix[(3 * j + 2) * m + i] = way.z;
    }
  }
  for (size_t j = 0; j < c->sections; j++) {
    double length;
    sw_store(c->force + 3 * j, sw_add(gap_of(c, j, &length), way_of(c, j, c->theta)));
    for (size_t k = 3 * j; k < 3 * j + 3; k++) c->matrix[k * m + k] += c->give * length;
  }
  if (m && !sw_cholesky_solve(c->matrix, m, c->force)) return 0;
  for (size_t i = 0; i < m; i++)
    for (size_t k = 0; k < c->n; k++)
      c->theta[k] = sw_madd(c->theta[k], c->column[i * c->n + k], -c->force[i]);
  return 1;
}

static void iterate(chain *c, const sw_vec *began, int *done) {
  double most = HUGE_VAL;
  *done = 0;
  for (int round = 0; round < MOST_ITERATIONS && most > FOUND; round++) {
    if (!find_rotations(c)) return;
    most = 0;
    for (size_t k = 0; k < c->n; k++) {
      sw_chain_link *l = &c->link[k];
      if (l->stays) continue;
      const sw_vec across = sw_madd(c->theta[k], l->u, -sw_dot(c->theta[k], l->u));
      most = fmax(most, sw_norm(across));
      if (!(most < FARTHEST)) return;
      l->u = sw_unit_or(sw_rotate(sw_quat_exp(c->theta[k]), l->u), l->u);
      if (sw_dist(l->u, began[k]) > FARTHEST) return;
    }
  }
  *done = most <= NEARLY;
}

sw_status sw_chain_ease(sw_chain_link *links, size_t n, double give, int start_free, int *done) {
  chain c = {.link = links, .n = n, .give = give};
  size_t *lists SW_LOCAL = sw_alloc(2 * n, sizeof *lists);
  sw_vec *began SW_LOCAL = sw_alloc(2 * n, sizeof *began);
  double *sums SW_LOCAL = sw_alloc(2 * n, sizeof *sums);
  *done = 0;
  if (!lists || !began || !sums) return SW_ENOMEM;
  c.first = lists, c.last = lists + n, c.diagonal = sums, c.next = sums + n, c.theta = began + n;
  for (size_t k = 0; k < n; k++) began[k] = links[k].u;
  find_sections(&c, start_free);
  const size_t m = 3 * c.sections;
  sw_vec *columns SW_LOCAL = sw_alloc(m * n + 1, sizeof *columns);
  double *dense SW_LOCAL = sw_alloc(m * m + m + 1, sizeof *dense);
  if (!columns || !dense) return SW_ENOMEM;
  c.column = columns, c.matrix = dense, c.force = dense + m * m;
  iterate(&c, began, done);
  return SW_OK;
}
