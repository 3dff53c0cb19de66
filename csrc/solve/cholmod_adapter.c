/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/cholmod_adapter.h"

#include <string.h>
#include <suitesparse/cholmod.h>

#include "base/alloc.h"

struct sw_cholmod {
  size_t nodes;
  const uint32_t *first, *column;
  cholmod_common common;
  int started;
  int *order;                   /* (3 nodes) unknowns as they are eliminated */
  cholmod_sparse *matrix;       /* upper half column by column: rows of the lower one */
  cholmod_factor *dense, *slow; /* L L' in dense pieces; L D L', made when first needed */
  cholmod_factor *last;         /* the one that holds */
  cholmod_dense *x, *y, *e;     /* kept from one solution to the next */
};

static sw_status status_of(const sw_cholmod *c) {
  switch (c->common.status) {
    case CHOLMOD_OUT_OF_MEMORY: return SW_ENOMEM;
    case CHOLMOD_TOO_LARGE: return SW_ELIMIT;
    default: return c->common.status < CHOLMOD_OK ? SW_EINVAL : SW_OK;
  }
}

void sw_cholmod_free(sw_cholmod *c) {
  if (!c) return;
  if (c->started) {
    cholmod_free_sparse(&c->matrix, &c->common);
    cholmod_free_factor(&c->dense, &c->common);
    cholmod_free_factor(&c->slow, &c->common);
    cholmod_free_dense(&c->x, &c->common);
    cholmod_free_dense(&c->y, &c->common);
    cholmod_free_dense(&c->e, &c->common);
    cholmod_finish(&c->common);
  }
  sw_free(c->order);
  sw_free(c);
}

/* An order of the nodes, and from it one of their unknowns: a third of the size, and a ninth of
 * the entries, to be ordered. */
static sw_status find_order(sw_cholmod *c) {
  cholmod_common *m = &c->common;
  const size_t n = c->nodes, blocks = c->first[n];
  cholmod_sparse *graph = cholmod_allocate_sparse(n, n, blocks, 1, 1, 1, CHOLMOD_PATTERN, m);
  if (!graph) return status_of(c);
  int *start = graph->p, *row = graph->i;
  for (size_t i = 0; i <= n; i++) start[i] = (int)c->first[i];
  for (size_t k = 0; k < blocks; k++) row[k] = (int)c->column[k];
  int *nodes = c->order + 2 * n; /* its last third: read before it is overwritten */
  const int done = cholmod_metis(graph, NULL, 0, 1, nodes, m);
  cholmod_free_sparse(&graph, m);
  if (!done) return status_of(c);
  for (size_t k = 0; k < n; k++) {
    const int node = nodes[k];
    for (size_t i = 0; i < 3; i++) c->order[3 * k + i] = 3 * node + (int)i;
  }
  return SW_OK;
}

/* The places of all entries; a node's own block has 1 + 2 + 3. */
static sw_status make_matrix(sw_cholmod *c) {
  const size_t n = c->nodes, most = 9 * (size_t)c->first[n] - 3 * n;
  c->matrix = cholmod_allocate_sparse(3 * n, 3 * n, most, 1, 1, 1, CHOLMOD_REAL, &c->common);
  if (!c->matrix) return status_of(c);
  int *start = c->matrix->p, *row = c->matrix->i, filled = 0;
  for (size_t i = 0; i < n; i++)
    for (int a = 0; a < 3; a++) {
      start[3 * i + (size_t)a] = filled;
      for (uint32_t k = c->first[i]; k < c->first[i + 1]; k++)
        for (int b = 0; b < (c->column[k] == i ? a + 1 : 3); b++)
          row[filled++] = 3 * (int)c->column[k] + b;
    }
  start[3 * n] = filled;
  return SW_OK;
}

static sw_status analyse(sw_cholmod *c, int kind, cholmod_factor **out) {
  c->common.supernodal = kind;
  *out = cholmod_analyze_p(c->matrix, c->order, NULL, 0, &c->common);
  return *out ? SW_OK : status_of(c);
}

sw_status sw_cholmod_new(size_t nodes, const uint32_t *first, const uint32_t *column,
                         sw_cholmod **out) {
  sw_cholmod *c = sw_alloc(1, sizeof *c);
  if (!c) return SW_ENOMEM;
  c->nodes = nodes, c->first = first, c->column = column;
  c->started = cholmod_start(&c->common);
  c->common.print = 0;
  c->common.quick_return_if_not_posdef = 1;
  c->common.nmethods = 1;
  c->common.method[0].ordering = CHOLMOD_GIVEN;
  c->order = sw_alloc(3 * nodes, sizeof *c->order);
  sw_status status = c->order && c->started ? SW_OK : SW_ENOMEM;
  if (status == SW_OK) status = find_order(c);
  if (status == SW_OK) status = make_matrix(c);
  if (status == SW_OK) status = analyse(c, CHOLMOD_SUPERNODAL, &c->dense);
  if (status == SW_OK)
    *out = c;
  else
    sw_cholmod_free(c);
  return status;
}

/* Values into their places; 0 when one is not finite: what dense pieces do with such depends on
 * whose BLAS is installed. */
static int fill(sw_cholmod *c, const double *values, const unsigned char *fixed) {
  double *to = c->matrix->x;
  int finite = 1;
  for (size_t i = 0; i < c->nodes; i++)
    for (size_t a = 0; a < 3; a++)
      for (uint32_t k = c->first[i]; k < c->first[i + 1]; k++) {
        const size_t j = c->column[k], wide = j == i ? a + 1 : 3;
        const double *from = values + 9 * (size_t)k + 3 * a;
        const int out = fixed && (fixed[i] || fixed[j]);
        for (size_t b = 0; b < wide; b++, to++) {
          *to = out ? (i == j && a == b) : from[b];
          finite &= *to - *to == 0.0;
        }
      }
  return finite;
}

static sw_status factorise(sw_cholmod *c, cholmod_factor *factor) {
  if (!cholmod_factorize(c->matrix, factor, &c->common)) return status_of(c);
  if (factor->minor < factor->n || !(cholmod_rcond(factor, &c->common) > 0.0)) return SW_ESINGULAR;
  c->last = factor;
  return SW_OK;
}

/* D stands at the beginning of each column. */
static size_t count_negative(const cholmod_factor *factor) {
  const int *start = factor->p;
  const double *x = factor->x;
  size_t count = 0;
  for (size_t k = 0; k < factor->n; k++) count += x[start[k]] < 0.0;
  return count;
}

/* A solution for nothing, so that the vectors of the next ones are there. */
static sw_status try_vectors(sw_cholmod *c) {
  cholmod_dense *b = cholmod_zeros(3 * c->nodes, 1, CHOLMOD_REAL, &c->common);
  const int done =
      b && cholmod_solve2(CHOLMOD_A, c->last, b, NULL, &c->x, NULL, &c->y, &c->e, &c->common);
  cholmod_free_dense(&b, &c->common);
  return done ? SW_OK : SW_ENOMEM;
}

sw_status sw_cholmod_factor(sw_cholmod *c, const double *values, const unsigned char *fixed,
                            size_t *negative) {
  const cholmod_factor *before = c->last;
  if (negative) *negative = 0;
  if (!fill(c, values, fixed)) return SW_ESINGULAR;
  sw_status status = factorise(c, c->dense);
  if (status == SW_ESINGULAR) {
    if (!c->slow) SW_TRY(analyse(c, CHOLMOD_SIMPLICIAL, &c->slow));
    status = factorise(c, c->slow);
    if (status == SW_OK && negative) *negative = count_negative(c->slow);
  }
  if (status == SW_OK && c->last != before) status = try_vectors(c);
  return status;
}

void sw_cholmod_solve(sw_cholmod *c, double *x) {
  cholmod_dense b = {.nrow = 3 * c->nodes,
                     .ncol = 1,
                     .nzmax = 3 * c->nodes,
                     .d = 3 * c->nodes,
                     .x = x,
                     .xtype = CHOLMOD_REAL,
                     .dtype = CHOLMOD_DOUBLE};
  if (cholmod_solve2(CHOLMOD_A, c->last, &b, NULL, &c->x, NULL, &c->y, &c->e, &c->common))
    memcpy(x, c->x->x, 3 * c->nodes * sizeof *x);
}
