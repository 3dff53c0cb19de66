/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells of a grid in space, kept in a hash table: only what is in neighbouring ones is compared. */
#ifndef SW_CONTACT_CELL_H
#define SW_CONTACT_CELL_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

typedef struct sw_cell {
  int32_t x, y, z;
} sw_cell;

/* Of a place that is far away or nowhere too, so that cells beside it have numbers. */
static inline int32_t sw_cell_number(double x) { return (int32_t)fmax(-1e9, fmin(1e9, floor(x))); }

/* The cell of a place [m]. */
static inline sw_cell sw_cell_of(double width, sw_vec p) {
  const double r = 1.0 / width;
  return (sw_cell){sw_cell_number(p.x * r), sw_cell_number(p.y * r), sw_cell_number(p.z * r)};
}

static inline int sw_cell_same(sw_cell a, sw_cell b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* One of d = 0 to 26: the cell itself is number 13. */
enum { SW_CELL_NEIGHBOURS = 27 };
static inline sw_cell sw_cell_beside(sw_cell c, int d) {
  return (sw_cell){c.x + d % 3 - 1, c.y + d / 3 % 3 - 1, c.z + d / 9 - 1};
}

/* Its list in a table of this size, a power of two. */
static inline size_t sw_cell_bucket(sw_cell c, size_t size) {
  const uint32_t h =
      (uint32_t)c.x * 73856093u ^ (uint32_t)c.y * 19349663u ^ (uint32_t)c.z * 83492791u;
  return (h * 2654435761u) >> 7 & (size - 1);
}

#endif
