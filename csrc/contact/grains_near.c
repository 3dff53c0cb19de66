/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What may touch in a step: particles, and particles and segments, that are near each other. Found
 * with a grid of cells in which only neighbours are compared. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "contact/cell.h"
#include "contact/grain.h"

static const double RESERVE = 1.5; /* of what speeds can close in the step [-] */
static const double LEAST = 0.25;  /* of the radii's sum: what is as near is chosen [-] */

double sw_grain_radius(const sw_body *b) {
  return b->plan->web ? b->plan->web->skin : b->plan->beam.radius;
}

/* --- the grid --------------------------------------------------------------------- */

/* A point (node == end) or an edge. */
typedef struct thing {
  uint32_t node, end, body, next; /* next: in its cell's list + 1 */
  sw_cell at;
} thing;

typedef struct grid {
  thing *things;
  uint32_t *head; /* (size) first of each list + 1 */
  size_t count, size;
  double width; /* of a cell [m] */
} grid;

static void put(grid *g, const double *x, uint32_t body, size_t node, size_t end) {
  thing *t = &g->things[g->count++];
  *t = (thing){.node = (uint32_t)node, .end = (uint32_t)end, .body = body};
  t->at = sw_cell_of(g->width, sw_lerp(sw_vec_at(x, node), sw_vec_at(x, end), 0.5));
  uint32_t *head = &g->head[sw_cell_bucket(t->at, g->size)];
  t->next = *head;
  *head = (uint32_t)g->count;
}

/* Of its segments, or edges of its surface [m2]. */
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

/* Width of a cell beyond the gap that is looked for: what a thing's middle may be off [m]. */
static double widest(const sw_grains *g, const sw_system *s) {
  double radius = 0, length2 = 0, far = 0;
  for (size_t k = 0; k < s->body_count; k++) {
    const sw_body *b = &s->bodies[k];
    const double *x = s->x + 3 * b->first_node;
    if (!sw_mutual_takes_part(&g->m, k)) continue;
    radius = fmax(radius, sw_grain_radius(b));
    length2 = fmax(length2, longest2(b, x));
    for (size_t i = 0; i < 3 * b->plan->nodes; i++) far = fmax(far, fabs(x[i]));
  }
  /* cell numbers must stay far below overflow */
  return fmax(2.0 * radius + sqrt(length2), far * 1e-8);
}

/* Points and edges of a body. */
static void put_body(grid *g, const sw_system *s, uint32_t body) {
  const sw_body *b = &s->bodies[body];
  const sw_web *w = b->plan->web;
  const size_t first = b->first_node;
  for (size_t i = 0; i < b->plan->nodes; i++) {
    if (!w || w->outer[i]) put(g, s->x, body, first + i, first + i);
    if (!w && i < b->plan->edges) put(g, s->x, body, first + i, first + i + 1);
    for (size_t k = w ? w->side_first[i] : 0; w && k < w->side_first[i + 1]; k++)
      put(g, s->x, body, first + i, first + w->side[k]);
  }
}

static sw_status fill(sw_grains *g, const sw_system *s, double width, grid *out) {
  size_t most = 0;
  for (size_t k = 0; k < s->body_count; k++) {
    const sw_plan *p = s->bodies[k].plan;
    most += p->nodes + (p->web ? p->web->side_first[p->web->particles] : p->edges);
  }
  *out = (grid){.size = 64, .width = width};
  while (out->size < 2 * most) out->size *= 2;
  const size_t bytes = most * sizeof *out->things + out->size * sizeof *out->head;
  SW_TRY(sw_grow(&g->grid, &g->grid_capacity, bytes, 1));
  out->things = g->grid;
  out->head = (uint32_t *)(void *)(out->things + most);
  memset(out->head, 0, out->size * sizeof *out->head);
  for (size_t k = 0; k < s->body_count; k++)
    if (sw_mutual_takes_part(&g->m, k)) put_body(out, s, (uint32_t)k);
  return SW_OK;
}

/* --- choosing ---------------------------------------------------------------------- */

static double reserve_of(const sw_grains *g, double reach, double speed) {
  return fmax(LEAST * reach + g->m.fall, g->m.least_reserve) + RESERVE * g->m.h * speed;
}

/* Of a body's node by itself [N/m]. */
static double stiffness_at(const sw_grains *g, const sw_system *s, uint32_t body, uint32_t node) {
  const sw_body *b = &s->bodies[body];
  const size_t i = node - b->first_node;
  const sw_plan *p = b->plan;
  if (!p->web) return fmax(g->m.base[body], g->m.rate2 * p->beam.mass * p->rest[i]);
  const double own = fmax(g->m.base[body], g->m.rate2 * p->lumped[i]);
  return g->m.regime == SW_CONTACT_EXPLICIT ? own : fmax(own, sw_contact_hardness(p->web, i));
}

/* More than this near each other are of particles much closer than they should be [-]. */
static const size_t MOST_NEAR = 30000000;

/* Which of two things is looked at, as what: a particle with all; a wire's node and edges of
 * surfaces; edges with each other and with segments. What is left out these do for it. */
static int counts(const sw_system *s, const thing *t, const thing *u) {
  const int points = (t->node == t->end) + (u->node == u->end);
  const int wires = !s->bodies[t->body].plan->web + !s->bodies[u->body].plan->web;
  return points == 2 ? wires == 0 : wires < 2;
}

/* Are they parts of one object that hang together? */
static int is_one(const sw_grains *g, const sw_system *s, const sw_ends *e) {
  const uint32_t first = (uint32_t)s->bodies[e->body[0]].first_node;
  const uint32_t one[2] = {e->node[0], e->end[0]}, two[2] = {e->node[1], e->end[1]};
  if (e->body[0] != e->body[1]) return 0;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++)
      if (one[i] == two[j] ||
          sw_joined_nearly(&g->joined[e->body[0]], one[i] - first, two[j] - first))
        return 1;
  return 0;
}

static double hardness(const sw_grains *g, const sw_system *s, const sw_ends *e) {
  double least = HUGE_VAL;
  for (int n = 0; n < 2; n++)
    least = fmin(least, fmax(stiffness_at(g, s, e->body[n], e->node[n]),
                             stiffness_at(g, s, e->body[n], e->end[n])));
  return least;
}

static sw_status look_at(sw_grains *g, const sw_system *s, const thing *t, const thing *u) {
  double at[2];
  sw_grain_pair k = {.of = {{t->node, u->node}, {t->end, u->end}, {t->body, u->body}}};
  if (!sw_mutual_rule(&g->m, k.of.body)->on || !counts(s, t, u)) return SW_OK;
  k.reach = sw_grain_radius(&s->bodies[t->body]) + sw_grain_radius(&s->bodies[u->body]);
  const double gap = sw_grain_nearest(s->x, &k.of, at) - k.reach;
  if (!(gap < reserve_of(g, k.reach, sw_ends_speed(s, &k.of))) || is_one(g, s, &k.of)) return SW_OK;
  if (g->m.pair_count == MOST_NEAR) return SW_ELIMIT;
  k.usual = hardness(g, s, &k.of);
  k.held = sw_ends_held(s, &k.of);
  SW_TRY(sw_grow((void **)&g->pairs, &g->pair_capacity, g->m.pair_count + 1, sizeof *g->pairs));
  g->pairs[g->m.pair_count++] = k;
  return SW_OK;
}

/* What is in the cells around a thing: points look for edges, of two alike the first one looks. */
static sw_status look_around(sw_grains *g, const sw_system *s, const grid *all, size_t k) {
  const thing *t = &all->things[k];
  for (int d = 0; d < SW_CELL_NEIGHBOURS; d++) {
    const sw_cell at = sw_cell_beside(t->at, d);
    for (uint32_t m = all->head[sw_cell_bucket(at, all->size)]; m; m = all->things[m - 1].next) {
      const thing *u = &all->things[m - 1];
      if (!sw_cell_same(u->at, at)) continue;
      const int point = t->node == t->end, other = u->node == u->end;
      const int line = !s->bodies[t->body].plan->web && !point; /* is the second of two edges */
      if (point == other ? m - 1 > k : point) SW_TRY(look_at(g, s, line ? u : t, line ? t : u));
    }
  }
  return SW_OK;
}

static int by_order(const void *p, const void *q) {
  return sw_ends_order(&((const sw_grain_pair *)p)->of, &((const sw_grain_pair *)q)->of);
}

static sw_status search(sw_grains *g, const sw_system *s) {
  grid all;
  double speed = 0, reach = 0;
  for (size_t k = 0; k < s->body_count; k++) {
    const sw_body *b = &s->bodies[k];
    if (!sw_mutual_takes_part(&g->m, k)) continue;
    reach = fmax(reach, 2.0 * sw_grain_radius(b));
    for (size_t i = 0; g->m.h > 0 && i < b->plan->nodes; i++)
      speed = fmax(speed, 2.0 * sw_norm(sw_vec_at(s->v, b->first_node + i)));
  }
  SW_TRY(fill(g, s, widest(g, s) + reserve_of(g, reach, speed), &all));
  for (size_t k = 0; k < all.count; k++) {
    if (sw_interrupted()) return SW_EINTR;
    SW_TRY(look_around(g, s, &all, k));
  }
  if (g->m.pair_count) qsort(g->pairs, g->m.pair_count, sizeof *g->pairs, by_order);
  return SW_OK;
}

static sw_status plan_links(sw_system *s, const sw_ends *e) {
  for (int i = 0; i < (e->end[0] != e->node[0] ? 2 : 1); i++)
    for (int j = 0; j < (e->end[1] != e->node[1] ? 2 : 1); j++)
      SW_TRY(sw_system_plan_bridge(s, i ? e->end[0] : e->node[0], j ? e->end[1] : e->node[1]));
  return SW_OK;
}

sw_status sw_grains_choose(sw_mutual *m, sw_system *s) {
  sw_grains *g = sw_grains_of(m);
  SW_TRY(search(g, s));
  for (size_t i = 0; i < m->pair_count; i++)
    if (!g->pairs[i].held) SW_TRY(plan_links(s, &g->pairs[i].of));
  return SW_OK;
}
