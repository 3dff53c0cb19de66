/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the pairs that may touch in a step: two particles, a particle and a segment, or two edges
 * near each other. A list of things near each other serves many steps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "mutual/cells.h"
#include "mutual/grain.h"
#include "touch/same.h"

static double reserve_of(const sw_grains *g, double reach, double speed) {
  return fmax(SW_LISTED_GAP * reach + g->m.fall, g->m.least_reserve) + SW_RESERVE * g->m.h * speed;
}

/* Stiffness of a touch at a body's node, from this body alone [N/m]. */
static double stiffness_at(const sw_grains *g, const sw_system *s, uint32_t body, uint32_t node) {
  const sw_body *b = &s->bodies[body];
  const size_t i = node - b->first_node;
  const sw_plan *p = b->plan;
  if (!p->web) return fmax(g->m.base[body], g->m.rate2 * p->beam.mass * p->rest[i]);
  const double own = fmax(g->m.base[body], g->m.rate2 * p->lumped[i]);
  return g->m.regime == SW_CONTACT_EXPLICIT ? own : fmax(own, sw_contact_hardness(p->web, i));
}

/* With more near pairs than this, particles lie much closer than they should [-]. */
static const size_t MOST_NEAR = 30000000;

/* 1 if this kind of pair is checked: a particle with anything; a wire's node with edges of
 * surfaces; edges with each other and with segments. The other kinds are covered by these. */
static int counts(const sw_system *s, const sw_thing *t, const sw_thing *u) {
  const int points = (t->node == t->end) + (u->node == u->end);
  const int wires = !s->bodies[t->body].plan->web + !s->bodies[u->body].plan->web;
  return points == 2 ? wires == 0 : wires < 2;
}

/* 1 if both are near each other along a mesh, and one of them is part of a line. A line bent with
 * the smallest radius touches itself after a length of pi radii. */
static int is_beside(const sw_web *w, const sw_plan *p, size_t one, size_t two) {
  if (!sw_web_has_lines(w)) return 0;
  const double skin = fmax(sw_plan_skin(p, one), sw_plan_skin(p, two));
  return skin > w->skin && fabs(w->s[one] - w->s[two]) < M_PI * skin;
}

/* 1 if both are connected parts of one object. */
static int is_one(const sw_grains *g, const sw_system *s, const sw_ends *e) {
  const sw_plan *p = s->bodies[e->body[0]].plan;
  const uint32_t first = (uint32_t)s->bodies[e->body[0]].first_node;
  const uint32_t one[2] = {e->node[0], e->end[0]}, two[2] = {e->node[1], e->end[1]};
  if (e->body[0] != e->body[1]) return 0;
  if (is_beside(p->web, p, one[0] - first, two[0] - first)) return 1;
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

/* 1 if even balls around both things are further apart than this gap [m]. */
static int is_far(const sw_thing *t, const sw_thing *u, double gap) {
  const double reach = gap + t->radius + u->radius + t->half + u->half;
  const sw_vec apart = sw_sub(t->middle, u->middle);
  return sw_norm2(apart) > reach * reach;
}

/* A search for things near each other. */
typedef struct search {
  sw_grains *g;
  const sw_system *s;
} search;

static sw_status look_at(sw_grains *g, const sw_system *s, const sw_thing *t, const sw_thing *u) {
  double at[2];
  sw_grain_near n = {.of = {{t->node, u->node}, {t->end, u->end}, {t->body, u->body}},
                     .reach = t->radius + u->radius};
  if (!counts(s, t, u)) return SW_OK;
  if (!(sw_grain_nearest(s->x, &n.of, at) - n.reach < g->listed_gap)) return SW_OK;
  if (is_one(g, s, &n.of)) return SW_OK;
  if (g->near_count == MOST_NEAR) return SW_ELIMIT;
  SW_TRY(SW_GROW(g->near, g->near_capacity, g->near_count + 1));
  g->near[g->near_count++] = n;
  return SW_OK;
}

/* Of a point and an edge, the point searches for the pair; of two points or two edges, the first
 * one. */
static sw_status meets(void *user, const sw_thing *t, const sw_thing *u) {
  const search *all = user;
  const int point = t->node == t->end, other = u->node == u->end;
  const int line = !all->s->bodies[t->body].plan->web && !point; /* a wire's segment comes second */
  if (point == other ? u <= t : !point) return SW_OK;
  const uint32_t bodies[2] = {t->body, u->body};
  if (!sw_mutual_rule(&all->g->m, bodies)->on || is_far(t, u, all->g->listed_gap)) return SW_OK;
  return look_at(all->g, all->s, line ? u : t, line ? t : u);
}

static int by_order(const void *p, const void *q) {
  return sw_ends_order(&((const sw_grain_near *)p)->of, &((const sw_grain_near *)q)->of);
}

static sw_status list_anew(sw_grains *g, const sw_system *s, double gap) {
  search all = {g, s};
  sw_cells cells;
  g->near_count = g->listed_nodes = 0;
  g->listed_gap = gap;
  SW_TRY(sw_cells_fill(&g->m, s, gap, 1, &cells));
  for (size_t k = 0; k < cells.count; k++) {
    if (sw_interrupted()) return SW_EINTR;
    SW_TRY(sw_cells_around(&cells, &cells.things[k], meets, &all));
  }
  if (g->near_count) qsort(g->near, g->near_count, sizeof *g->near, by_order);
  SW_TRY(SW_GROW(g->listed_at, g->listed_capacity, 3 * s->nodes));
  memcpy(g->listed_at, s->x, 3 * s->nodes * sizeof *s->x);
  g->listed_nodes = s->nodes;
  return SW_OK;
}

/* Adds a vector to the range of vectors. */
static void widen_range(sw_vec v, sw_vec *low, sw_vec *high) {
  *low = sw_v(fmin(low->x, v.x), fmin(low->y, v.y), fmin(low->z, v.z));
  *high = sw_v(fmax(high->x, v.x), fmax(high->y, v.y), fmax(high->z, v.z));
}

/* Returns a bound of the difference between two of the vectors a - b of nodes that take part; b:
 * NULL for 0. Common motion does not count. */
static double largest_difference(const sw_grains *g, const sw_system *s, const double *a,
                                 const double *b) {
  sw_vec low = sw_v(HUGE_VAL, HUGE_VAL, HUGE_VAL), high = sw_neg(low);
  double most = 0;
  for (size_t k = 0; k < s->body_count; k++) {
    const sw_body *body = &s->bodies[k];
    if (!sw_mutual_takes_part(&g->m, k)) continue;
    for (size_t i = body->first_node; i < body->first_node + body->plan->nodes; i++) {
      const sw_vec v = b ? sw_sub(sw_vec_at(a, i), sw_vec_at(b, i)) : sw_vec_at(a, i);
      most = fmax(most, sw_norm2(v));
      widen_range(v, &low, &high);
    }
  }
  return most > 0 ? fmin(2.0 * sqrt(most), sw_dist(low, high)) : 0.0;
}

/* The list reaches further than a step needs, by this share of the largest sum of radii, if it then
 * lasts for SOME_STEPS steps [-]. With twice and half of the share crossing tubes take as long,
 * within 10 %. */
static const double SPARE = 0.25, SOME_STEPS = 4.0;
/* A list that reaches this many times further than needed is made anew: a failed step that threw
 * things far left one that made all later steps ten times slower [-]. */
static const double TOO_WIDE = 4.0;

static sw_status list(sw_grains *g, const sw_system *s) {
  double reach = 0;
  for (size_t k = 0; k < s->body_count; k++)
    if (sw_mutual_takes_part(&g->m, k)) reach = fmax(reach, 2.0 * sw_thing_radius(&s->bodies[k]));
  const double speed = g->m.h > 0 ? largest_difference(g, s, s->v, NULL) : 0.0;
  const double gap = reserve_of(g, reach, speed), spare = SPARE * reach;
  const double wanted = gap + (SOME_STEPS * g->m.h * speed < spare ? spare : 0.0);
  if (g->listed_nodes == s->nodes && g->listed_gap < TOO_WIDE * (wanted + spare) &&
      gap + largest_difference(g, s, s->x, g->listed_at) < g->listed_gap)
    return SW_OK;
  return list_anew(g, s, wanted);
}

static sw_status find_pairs(sw_grains *g, const sw_system *s) {
  double at[2];
  SW_TRY(list(g, s));
  for (size_t i = 0; i < g->near_count; i++) {
    const sw_grain_near *n = &g->near[i];
    sw_grain_pair k = {.of = n->of, .reach = n->reach};
    const double gap = sw_grain_nearest(s->x, &k.of, at) - k.reach;
    if (!(gap < reserve_of(g, k.reach, sw_ends_speed(s, &k.of)))) continue;
    k.usual = hardness(g, s, &k.of);
    k.held = sw_ends_held(s, &k.of);
    SW_TRY(SW_GROW(g->pairs, g->pair_capacity, g->m.pair_count + 1));
    g->pairs[g->m.pair_count++] = k;
  }
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
  SW_TRY(find_pairs(g, s));
  for (size_t i = 0; i < m->pair_count; i++)
    if (!g->pairs[i].held) SW_TRY(plan_links(s, &g->pairs[i].of));
  return SW_OK;
}
