/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of contact between wires. */
#ifndef SW_CONTACT_PAIR_H
#define SW_CONTACT_PAIR_H

#include <stdint.h>

#include "contact/bow.h"
#include "contact/law.h"
#include "contact/pairs.h"
#include "contact/spot.h"

/* Two segments, by their first nodes in the system's arrays; one < two. */
typedef struct sw_near {
  uint32_t one, two;
  uint32_t body[2];
  double distance; /* of the axes at the step's start, or less [m] */
  double known;    /* when it was last measured [m] */
  double travel;   /* of the four nodes together until then [m] */
  double bulge;    /* their smooth curves stand off them by so much together, as known then [m] */
} sw_near;

enum { SW_NO_PAIR = UINT32_MAX };

/* Segments that may touch in this step. */
typedef struct sw_pair {
  uint32_t one, two;
  uint32_t body[2];
  uint32_t before, after; /* pairs of the segment before one or after it with two, or SW_NO_PAIR */
  uint32_t memory[3]; /* where memory of two, or of the segment before it, begins: with the segment
                         before one, one itself, the one after it */
  int parallel;       /* nearly, at the step's start */
  int bridged;        /* they may touch in the step: in the matrix from its start */
  int held;           /* all four nodes are: no force */
  int smooth;         /* 1: they cross, and their smooth curves meet; 0: their chords do */
  double firm[2];     /* how firmly a touch then keeps to the middle of each segment [-] */
  double lone[2];     /* 1: the wire is hardly bent there; 0: it goes round the other one [-] */
  double reach;       /* sum of the radii [m] */
  double usual;       /* stiffness of a new touch [N/m] */
  size_t last, last_end; /* its touches of the iterate before */
} sw_pair;

/* Where wires cross they touch at their nearest places; where they lie along each other, nodes of
 * both do at the places nearest to them. */
typedef enum sw_pair_kind { SW_CROSSING, SW_NODE_OF_ONE, SW_NODE_OF_TWO } sw_pair_kind;

typedef struct sw_pair_touch {
  uint32_t pair; /* number in the list of pairs */
  sw_pair_kind kind;
  size_t stage;    /* in which it was found */
  double at[2];    /* along the segments [-] */
  sw_bow bow[2];   /* as places of the wires */
  int slides[2];   /* 1: the place along that segment follows the nearest points */
  int far;         /* 1: too far from its last place for its force to be known */
  int barred;      /* kept on its side by a barrier */
  int emerges;     /* the wires were placed in each other here, and still come out */
  double stiffer;  /* its stiffness from the next iterate on [N/m] */
  double aslant;   /* what a barrier's fixed normal takes off the distance [m] */
  double forgiven; /* part of the true depth left out of the gap in this step [m] */
  double let_out;  /* part of the true depth that nothing explains and this step ends [m] */
  double steady;   /* normal force that it had had for a while at the step's start [N] */
  sw_vec square;   /* its normal, were it not leaning [-] */
  sw_press press;  /* its normal is towards segment one */
} sw_pair_touch;

/* Kept between steps. */
typedef struct sw_pair_memory {
  uint32_t one, two;
  sw_pair_kind kind;
  double at[2];
  double normal_force, depth, k; /* [N], [m], [N/m] */
  double steady;                 /* normal force that it has had for a while [N] */
  sw_vec normal;                 /* [-] */
  sw_vec elastic;                /* displacement of the friction spring [m] */
  int sliding, emerges;
  int smooth; /* as the pair was */
} sw_pair_memory;

/* Segments kept on one side of each other for the rest of the step. */
typedef struct sw_pair_barrier {
  uint32_t one, two;
  double at[2];
  sw_vec normal;
} sw_pair_barrier;

struct sw_pairs {
  sw_pair_rule *rules;
  size_t bodies;
  sw_contact_regime regime;
  double h, nominal;      /* [s] */
  size_t stage;           /* number of the stage, counted all along */
  double first;           /* share of the step's first stage in what this one begins from [-] */
  double *base_stiffness; /* (bodies) for the forces of each [N/m] */
  double *edge;           /* (bodies) the longest of each [m] */
  sw_rubbing *rubbing;    /* (bodies) of each one's touches, after an update */
  int updates;            /* of the stage so far [-] */
  double *largest;        /* (bodies) normal force that its friction takes as given [N] */
  double rate2;           /* stiffness per mass [1/s2] */

  /* segments near each other, for many steps */
  sw_near *near;
  size_t near_count, near_capacity;
  double *listed_at; /* (nodes x 3) positions that the list was made for [m] */
  size_t listed_nodes, listed_capacity;
  double listed_reach; /* gap up to which it is complete there [m] */
  double *before;      /* (nodes x 3) positions at the last step's start [m] */
  double *travel;      /* (nodes) length of the way since the list was made [m] */
  void *grid;          /* work of the search */
  size_t grid_capacity;

  sw_pair *pairs;
  size_t pair_count, pair_capacity;
  sw_pair_touch *touches, *last; /* of this iterate and of the one before */
  size_t touch_count, touch_capacity, last_count, last_capacity;
  sw_spots spots;         /* work of the refinement */
  sw_pair_touch *pressed; /* with a force at the end of a stage of this trial */
  size_t pressed_count, pressed_capacity;
  sw_pair_memory *memory, *next_memory;
  size_t memory_count, memory_capacity, next_count, next_capacity;
  sw_pair_barrier *barriers;
  size_t barrier_count, barrier_capacity;
  size_t impact_count;  /* places that struck in this step */
  double fall;          /* that gravity closes in the step, with reserve [m] */
  double least_left;    /* minus the least gap of segments not chosen [m] */
  double least_reserve; /* gap up to which all are chosen in this step [m] */
};

/* Make the list of near segments anew when it does not cover gaps up to reach. */
sw_status sw_pairs_list(sw_pairs *pairs, const sw_system *system, double reach);

/* Choose those that may touch in the step. */
sw_status sw_pairs_choose(sw_pairs *pairs, sw_system *system);

/* Add a touch's force on segment one, and its opposite on segment two, at positions y; K
 * (upper half) is its stiffness, NULL = no stiffness wanted. */
sw_status sw_pair_add(sw_system *system, const sw_pair *pair, const sw_pair_touch *touch,
                      const double *y, sw_vec force, const double *K);

/* The pairs were chosen: where each finds its neighbours and its memory. */
void sw_pairs_match(sw_pairs *pairs);
/* Of a place on two wires: the nearest one remembered, within a segment on both, or NULL. */
const sw_pair_memory *sw_pair_recall(const sw_pairs *pairs, const sw_pair *pair, const double at[2],
                                     sw_pair_kind kind);
/* The same touch in the iterate before, or NULL. */
const sw_pair_touch *sw_pair_last(const sw_pairs *pairs, const sw_pair *pair, const double at[2],
                                  sw_pair_kind kind);
/* How far places along segments of pairs are from each other, along both wires together, in edges
 * [-]. */
double sw_pair_between(const sw_pair *pair, const double at[2], const sw_pair *other,
                       const double there[2]);
/* Two places along segments of pairs are one. */
int sw_pair_is_same(const sw_pair *pair, const double at[2], const sw_pair *other,
                    const double there[2]);

/* Nearest points of two segments: places along them, distance returned [m]. */
double sw_segments_nearest(sw_vec a0, sw_vec a1, sw_vec b0, sw_vec b1, double at[2]);

/* The second derivative of half the squared distance by a place along a wire [m2]: of its slope
 * squared, its bend along the distance, and how firmly it keeps to the middle of its edge [m2],
 * [m2], [-]. */
double sw_pair_rise(double along2, double bends, double firm);

/* Say why looking for pairs failed. */
sw_status sw_pairs_fail(sw_status status, sw_error *err);

static inline const sw_pair_rule *sw_pair_rule_of(const sw_pairs *p, const uint32_t body[2]) {
  return &p->rules[p->bodies * body[0] + body[1]];
}

/* The material at a touch: place on wire one minus that on two. */
static inline sw_vec sw_pair_apart(const double *x, const sw_bow bow[2]) {
  return sw_sub(sw_bow_place(x, &bow[0]), sw_bow_place(x, &bow[1]));
}

#endif
