/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reviews a step for missed pairs and depths. Segments whose axes come much nearer than their radii
 * allow get a barrier that keeps them on their sides of each other. */
#include <math.h>

#include "base/alloc.h"
#include "base/each.h"
#include "mutual/pairs_sweep.h"
#include "touch/same.h"

static int is_barred(const sw_pairs *p, const sw_pair *k, const double at[2]) {
  const sw_pair_barrier *b = p->barriers;
  for (size_t i = 0; i < p->m.barrier_count; i++)
    if (b[i].one == k->one && b[i].two == k->two && fabs(b[i].at[0] - at[0]) < SW_SAME_TOUCH &&
        fabs(b[i].at[1] - at[1]) < SW_SAME_TOUCH)
      return 1;
  return 0;
}

static int raise_barrier(sw_pairs *p, const sw_pair *k, const double at[2], sw_vec normal) {
  if (SW_GROW(p->barriers, p->barrier_capacity, p->m.barrier_count + 1) != SW_OK) return 0;
  p->barriers[p->m.barrier_count++] = (sw_pair_barrier){k->one, k->two, {at[0], at[1]}, normal};
  return 1;
}

/* If the segments are parallel, removes the part of a distance along them. The nearest points of
 * ends of parallel segments may lie obliquely, where they do not touch. */
static sw_vec square_to(const sw_system *s, const sw_pair *k, sw_vec apart) {
  const sw_vec u = sw_edge_at(s->x, k->one);
  return k->parallel ? sw_madd(apart, u, -sw_dot(apart, u) / fmax(sw_norm2(u), 1e-300)) : apart;
}

int sw_pairs_expect(const sw_mutual *m, const sw_system *s, double h) {
  const sw_pairs *p = (const sw_pairs *)(const void *)m;
  SW_ITEMS(const sw_pair, k, p->pairs, m->pair_count) {
    const sw_ends ends = sw_segments(k->one, k->two, k->body);
    double at[2];
    if (k->held || !(sw_ends_speed(s, &ends) > SW_SLOWEST_IMPACT)) continue;
    sw_segments_nearest(sw_vec_at(s->x, k->one), sw_vec_at(s->x, k->one + 1u),
                        sw_vec_at(s->x, k->two), sw_vec_at(s->x, k->two + 1u), at);
    const sw_bow bow[2] = {sw_bow_chord(k->one, at[0]), sw_bow_chord(k->two, at[1])};
    const sw_vec normal = sw_unit_or(square_to(s, k, sw_bows_apart(s->x, bow)), sw_v(0, 0, 1));
    if (sw_meet_excess(s, bow, k->reach, normal, h) > SW_SLOWEST_IMPACT) return 1;
  }
  return 0;
}

int sw_pairs_cross(sw_mutual *m, const sw_system *s, const double *x1) {
  sw_pairs *p = sw_pairs_of(m);
  int changed = 0;
  SW_ITEMS(const sw_pair, k, p->pairs, m->pair_count) {
    double at[2];
    sw_vec normal;
    if (k->held || !sw_pair_sweep(s, k, s->x, x1, at, &normal)) continue;
    if (is_barred(p, k, at)) return -1;
    changed |= raise_barrier(p, k, at, normal);
  }
  return changed;
}

/* Returns the largest gap at the step's start of segments that were not chosen but touched, passed
 * or overlapped each other; -1 if none did [m]. */
static double missed_gap(const sw_pairs *p, const sw_system *s, const double *x1) {
  const double farthest = 2.0 * sw_pairs_largest_move(s->x, x1, s->nodes);
  double gap = -1;
  size_t k = 0;
  if (farthest <= -p->least_left) return gap;
  SW_ITEMS(const sw_near, n, p->near, p->near_count) {
    if (k < p->m.pair_count && p->pairs[k].one == n->one && p->pairs[k].two == n->two) {
      k++;
      continue;
    }
    const double radii = sw_pair_radii(s, n->body);
    if (n->distance - radii <= gap || n->distance - farthest >= radii) continue;
    const sw_pair as = {.one = n->one, .two = n->two, .reach = radii};
    double at[2];
    sw_vec normal;
    if (n->distance - sw_pair_approach(s, &as, s->x, x1) >= radii) continue;
    if (sw_pair_distance(s, &as, x1) - n->bulge < radii ||
        sw_pair_sweep(s, &as, s->x, x1, at, &normal) || sw_pair_brushes(&as, s->x, x1))
      gap = n->distance - radii;
  }
  return gap;
}

int sw_pairs_widen(sw_mutual *m, sw_system *s, const double *x1, double h SW_UNUSED) {
  sw_pairs *p = sw_pairs_of(m);
  if (2.0 * sw_pairs_largest_move(p->listed_at, x1, s->nodes) > p->listed_reach) {
    if (sw_pairs_list(p, s, 2.0 * sw_pairs_largest_move(s->x, x1, s->nodes)) != SW_OK) return -1;
    p->least_left = 0; /* it knows nothing of pairs that were further away than the list reached */
  }
  const double gap = missed_gap(p, s, x1);
  if (gap < 0) return 0;
  m->least_reserve = 1.01 * gap;
  return sw_mutual_choose(m, s) == SW_OK ? 1 : -1;
}

/* 1 if two bodies press each other, or did at the step's start. Straight paths of their nodes may
 * then cut a bend round which the wires go. */
static int are_pressed(const sw_mutual *m, const sw_pair *k) {
  SW_ITEMS(const sw_meet, t, m->touches, m->touch_count) {
    if (t->press.normal_force > 0 && t->of.body[0] == k->body[0] && t->of.body[1] == k->body[1])
      return 1;
  }
  SW_ITEMS(const sw_met, t, m->memory, m->memory_count) {
    if (t->kept.normal_force > 0 && t->of.body[0] == k->body[0] && t->of.body[1] == k->body[1])
      return 1;
  }
  return 0;
}

int sw_pairs_cuts(const sw_mutual *m, const sw_system *s, const double *x1) {
  const sw_pairs *p = (const sw_pairs *)(const void *)m;
  SW_ITEMS(const sw_pair, k, p->pairs, m->pair_count) {
    const double deeper = SW_DEEPER * k->reach;
    if (k->held || sw_pair_approach(s, k, s->x, x1) < deeper) continue;
    if (sw_pair_brushes(k, s->x, x1) && !are_pressed(m, k)) return 1;
    const double after = sw_pair_distance(s, k, x1);
    if (after < k->reach - deeper && after < sw_pair_distance(s, k, s->x) - deeper) return 1;
  }
  return 0;
}
