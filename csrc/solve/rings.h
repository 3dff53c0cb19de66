/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Block-tridiagonal symmetric matrices with dense blocks: nodes in rings, as in solve/blocks.h. A
 * ring's row holds its columns in the previous ring, padded, and then those in its own ring,
 * contiguously. Each ring is eliminated as a front (solve/blocks_front.h), the last one first. */
#ifndef SW_SOLVE_RINGS_H
#define SW_SOLVE_RINGS_H

#include <stddef.h>

#include "base/status.h"

typedef struct sw_rings {
  size_t rings, per_ring;
  size_t n;      /* rows of a ring: 3 per_ring */
  size_t padded; /* n, rounded up to a full tile */
  size_t stride; /* a row: two rings and a line of zeros, so that columns do not share cache sets */
  double *values; /* (rings x n x stride) */
  double *factor; /* (rings x n x stride) */
  double *kept;   /* (rings x n x SW_FRONT_KEPT) */
  double *scaled; /* (2 x n x stride) D L of this ring and the one eliminated before it */
  double *masked; /* (n x stride) rows of a ring without its fixed nodes */
  double *x, *y;  /* (rings x padded) vectors */
} sw_rings;

sw_status sw_rings_new(size_t rings, size_t per_ring, sw_rings **out);
void sw_rings_free(sw_rings *rings); /* NULL is allowed */
size_t sw_rings_slot(const sw_rings *rings, size_t i, size_t j);
sw_status sw_rings_factor(sw_rings *rings, const unsigned char *fixed, size_t *negative);
void sw_rings_solve(const sw_rings *rings, double *x);
void sw_rings_multiply(const sw_rings *rings, const double *x, double *y);
void sw_rings_row_times(const sw_rings *rings, size_t node, const double *x, double y[3]);

/* Copies between the user's vectors (n per ring) and padded ones. */
void sw_rings_pad(const sw_rings *rings, const double *x, double *padded);
void sw_rings_unpad(const sw_rings *rings, const double *padded, double *x);

#endif
