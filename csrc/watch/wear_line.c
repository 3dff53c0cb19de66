/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads of the places of a line: tensions of its edges, bends of its hinges and beside clamps and
 * joints. */
#include <math.h>

#include "base/each.h"
#include "body/side.h"
#include "read/extremes.h"
#include "state/clamp.h"
#include "state/hinge.h"
#include "watch/wear.h"

uint64_t sw_wear_holds(const sw_body *b) {
  uint64_t sum = sw_sum(SW_SUM_START, &b->plan->clamp_count, sizeof b->plan->clamp_count);
  SW_ITEMS(const sw_clamp_hinge, h, b->plan->clamps, b->plan->clamp_count) {
    const size_t own[3] = {h->node, (size_t)h->hold, (size_t)(h->side + 1)};
    sum = sw_sum(sum, own, sizeof own);
  }
  return sum | 1;
}

static size_t edge_of(const sw_plan *p, const sw_bent_side *sides, size_t k) {
  if (k >= p->nodes) return sides[k - p->nodes].edge;
  return k < p->edges ? k : p->edges - 1;
}

/* Returns the curvature at a place, as a vector across the place's edge towards the bend [1/m]. */
static sw_vec bend_of(const sw_system *s, const sw_body *b, const sw_bent_side *sides, size_t k) {
  const sw_plan *p = b->plan;
  if (k >= p->nodes) return sw_scene_side_bend(s, b, &sides[k - p->nodes]);
  if (k == 0 || k + 1 >= p->nodes || !(p->hinge[k] > 0)) return sw_v(0, 0, 0);
  const sw_vec t = sw_field_tangent(&b->field, k),
               change = sw_sub(t, sw_field_tangent(&b->field, k - 1));
  return sw_wear_towards(change, t, 2.0 * asin(fmin(1.0, 0.5 * sw_norm(change))) / p->hinge[k]);
}

/* Returns the direction across the wire at a place: the mean of both edges' directions. */
static sw_vec across_at(const sw_body *b, const sw_bent_side *sides, const sw_vec *across,
                        size_t k) {
  const sw_plan *p = b->plan;
  const size_t e = edge_of(p, sides, k);
  if (k == 0 || k >= p->edges || !(p->hinge[k] > 0)) return across[e];
  const sw_vec before = sw_carry_unit(across[e - 1], sw_field_tangent(&b->field, e - 1),
                                      sw_field_tangent(&b->field, e));
  return sw_unit_or(sw_add(before, across[e]), across[e]);
}

/* Returns the axial force at a place: the mean of both edges; beside a clamp or joint that of
 * its edge. */
static double tension_at(const sw_plan *p, const sw_bent_side *sides, const double *T, size_t k) {
  if (k >= p->nodes) return T[sides[k - p->nodes].edge];
  if (k == 0) return T[0];
  return k < p->edges ? 0.5 * (T[k - 1] + T[k]) : T[p->edges - 1];
}

void sw_wear_count_line(const sw_system *s, const sw_body *b, const sw_bent_side *sides,
                        const double *T, int averaged, sw_wear *wear) {
  const sw_plan *p = b->plan;
  sw_vec *across = wear->across;
  sw_wear_place *start = &wear->places[0];
  const sw_vec t0 = sw_field_tangent(&b->field, 0);
  const sw_vec first =
      start->seen ? sw_carry_unit(start->across, start->tangent, t0) : sw_perpendicular(t0);
  sw_wear_axes(s, b, first, across);
  const uint64_t holds = sw_wear_holds(b);
  const int free_start = !p->clamp_count && !b->spin_block; /* directions start at the first edge */
  if (free_start) start->turn = 0;
  for (size_t k = 0; k < wear->count; k++) {
    const sw_wear_load load = {.tangent = sw_field_tangent(&b->field, edge_of(p, sides, k)),
                               .across = across_at(b, sides, across, k),
                               .bend = bend_of(s, b, sides, k),
                               .tension = tension_at(p, sides, T, k),
                               .averaged = averaged};
    sw_wear_count(wear, k, &load, wear->holds != holds && !(free_start && k == 0));
  }
  wear->holds = holds;
}
