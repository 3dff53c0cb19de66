/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of joined wires near their joins, and near those that were released. */
#include <math.h>

#include "base/alloc.h"
#include "base/each.h"
#include "system/join.h"

/* Returns the length along the wire from the edge that starts at a node to another node; infinite
 * on another wire [m]. */
static double along(const sw_system *s, uint32_t edge, uint32_t node) {
  const sw_body *b = &s->bodies[sw_system_body_of(s, edge)];
  if (node < b->first_node || node >= b->first_node + b->plan->nodes) return HUGE_VAL;
  const double *at = b->plan->s + (edge - b->first_node), to = b->plan->s[node - b->first_node];
  return to < at[0] ? at[0] - to : to > at[1] ? to - at[1] : 0.0;
}

/* Along both wires within this distance from a join, over the sum of their radii, contact between
 * them is ignored [-]. */
static const double AT_A_JOIN = 4.0;

static double radius_at(const sw_system *s, uint32_t node) {
  return s->bodies[sw_system_body_of(s, node)].plan->beam.radius;
}

static double reach_of(const sw_system *s, uint32_t one, uint32_t two) {
  return AT_A_JOIN * (radius_at(s, one) + radius_at(s, two));
}

/* 1 if the edges from nodes one and two are within reach of nodes i and j, each of one wire. */
static int are_near(const sw_system *s, uint32_t one, uint32_t two, uint32_t i, uint32_t j,
                    double reach) {
  if (along(s, one, i) <= reach && along(s, two, j) <= reach) return 1;
  return along(s, one, j) <= reach && along(s, two, i) <= reach;
}

int sw_joins_near(const sw_system *s, uint32_t one, uint32_t two) {
  const struct sw_joins *all = s->joins;
  const double reach = all ? reach_of(s, one, two) : 0;
  for (size_t k = 0; all && k < all->spring_count; k++) {
    const sw_join_spring *p = &all->springs[k];
    if (p->tie) continue; /* tied wires lie on each other */
    if (are_near(s, one, two, p->i, p->j, reach)) return 1;
  }
  return 0;
}

sw_status sw_system_add_parted(sw_system *s, uint32_t i, uint32_t j) {
  SW_TRY(SW_GROW(s->parted, s->parted_capacity, s->parted_count + 1));
  s->parted[s->parted_count++] = (struct sw_parted){i, j};
  return SW_OK;
}

/* Axes of wires nearer than this share of the sum of their radii are in each other [-]. */
static const double IN = 0.5;

size_t sw_joins_still_in(const sw_system *s) {
  size_t count = 0;
  SW_ITEMS(const struct sw_parted, p, s->parted, s->parted_count) {
    const double apart = sw_dist(sw_vec_at(s->x, p->i), sw_vec_at(s->x, p->j));
    count += apart < IN * (radius_at(s, p->i) + radius_at(s, p->j));
  }
  return count;
}

int sw_joins_were_near(const sw_system *s, uint32_t one, uint32_t two) {
  if (!s->parted_count) return 0;
  const double reach = reach_of(s, one, two);
  SW_ITEMS(const struct sw_parted, p, s->parted, s->parted_count) {
    if (are_near(s, one, two, p->i, p->j, reach)) return 1;
  }
  return 0;
}
