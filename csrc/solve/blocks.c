/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls the ring matrix (rings.h) or the sparse one (blocks_sparse.h). */
#include "solve/blocks.h"

#include "base/alloc.h"
#include "solve/blocks_sparse.h"
#include "solve/blocks_tree.h"
#include "solve/rings.h"

/* One of the two is set. */
struct sw_blocks {
  sw_rings *rings;
  sw_blocks_sparse *sparse;
};

static sw_status finish(sw_status status, sw_blocks *b, sw_blocks **out) {
  if (status == SW_OK)
    *out = b;
  else
    sw_blocks_free(b);
  return status;
}

sw_status sw_blocks_new_rings(size_t rings, size_t per_ring, sw_blocks **out) {
  sw_blocks *b = sw_alloc(1, sizeof *b);
  if (!b) return SW_ENOMEM;
  return finish(sw_rings_new(rings, per_ring, &b->rings), b, out);
}

sw_status sw_blocks_new_sparse(size_t nodes, const sw_couple *pairs, size_t count,
                               const int32_t *order, sw_blocks *old, sw_blocks **out) {
  sw_blocks *b = sw_alloc(1, sizeof *b);
  if (!b) return SW_ENOMEM;
  return finish(
      sw_blocks_sparse_new(nodes, pairs, count, order, old ? old->sparse : NULL, &b->sparse), b,
      out);
}

void sw_blocks_free(sw_blocks *b) {
  if (!b) return;
  sw_rings_free(b->rings);
  sw_blocks_sparse_free(b->sparse);
  sw_free(b);
}

size_t sw_blocks_nodes(const sw_blocks *b) {
  return b->rings ? b->rings->rings * b->rings->per_ring : b->sparse->nodes;
}

double *sw_blocks_values(sw_blocks *b) {
  return b->rings ? b->rings->values : b->sparse->values.at;
}

size_t sw_blocks_stride(const sw_blocks *b) { return b->rings ? b->rings->stride : 3; }

size_t sw_blocks_slot(const sw_blocks *b, size_t i, size_t j) {
  return b->rings ? sw_rings_slot(b->rings, i, j) : sw_blocks_sparse_slot(b->sparse, i, j);
}

void sw_blocks_clear(sw_blocks *b) {
  if (b->rings)
    sw_rings_clear(b->rings);
  else
    sw_blocks_sparse_clear(b->sparse);
}

sw_status sw_blocks_factor(sw_blocks *b, const unsigned char *fixed, size_t *negative) {
  return b->rings ? sw_rings_factor(b->rings, fixed, negative)
                  : sw_blocks_sparse_factor(b->sparse, fixed, negative);
}

double sw_blocks_work(const sw_blocks *b) {
  return b->rings ? sw_rings_work(b->rings->rings, b->rings->per_ring)
                  : sw_tree_work(b->sparse->tree);
}

double sw_blocks_rings_work(size_t rings, size_t per_ring) {
  return sw_rings_work(rings, per_ring);
}

void sw_blocks_solve(const sw_blocks *b, double *x) {
  if (b->rings)
    sw_rings_solve(b->rings, x);
  else
    sw_blocks_sparse_solve(b->sparse, x);
}

void sw_blocks_multiply(const sw_blocks *b, const double *x, double *y) {
  if (b->rings)
    sw_rings_multiply(b->rings, x, y);
  else
    sw_blocks_sparse_multiply(b->sparse, x, y);
}

void sw_blocks_row_times(const sw_blocks *b, size_t node, const double *x, double y[3]) {
  if (b->rings)
    sw_rings_row_times(b->rings, node, x, y);
  else
    sw_blocks_sparse_row_times(b->sparse, node, x, y);
}
