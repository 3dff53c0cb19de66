/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A hash table of grid cells, each with the points and edges in it. */
#include "mutual/cells.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* Number of a cell along an axis. It is finite for places far away and for NaN, so that
 * neighbouring cells have numbers too. */
static int32_t number_of(double x) { return (int32_t)fmax(-1e9, fmin(1e9, floor(x))); }

/* The cell of a place [m]. */
static sw_grid_cell cell_of(double width, sw_vec p) {
  const double r = 1.0 / width;
  return (sw_grid_cell){number_of(p.x * r), number_of(p.y * r), number_of(p.z * r)};
}

static int is_same(sw_grid_cell a, sw_grid_cell b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The neighbouring cells are numbered d = 0 to 26; 13 is the cell itself. */
enum { NEIGHBOURS = 27 };
static sw_grid_cell beside(sw_grid_cell c, int d) {
  return (sw_grid_cell){c.x + d % 3 - 1, c.y + d / 3 % 3 - 1, c.z + d / 9 - 1};
}

/* Index of a cell's list in a table of this size, a power of 2. */
static size_t bucket(sw_grid_cell c, size_t size) {
  const uint32_t h =
      (uint32_t)c.x * 73856093u ^ (uint32_t)c.y * 19349663u ^ (uint32_t)c.z * 83492791u;
  return (h * 2654435761u) >> 7 & (size - 1);
}

double sw_thing_radius(const sw_body *b) {
  const sw_web *w = b->plan->web;
  if (!w) return b->plan->beam.radius;
  return sw_web_has_lines(w) ? fmax(w->skin, w->line_skin) : w->skin;
}

/* Square of the longest of a body's segments, or of the edges of its surface [m2]. */
static double longest2(const sw_body *b, const double *x) {
  const sw_web *w = b->plan->web;
  double most = 0;
  for (size_t i = 0; w && i < w->particles; i++)
    for (size_t k = w->side_first[i]; k < w->side_first[i + 1]; k++)
      most = fmax(most, sw_norm2(sw_sub(sw_vec_at(x, i), sw_vec_at(x, w->side[k]))));
  for (size_t e = 0; e < b->plan->edges; e++)
    most = fmax(most, sw_norm2(sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e))));
  return most;
}

/* Width of a cell: the gap of the search plus twice the largest distance of a thing's surface from
 * its middle [m]. */
static double width_of(const sw_mutual *m, const sw_system *s, double reach) {
  double radius = 0, length2 = 0, far = 0;
  for (size_t k = 0; k < s->body_count; k++) {
    const sw_body *b = &s->bodies[k];
    const double *x = s->x + 3 * b->first_node;
    if (!sw_mutual_takes_part(m, k)) continue;
    radius = fmax(radius, sw_thing_radius(b));
    length2 = fmax(length2, longest2(b, x));
    for (size_t i = 0; i < 3 * b->plan->nodes; i++) far = fmax(far, fabs(x[i]));
  }
  /* cell numbers must stay far below overflow */
  return fmax(2.0 * radius + sqrt(length2) + reach, far * 1e-8);
}

sw_status sw_cells_make(void **room, size_t *capacity, size_t most, double width, sw_cells *out) {
  *out = (sw_cells){.size = 64, .width = width};
  while (out->size < 2 * most) out->size *= 2;
  const size_t bytes = most * sizeof *out->things + out->size * sizeof *out->head;
  SW_TRY(sw_grow(room, capacity, bytes, 1));
  out->things = *room;
  out->head = (uint32_t *)(void *)(out->things + most);
  memset(out->head, 0, out->size * sizeof *out->head);
  return SW_OK;
}

void sw_cells_put(sw_cells *g, const double *x, uint32_t body, size_t node, size_t end,
                  double radius) {
  sw_thing *t = &g->things[g->count++];
  *t = (sw_thing){.node = (uint32_t)node, .end = (uint32_t)end, .body = body, .radius = radius};
  t->middle = sw_lerp(sw_vec_at(x, node), sw_vec_at(x, end), 0.5);
  t->half = 0.5 * sw_dist(sw_vec_at(x, node), sw_vec_at(x, end));
  t->at = cell_of(g->width, t->middle);
  uint32_t *head = &g->head[bucket(t->at, g->size)];
  t->next = *head;
  *head = (uint32_t)g->count;
}

static void put_body(sw_cells *g, const sw_system *s, uint32_t body, int points) {
  const sw_body *b = &s->bodies[body];
  const sw_web *w = b->plan->web;
  const size_t first = b->first_node;
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const double r = sw_plan_skin(b->plan, i);
    if (points && (!w || w->outer[i])) sw_cells_put(g, s->x, body, first + i, first + i, r);
    if (!w && i < b->plan->edges) sw_cells_put(g, s->x, body, first + i, first + i + 1, r);
    for (size_t k = points && w ? w->side_first[i] : 0; points && w && k < w->side_first[i + 1];
         k++)
      sw_cells_put(g, s->x, body, first + i, first + w->side[k], r);
  }
}

sw_status sw_cells_fill(sw_mutual *m, const sw_system *s, double reach, int points, sw_cells *out) {
  size_t most = 0;
  for (size_t k = 0; k < s->body_count; k++) {
    const sw_plan *p = s->bodies[k].plan;
    most += p->nodes + (p->web ? p->web->side_first[p->web->particles] : p->edges);
  }
  SW_TRY(sw_cells_make(&m->grid, &m->grid_capacity, most, width_of(m, s, reach), out));
  for (size_t k = 0; k < s->body_count; k++)
    if (sw_mutual_takes_part(m, k)) put_body(out, s, (uint32_t)k, points);
  return SW_OK;
}

sw_status sw_cells_around(const sw_cells *g, const sw_thing *t, sw_cells_visit meets, void *user) {
  for (int d = 0; d < NEIGHBOURS; d++) {
    const sw_grid_cell at = beside(t->at, d);
    for (uint32_t m = g->head[bucket(at, g->size)]; m; m = g->things[m - 1].next)
      if (is_same(g->things[m - 1].at, at)) SW_TRY(meets(user, t, &g->things[m - 1]));
  }
  return SW_OK;
}
