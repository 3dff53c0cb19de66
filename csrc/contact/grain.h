/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of contact of objects of particles. */
#ifndef SW_CONTACT_GRAIN_H
#define SW_CONTACT_GRAIN_H

#include "contact/grains.h"
#include "contact/joined.h"
#include "contact/law.h"
#include "contact/pair.h"

/* Two things that may touch, each a particle or a wire's node (node == end), or an edge of an
 * object's surface or a wire's segment between two of them. In the system's arrays; a point comes
 * first. */
typedef struct sw_grain_pair {
  uint32_t node[2], end[2];
  uint32_t body[2];
  double reach; /* sum of the radii [m] */
  double usual; /* stiffness of a new touch [N/m] */
  int held;     /* all nodes are: no force */
} sw_grain_pair;

typedef struct sw_grain_touch {
  sw_grain_pair pair;
  double at[2];    /* along both [-] */
  double stiffer;  /* its stiffness from the next iterate on [N/m] */
  double forgiven; /* part of the true depth left out of the gap in this step [m] */
  double let_out;  /* part of the true depth that nothing explains and this step ends [m] */
  size_t stage;    /* in which it was found; 0: not found in this iterate */
  int slides[2];   /* 1: the place there follows the nearest point */
  int barred;      /* both got through each other since the step's start: it keeps its side */
  sw_press press;  /* its normal is towards the first */
} sw_grain_touch;

struct sw_grains {
  sw_pair_rule *rules; /* (bodies x bodies) only those that count here */
  size_t bodies;
  sw_joined *joined; /* (bodies) of objects that touch themselves */
  sw_contact_regime regime;
  double h, nominal;    /* [s] */
  size_t stage;         /* number of the stage, counted all along */
  int updates;          /* of the stage so far [-] */
  double first;         /* share of the step's first stage in what this one begins from [-] */
  double *base;         /* (bodies) stiffness for the forces of each [N/m] */
  double *largest;      /* (bodies) normal force that its friction takes as given [N] */
  double rate2;         /* stiffness per mass [1/s2] */
  double fall;          /* that gravity closes in the step, with reserve [m] */
  double least_reserve; /* gap up to which all are chosen in this step [m] */
  sw_grain_pair *pairs; /* of this step, in order */
  size_t pair_count, pair_capacity;
  sw_grain_touch *now, *last; /* (pair_count) of this iterate and of the one before */
  size_t now_capacity, last_capacity;
  sw_grain_touch *memory; /* of the last accepted state, in order */
  size_t memory_count, memory_capacity;
  int looked;  /* 1: now is of this step */
  int struck;  /* 1: the step is one that does not bounce */
  size_t hits; /* places at which it was struck [-] */
  void *grid;  /* work of the search */
  size_t grid_capacity;
};

/* Choose what may touch in the step. */
sw_status sw_grains_choose(sw_grains *grains, sw_system *system);

/* Find this iterate's touches at positions y. */
sw_status sw_grains_look(sw_grains *grains, const sw_system *system, const double *y);

/* Add a touch's force, and its opposite, at positions y; K (upper half) is its stiffness, NULL = no
 * stiffness wanted. */
sw_status sw_grain_add(sw_system *system, const sw_grain_touch *touch, const double *y,
                       sw_vec force, const double *K);

/* Order of pairs; before: 1 when p comes first. */
int sw_grain_order(const sw_grain_pair *p, const sw_grain_pair *q);

static inline const sw_pair_rule *sw_grain_rule(const sw_grains *g, const uint32_t body[2]) {
  return &g->rules[g->bodies * body[0] + body[1]];
}

/* The place on the first minus that on the second. */
static inline sw_vec sw_grain_apart(const double *x, const sw_grain_pair *k, const double at[2]) {
  return sw_sub(sw_lerp(sw_vec_at(x, k->node[0]), sw_vec_at(x, k->end[0]), at[0]),
                sw_lerp(sw_vec_at(x, k->node[1]), sw_vec_at(x, k->end[1]), at[1]));
}

/* Nearest places of both at positions x; their distance [m]. */
static inline double sw_grain_nearest(const double *x, const sw_grain_pair *k, double at[2]) {
  const double d = sw_segments_nearest(sw_vec_at(x, k->node[0]), sw_vec_at(x, k->end[0]),
                                       sw_vec_at(x, k->node[1]), sw_vec_at(x, k->end[1]), at);
  if (k->node[0] == k->end[0]) at[0] = 0;
  if (k->node[1] == k->end[1]) at[1] = 0;
  return d;
}

/* The nearest place along the segment to a point, beyond its ends too [-]. */
static inline double sw_grain_along(const double *x, uint32_t point, uint32_t from, uint32_t to) {
  const sw_vec u = sw_sub(sw_vec_at(x, to), sw_vec_at(x, from));
  const double uu = sw_norm2(u);
  return uu > 0 ? sw_dot(u, sw_sub(sw_vec_at(x, point), sw_vec_at(x, from))) / uu : 0.0;
}

#endif
