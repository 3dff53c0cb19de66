/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Internal types and functions of contact of objects of particles and meshes. */
#ifndef SW_MUTUAL_GRAIN_H
#define SW_MUTUAL_GRAIN_H

#include "mutual/joined.h"
#include "mutual/meet.h"

/* A pair that may touch. Each thing is a particle, a wire's node, an edge of a surface or a wire's
 * segment. A point comes first. */
typedef struct sw_grain_pair {
  sw_ends of;
  double reach;  /* sum of the radii [m] */
  double usual;  /* stiffness of a new touch [N/m] */
  int held;      /* 1: all nodes are held, so there is no force */
  uint32_t last; /* its touch in the previous iterate: number + 1, or 0 */
} sw_grain_pair;

/* Two things near each other, not joined. */
typedef struct sw_grain_near {
  sw_ends of;
  double reach; /* sum of the radii [m] */
} sw_grain_near;

typedef struct sw_grains {
  sw_mutual m;          /* first member: a pointer to it points to this struct too */
  int loose;            /* 1: an object of particles is among the bodies */
  sw_joined *joined;    /* (bodies) joined particles of objects that touch themselves */
  sw_grain_pair *pairs; /* (m.pair_count) pairs of this step, in order */
  size_t pair_capacity;

  /* list of things near each other, in order, used for many steps */
  sw_grain_near *near;
  size_t near_count, near_capacity;
  double *listed_at; /* (listed_nodes x 3) positions that the list was made for [m] */
  size_t listed_nodes, listed_capacity;
  double listed_gap; /* gap up to which the list is complete with nodes at listed_at [m] */
} sw_grains;

static inline sw_grains *sw_grains_of(sw_mutual *m) { return (sw_grains *)(void *)m; }

/* See sw_finder. */
sw_status sw_grains_choose(sw_mutual *grains, sw_system *system);
sw_status sw_grains_find(sw_mutual *grains, const sw_system *system, const double *y);

/* Finds the nearest places of both things at positions x. Returns their distance [m]. */
static inline double sw_grain_nearest(const double *x, const sw_ends *e, double at[2]) {
  const double d = sw_segments_nearest(sw_vec_at(x, e->node[0]), sw_vec_at(x, e->end[0]),
                                       sw_vec_at(x, e->node[1]), sw_vec_at(x, e->end[1]), at);
  if (e->node[0] == e->end[0]) at[0] = 0;
  if (e->node[1] == e->end[1]) at[1] = 0;
  return d;
}

#endif
