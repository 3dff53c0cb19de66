/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eliminates some rows of a symmetric matrix, from the last one to the first. The lower half then
 * becomes the factor row by row: A = L' D L. A row holds its columns among the unknowns that stay
 * ("before"), padded, and then its columns among the eliminated rows. A ring is a front, and so is
 * each piece of a sparse matrix. */
#ifndef SW_SOLVE_BLOCKS_FRONT_H
#define SW_SOLVE_BLOCKS_FRONT_H

#include <stddef.h>

enum {
  SW_FRONT_TILE = 8,  /* columns of a register tile; parts of rows are padded to it */
  SW_FRONT_PANEL = 6, /* rows eliminated at once; the last panel of a front may have 3 */
  SW_FRONT_KEPT = 8,  /* numbers kept of a row's part of its panel */
  SW_FRONT_ROWS = 192 /* rows whose products are subtracted at once; a multiple of all above */
};

typedef struct sw_front {
  size_t n;        /* rows, a multiple of 3 */
  size_t before;   /* columns that stay, padded; 0: there are none */
  size_t place;    /* start of the rows' own columns */
  size_t stride;   /* from row to row; columns beyond the last may be read */
  const double *a; /* (n x stride) values; may be the factor */
  double *factor;  /* (n x stride) L left of its panels, 0 inside and right of them */
  double *kept;    /* (n x SW_FRONT_KEPT) L inside the panels, then 1/D */
  double *scaled;  /* (n x stride) D L, for later eliminations */
  /* L and D L of the next front (after this one), with equal stride and n rows; its columns
   * "before" are this one's own. NULL: there is none. */
  const double *next_factor, *next_scaled;
  size_t negative, bad; /* counts of negative pivots and of zero or non-finite ones, added to */
} sw_front;

static inline size_t sw_front_pad(size_t n) {
  return (n + SW_FRONT_TILE - 1) / SW_FRONT_TILE * SW_FRONT_TILE;
}

/* Fills factor, kept and scaled. */
void sw_front_eliminate(sw_front *front);

/* The same in place, without a next front, in parts of SW_FRONT_ROWS rows (the size of scaled).
 * Subtracts the products from rest, the columns that stay: (rows x before), the lower half up to
 * full tiles. */
void sw_front_reduce(sw_front *front, double *rest, size_t rows);

/* Solves. own: (n, and unchanged up to a tile beyond), before: (its columns). First forward on all
 * fronts in the order of their elimination: own = L'^-1 own and before -= ...; then backward in the
 * opposite order: own = L^-1 (D^-1 own - L before). */
void sw_front_forward(const sw_front *front, double *own, double *before);
void sw_front_backward(const sw_front *front, double *own, const double *before);

#endif
