/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Internal types and functions of contact between wires. */
#ifndef SW_MUTUAL_PAIR_H
#define SW_MUTUAL_PAIR_H

#include "mutual/meet.h"

/* Two segments that are near each other, named by their first nodes in the system's arrays; one <
 * two. */
typedef struct sw_near {
  uint32_t one, two;
  uint32_t body[2];
  double distance; /* lower bound of the axes' distance at the step's start [m] */
  double known;    /* distance when it was last measured [m] */
  double travel;   /* travel of the four nodes together until then [m] */
  double bulge;    /* largest distances of both smooth curves from their segments, added [m] */
  double radii;    /* sum of both wires' radii [m] */
} sw_near;

enum { SW_NO_PAIR = UINT32_MAX };

/* A pair of segments that may touch in this step. */
typedef struct sw_pair {
  uint32_t one, two;
  uint32_t body[2];
  uint32_t before, after; /* numbers of the pairs of segment two with the segment before one and
                             after one, or SW_NO_PAIR */
  uint32_t memory[3];     /* first memory entry of segment two, or of the one before it, with the
                             segment before one, with one itself, and with the segment after one */
  int parallel;           /* 1: nearly parallel at the step's start */
  int bridged; /* 1: the pair is in the matrix from the step's start, because it may touch early in
                  the step */
  int held;    /* 1: all four nodes are held, so there is no force */
  int smooth;  /* 1: they cross, and their smooth curves meet; 0: their chords do */
  double firm[2];        /* if smooth: how firmly a touch stays in the middle of each segment [-] */
  double lone[2];        /* 1: the wire is hardly bent there; 0: it goes round the other one [-] */
  double reach;          /* sum of the radii [m] */
  double usual;          /* stiffness of a new touch [N/m] */
  size_t last, last_end; /* range of its touches of the previous iterate */
} sw_pair;

/* Returns the ends of two segments. */
static inline sw_ends sw_segments(uint32_t one, uint32_t two, const uint32_t body[2]) {
  return (sw_ends){{one, two}, {one + 1, two + 1}, {body[0], body[1]}};
}

/* Segments that are kept on one side of each other for the rest of the step. */
typedef struct sw_pair_barrier {
  uint32_t one, two;
  double at[2];
  sw_vec normal;
} sw_pair_barrier;

typedef struct sw_pairs {
  sw_mutual m;  /* first member: a pointer to it points to this struct too */
  double *edge; /* (bodies) longest edge of each body [m] */

  /* list of near segments, used for many steps */
  sw_near *near;
  size_t near_count, near_capacity;
  double *listed_at; /* (nodes x 3) positions that the list was made for [m] */
  size_t listed_nodes, listed_capacity;
  double listed_reach; /* gap up to which the list is complete with nodes at listed_at [m] */
  double *before;      /* (nodes x 3) positions at the last step's start [m] */
  double *travel;      /* length of each node's path since the list was made [m] */

  sw_pair *pairs; /* (m.pair_count) */
  size_t pair_capacity;
  sw_pair_barrier *barriers; /* (m.barrier_count) */
  size_t barrier_capacity;
  double least_left; /* minus the smallest gap of listed segments that were not chosen [m] */
} sw_pairs;

/* The edge that begins at a node. */
static inline sw_vec sw_edge_at(const double *x, size_t node) {
  return sw_sub(sw_vec_at(x, node + 1), sw_vec_at(x, node));
}

static inline sw_pairs *sw_pairs_of(sw_mutual *m) { return (sw_pairs *)(void *)m; }

/* Makes the list of near segments anew if it does not cover gaps up to reach. */
sw_status sw_pairs_list(sw_pairs *pairs, const sw_system *system, double reach);

/* The largest distance of nodes between two sets of positions [m]. */
double sw_pairs_largest_move(const double *x0, const double *x1, size_t nodes);
/* Sum of two bodies' radii [m]. */
double sw_pair_radii(const sw_system *system, const uint32_t body[2]);

/* See sw_finder. */
sw_status sw_pairs_choose(sw_mutual *pairs, sw_system *system);
sw_status sw_pairs_wake(sw_mutual *pairs, sw_system *system);
sw_status sw_pairs_find(sw_mutual *pairs, const sw_system *system, const double *y);
int sw_pairs_widen(sw_mutual *pairs, sw_system *system, const double *x1, double h);
int sw_pairs_cross(sw_mutual *pairs, const sw_system *system, const double *x1);
int sw_pairs_cuts(const sw_mutual *pairs, const sw_system *system, const double *x1);

/* Lets each chosen pair find its neighbours and its memory. */
void sw_pairs_match(sw_pairs *pairs);
/* Returns the memory nearest to a place on two wires, at most one segment away on both, or NULL. */
const sw_met *sw_pair_recall(const sw_pairs *pairs, const sw_pair *pair, const double at[2],
                             sw_meet_kind kind);
/* Returns the same touch in the previous iterate, or NULL. */
const sw_meet *sw_pair_last(const sw_pairs *pairs, const sw_pair *pair, const double at[2],
                            sw_meet_kind kind);
/* Distance between places of two pairs, along both wires added, in edges [-]. */
double sw_pair_between(const sw_pair *pair, const double at[2], const sw_pair *other,
                       const double there[2]);
/* 1 if places of two pairs are the same touch. */
int sw_pair_is_same(const sw_pair *pair, const double at[2], const sw_pair *other,
                    const double there[2]);

#endif
