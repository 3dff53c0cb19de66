/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of an iterate between particles and other things: where they are, and what they
 * remember. */
#include <math.h>

#include "base/halving.h"
#include "base/interrupt.h"
#include "mutual/grain.h"
#include "mutual/pairs_sweep.h"
#include "touch/same.h"

static size_t first_memory(const sw_mutual *m, const sw_ends *e) {
  size_t i;
  SW_FIRST_NOT(sw_ends_order(&m->memory[i].of, e) < 0, i, 0, m->memory_count);
  return i;
}

/* Returns the memory of the same pair; for a place on a wire the nearest memory, up to one segment
 * away. */
static const sw_met *recall(const sw_mutual *m, const sw_system *s, const sw_ends *e,
                            const double at[2]) {
  const int wire = e->node[1] != e->end[1] && !s->bodies[e->body[1]].plan->web;
  const sw_met *best = NULL;
  sw_ends from = *e;
  double nearest = 1.0;
  if (wire && from.node[1]) from.node[1]--, from.end[1]--;
  for (size_t i = first_memory(m, &from); i < m->memory_count; i++) {
    const sw_met *t = &m->memory[i];
    const sw_ends *k = &t->of;
    if (k->node[0] != e->node[0] || k->end[0] != e->end[0]) break;
    if (k->node[1] > e->node[1] + (wire ? 1u : 0u)) break;
    if (k->body[1] != e->body[1] || (!wire && k->end[1] != e->end[1])) continue;
    const double d = wire ? fabs((double)k->node[1] + t->at[1] - (double)e->node[1] - at[1]) : 0.0;
    if (d < nearest) best = t, nearest = d;
  }
  return best;
}

static double softness(const sw_system *s, const sw_ends *e) {
  double most = 0;
  for (int i = 0; i < 2; i++) {
    const sw_web *w = s->bodies[e->body[i]].plan->web;
    if (w && !w->per_ring) most = fmax(most, (double)w->particles);
  }
  return fmin(SW_SOFTEST, most);
}

/* Returns a new touch of a pair at a place, or NULL. slides: 1 if it follows the nearest places. */
static sw_meet *new_touch(sw_grains *g, const sw_system *s, const sw_grain_pair *k,
                          const double at[2], const sw_bow bow[2], int slides) {
  sw_meet *t = sw_meet_new(&g->m);
  if (!t) return NULL;
  t->of = k->of, t->pair = (uint32_t)(k - g->pairs);
  t->reach = k->reach, t->usual = k->usual;
  t->emerges = 1; /* its depth is reduced as slowly as that of meshes */
  t->press.soft = softness(s, &k->of), t->press.by_place = 1;
  for (int n = 0; n < 2; n++)
    t->at[n] = at[n], t->bow[n] = bow[n], t->slides[n] = slides && at[n] > 0 && at[n] < 1;
  return t;
}

/* --- where -------------------------------------------------------------------------- */

static sw_rods rods_of(const double *x, const sw_ends *e) {
  return (sw_rods){{sw_vec_at(x, e->node[0]), sw_vec_at(x, e->end[0])},
                   {sw_vec_at(x, e->node[1]), sw_vec_at(x, e->end[1])}};
}

/* 1 if both pass through each other on the straight path from x0 to y. Fills the place and the
 * direction just before. */
static int passes(const double *x0, const double *y, const sw_grain_pair *k, double at[2],
                  sw_vec *normal) {
  const sw_rods from = rods_of(x0, &k->of), to = rods_of(y, &k->of);
  double when;
  if (!sw_rods_sweep(&from, &to, k->reach, at, normal, &when)) return 0;
  for (int n = 0; n < 2; n++)
    if (k->of.node[n] == k->of.end[n]) at[n] = 0;
  return 1;
}

/* Edges closer to parallel than this touch along their length; the touches of their points cover
 * that [-]. */
static const double PARALLEL = 1e-3;

static int crosses(const double *y, const sw_ends *k, double at[2]) {
  const sw_vec u = sw_sub(sw_vec_at(y, k->end[0]), sw_vec_at(y, k->node[0]));
  const sw_vec v = sw_sub(sw_vec_at(y, k->end[1]), sw_vec_at(y, k->node[1]));
  if (!(sw_norm2(sw_cross(u, v)) > PARALLEL * sw_norm2(u) * sw_norm2(v))) return 0;
  sw_grain_nearest(y, k, at);
  return at[0] > 0 && at[0] < 1 && at[1] > 0 && at[1] < 1;
}

/* Returns the place along the segment nearest to a point; it may be beyond its ends [-]. */
static double along(const double *x, uint32_t point, uint32_t from, uint32_t to) {
  const sw_vec u = sw_sub(sw_vec_at(x, to), sw_vec_at(x, from));
  const double uu = sw_norm2(u);
  return uu > 0 ? sw_dot(u, sw_sub(sw_vec_at(x, point), sw_vec_at(x, from))) / uu : 0.0;
}

/* Finds the place of touch; 0: it belongs to another pair. Crossing edges touch inside both. A
 * point touches inside the edge. On a wire's segment it may also touch at the first node, if the
 * previous segment does not reach the point, or at the wire's end. */
static int owns(const sw_system *s, const double *y, const sw_ends *k, double at[2]) {
  const sw_body *b = &s->bodies[k->body[1]];
  const uint32_t point = k->node[0], from = k->node[1], to = k->end[1];
  at[0] = at[1] = 0;
  if (point != k->end[0]) return crosses(y, k, at);
  if (from == to) return 1;
  at[1] = along(y, point, from, to);
  if (at[1] > 0 && at[1] < 1) return 1;
  const int beyond = at[1] >= 1;
  at[1] = beyond ? 1 : 0;
  if (b->plan->web) return 0;
  if (beyond) return to + 1 == b->first_node + b->plan->nodes;
  return from == b->first_node || along(y, point, from - 1, from) >= 1;
}

static sw_status find(sw_grains *g, const sw_system *s, const double *y, const sw_grain_pair *k) {
  sw_mutual *m = &g->m;
  const sw_meet *last = k->last ? &m->last[k->last - 1] : NULL;
  double at[2];
  sw_vec normal;
  const int barred = passes(s->x, y, k, at, &normal), own = !barred && owns(s, y, &k->of, at);
  if (!barred && !own) {
    if (!last || !(last->press.normal_force > 0)) return SW_OK;
    at[0] = last->at[0], at[1] = last->at[1]; /* a touch that pushed keeps its place */
  }
  const sw_bow bow[2] = {sw_bow_between(k->of.node[0], k->of.end[0], at[0]),
                         sw_bow_between(k->of.node[1], k->of.end[1], at[1])};
  const sw_vec d = sw_bows_apart(y, bow);
  double distance = barred ? sw_dot(normal, d) : sw_norm(d);
  if (!barred && !(distance < (1.0 + SW_LISTED_GAP) * k->reach)) return SW_OK;
  const sw_met *met = recall(m, s, &k->of, at);
  if (!barred) {
    normal = sw_unit_or(d, met ? met->normal : sw_v(0, 0, 1));
    sw_meet_side(met, k->reach, &normal, &distance);
  }
  sw_meet *t = new_touch(g, s, k, at, bow, own);
  if (!t) return SW_ENOMEM;
  t->barred = barred;
  if (barred) t->aslant = sw_norm(d) - distance;
  sw_meet_add(m, s, y, t, distance - k->reach, normal, met, last);
  return SW_OK;
}

sw_status sw_grains_find(sw_mutual *m, const sw_system *s, const double *y) {
  sw_grains *g = sw_grains_of(m);
  for (size_t i = 0; i < m->pair_count; i++) g->pairs[i].last = 0;
  for (size_t i = 0; i < m->last_count; i++) g->pairs[m->last[i].pair].last = (uint32_t)i + 1;
  for (size_t i = 0; i < m->pair_count; i++) {
    if (sw_interrupted()) return SW_EINTR;
    if (!g->pairs[i].held) SW_TRY(find(g, s, y, &g->pairs[i]));
  }
  return SW_OK;
}
