/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sorts points and edges of bodies into the cells of a grid, kept in a hash table, so that only
 * things in neighbouring cells are compared. */
#ifndef SW_MUTUAL_CELLS_H
#define SW_MUTUAL_CELLS_H

#include "mutual/meet.h"

typedef struct sw_grid_cell {
  int32_t x, y, z;
} sw_grid_cell;

/* A point (node == end), or an edge or segment. Numbers are those of the system's arrays. */
typedef struct sw_thing {
  uint32_t node, end, body, next; /* next: the next thing in its list, number + 1, or 0 */
  sw_grid_cell at;
  sw_vec middle; /* [m] */
  double half;   /* half of its length [m] */
  double radius; /* distance of the surface [m] */
} sw_thing;

typedef struct sw_cells {
  sw_thing *things;
  uint32_t *head; /* (size) first thing of each list, number + 1, or 0 */
  size_t count, size;
  double width; /* width of a cell [m] */
} sw_cells;

/* Makes an empty grid for at most this many things, with cells of this width [m]. *room (*capacity
 * bytes) grows as needed; the caller frees it. The grid is valid until the next call. SW_ENOMEM. */
sw_status sw_cells_make(void **room, size_t *capacity, size_t most, double width, sw_cells *out);
/* Adds one thing between two nodes at x (nodes x 3), with its radius [m]. */
void sw_cells_put(sw_cells *cells, const double *x, uint32_t body, size_t node, size_t end,
                  double radius);
/* Makes the grid of all segments of bodies that have a rule, with cells wide enough for gaps up to
 * reach [m]. points = 1: adds points and edges of surfaces too. The grid is valid until the next
 * call. SW_ENOMEM. */
sw_status sw_cells_fill(sw_mutual *mutual, const sw_system *system, double reach, int points,
                        sw_cells *out);
/* Calls meets(user, t, u) for each thing u that may be near thing t, including t itself, in no
 * order. */
typedef sw_status (*sw_cells_visit)(void *user, const sw_thing *t, const sw_thing *u);
sw_status sw_cells_around(const sw_cells *cells, const sw_thing *t, sw_cells_visit meets,
                          void *user);

/* Radius of the body's touching surface around its points and edges [m]. */
double sw_thing_radius(const sw_body *body);

#endif
