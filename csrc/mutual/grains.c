/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of objects of particles and meshes with each other and with wires: rules, review of a
 * step, making and freeing. */
#include <math.h>

#include "base/alloc.h"
#include "mutual/cells.h"
#include "mutual/grain.h"
#include "touch/same.h"

/* Keeps only rules with an object of particles or a mesh. 1: there are some. */
static int take_rules(sw_grains *g, const sw_system *s) {
  sw_mutual *m = &g->m;
  int any = 0;
  for (size_t i = 0; i < m->bodies; i++)
    for (size_t j = 0; j < m->bodies; j++) {
      const sw_web *a = s->bodies[i].plan->web, *b = s->bodies[j].plan->web;
      sw_pair_rule *own = &m->rules[m->bodies * i + j];
      own->on &= a || b;
      any |= own->on;
      g->loose |= own->on && ((a && !a->per_ring) || (b && !b->per_ring));
    }
  return any;
}

int sw_grains_have_loose(const sw_mutual *m) { return ((const sw_grains *)(const void *)m)->loose; }

static void free_own(sw_mutual *m) {
  const sw_grains *g = sw_grains_of(m);
  for (size_t b = 0; g->joined && b < m->bodies; b++) sw_joined_free(&g->joined[b]);
  SW_FREE_ALL(g->joined, g->pairs, g->near, g->listed_at);
}

/* --- review ---------------------------------------------------------------------------- */

/* Largest distance of a node from its free flight in the step [m]. The search covers free flight
 * only. */
static double stray(const sw_system *s, const double *x1, double h) {
  double most = 0;
  for (size_t i = 0; i < s->nodes; i++) {
    const sw_vec way = sw_sub(sw_vec_at(x1, i), sw_vec_at(s->x, i));
    most = fmax(most, sw_norm2(sw_madd(way, sw_vec_at(s->v, i), -h)));
  }
  return sqrt(most);
}

static double thinnest(const sw_plan *p) { return p->web ? p->web->skin : p->beam.radius; }

static int widen(sw_mutual *m, sw_system *s, const double *x1, double h) {
  const double needed = 2.0 * stray(s, x1, h);
  double least = HUGE_VAL;
  for (size_t b = 0; b < s->body_count; b++) least = fmin(least, 2.0 * thinnest(s->bodies[b].plan));
  if (!(needed > fmax(SW_LISTED_GAP * least + m->fall, m->least_reserve))) return 0;
  m->least_reserve = SW_RESERVE * needed;
  return sw_mutual_choose(m, s) == SW_OK ? 1 : -1;
}

static int cuts(const sw_mutual *m, const sw_system *s, const double *x1) {
  const sw_grains *g = (const sw_grains *)(const void *)m;
  for (size_t i = 0; i < m->pair_count; i++) {
    const sw_grain_pair *k = &g->pairs[i];
    const double deeper = SW_DEEPER * k->reach;
    double at[2];
    if (k->held) continue;
    const double after = sw_grain_nearest(x1, &k->of, at);
    if (after < k->reach - deeper && after < sw_grain_nearest(s->x, &k->of, at) - deeper) return 1;
  }
  return 0;
}

/* --- life ------------------------------------------------------------------------------ */

static const sw_finder particles = {
    .name = "contact of particles",
    .too_many = "too many are near each other",
    .make = sw_grains_new,
    .free = free_own,
    .choose = sw_grains_choose,
    .find = sw_grains_find,
    .widen = widen,
    .cuts = cuts,
};

sw_status sw_grains_new(const sw_system *s, const sw_pair_rule *rules, sw_mutual **out) {
  const size_t n = s->body_count;
  *out = NULL;
  sw_grains *g = sw_alloc(1, sizeof *g);
  if (!g) return SW_ENOMEM;
  g->joined = sw_alloc(n, sizeof *g->joined);
  sw_status status = sw_mutual_start(&g->m, &particles, rules, n);
  if (!g->joined) status = SW_ENOMEM;
  const int any = status == SW_OK && take_rules(g, s);
  for (size_t b = 0; any && b < n && status == SW_OK; b++)
    if (g->m.rules[n * b + b].on) status = sw_joined_new(s->bodies[b].plan->web, &g->joined[b]);
  if (any && status == SW_OK)
    *out = &g->m;
  else
    sw_mutual_free(&g->m);
  return status;
}
