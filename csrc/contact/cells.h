/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points and edges of bodies in the cells of a grid, kept in a hash table: only things in
 * neighbouring cells are compared. */
#ifndef SW_CONTACT_CELLS_H
#define SW_CONTACT_CELLS_H

#include "contact/meet.h"

typedef struct sw_grid_cell {
  int32_t x, y, z;
} sw_grid_cell;

/* A point (node == end), or an edge or segment. In the system's arrays. */
typedef struct sw_thing {
  uint32_t node, end, body, next; /* next: in its cell's list + 1 */
  sw_grid_cell at;
} sw_thing;

typedef struct sw_cells {
  sw_thing *things;
  uint32_t *head; /* (size) first of each list + 1 */
  size_t count, size;
  double width; /* of a cell [m] */
} sw_cells;

/* An empty grid for this many things, with cells of this width [m]. *room (*capacity bytes) grows
 * as needed; the caller frees it. Valid until the next call. SW_ENOMEM. */
sw_status sw_cells_make(void **room, size_t *capacity, size_t most, double width, sw_cells *out);
/* One more, between two nodes at x (nodes x 3) [m]. */
void sw_cells_put(sw_cells *cells, const double *x, uint32_t body, size_t node, size_t end);
/* The grid of all segments of bodies with a rule, with cells wide enough for gaps up to reach [m].
 * points: also points, and edges of surfaces. Valid until the next call. SW_ENOMEM. */
sw_status sw_cells_fill(sw_mutual *mutual, const sw_system *system, double reach, int points,
                        sw_cells *out);
/* Things that may be near thing t, with t itself, in no order: meets(user, t, each). */
typedef sw_status (*sw_cells_visit)(void *user, const sw_thing *t, const sw_thing *u);
sw_status sw_cells_around(const sw_cells *cells, const sw_thing *t, sw_cells_visit meets,
                          void *user);

/* Of what touches there [m]. */
double sw_thing_radius(const sw_body *body);

#endif
