/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of contact of things with each other: a place where two of them meet, what is
 * remembered of it, and what all such places have in common. */
#ifndef SW_CONTACT_MEET_H
#define SW_CONTACT_MEET_H

#include <stdint.h>

#include "contact/bow.h"
#include "contact/law.h"
#include "contact/mutual.h"
#include "contact/spot.h"

/* Two things that may touch, each a segment or edge from a node to its end, or a point, which is
 * its own end. In the system's arrays. */
typedef struct sw_ends {
  uint32_t node[2], end[2], body[2];
} sw_ends;

/* Where wires cross they touch at their nearest places; where they lie along each other, nodes of
 * both do at the places nearest to them. Particles meet as what crosses. */
typedef enum sw_meet_kind { SW_CROSSING, SW_NODE_OF_ONE, SW_NODE_OF_TWO } sw_meet_kind;

typedef struct sw_meet {
  sw_ends of;
  uint32_t pair; /* number in the finder's list of those that may touch in the step */
  sw_meet_kind kind;
  size_t stage;    /* in which it was found */
  double at[2];    /* along both, from node to end [-] */
  sw_bow bow[2];   /* as places that depend on nodes */
  int slides[2];   /* 1: the place there follows the nearest points */
  double firm[2];  /* how firmly it then keeps to the middle of each segment [-] */
  int far;         /* 1: too far from its last place for its force to be known */
  int barred;      /* kept on its side by a barrier */
  int emerges;     /* they were placed in each other here, and still come out */
  double reach;    /* sum of the radii [m] */
  double usual;    /* stiffness of a new touch [N/m] */
  double stiffer;  /* its stiffness from the next iterate on [N/m] */
  double aslant;   /* what a barrier's fixed normal takes off the distance [m] */
  double forgiven; /* part of the true depth left out of the gap in this step [m] */
  double let_out;  /* part of the true depth that nothing explains and this step ends [m] */
  double steady;   /* normal force that it had had for a while at the step's start [N] */
  sw_vec square;   /* its normal, were it not leaning [-] */
  sw_press press;  /* its normal is towards the first */
} sw_meet;

/* Kept between steps. */
typedef struct sw_met {
  sw_ends of;
  sw_meet_kind kind;
  double at[2];
  sw_kept kept;
  sw_vec normal; /* [-] */
  int emerges;
  int smooth; /* 1: smooth curves met there */
} sw_met;

/* What pressed at the end of a stage and may have struck. */
typedef struct sw_hit {
  sw_bow bow[2];
  sw_vec normal;
  double reach; /* [m] */
} sw_hit;

/* What finds the places where things touch. */
typedef struct sw_finder {
  const char *name, *too_many; /* of messages */
  sw_status (*make)(const sw_system *system, const sw_pair_rule *rules, sw_mutual **out);
  void (*free)(sw_mutual *mutual); /* what is its own */
  /* What was found depends on what came before, which is another thing now. NULL: it does not. */
  void (*forget)(sw_mutual *mutual);
  /* Choose those that may touch in the step. */
  sw_status (*choose)(sw_mutual *mutual, sw_system *system);
  /* Find this iterate's touches at positions y. */
  sw_status (*find)(sw_mutual *mutual, const sw_system *system, const double *y);
  /* Choose among more when some were missed in a step to x1: 1 = it is to be redone, -1 = out of
   * memory. */
  int (*widen)(sw_mutual *mutual, sw_system *system, const double *x1, double h);
  /* 1 = some would get through each other and are kept on their sides from now on; -1 = they would
   * although they were: only a smaller step helps. NULL: touches see to that. */
  int (*cross)(sw_mutual *mutual, const sw_system *system, const double *x1);
  /* 1 = a step to x1 leaves some deeper in each other than it may. */
  int (*cuts)(const sw_mutual *mutual, const sw_system *system, const double *x1);
  /* Before touches of a step are remembered. NULL: there is nothing to do. */
  void (*note)(const sw_mutual *mutual, const sw_system *system, const sw_meet *touch, sw_met *out);
} sw_finder;

struct sw_mutual {
  const sw_finder *finder;
  sw_pair_rule *rules; /* (bodies x bodies) */
  size_t bodies;
  sw_contact_regime regime;
  double h, nominal;       /* [s] */
  size_t stage;            /* number of the stage, counted all along */
  double first;            /* share of the step's first stage in what this one begins from [-] */
  int updates;             /* of the stage so far [-] */
  double *base;            /* (bodies) stiffness for the forces of each [N/m] */
  double *largest;         /* (bodies) normal force that its friction takes as given [N] */
  sw_rubbing *rubbing;     /* (bodies) of each one's touches, after an update */
  double rate2;            /* stiffness per mass [1/s2] */
  double fall;             /* that gravity closes in the step, with reserve [m] */
  double least_reserve;    /* gap up to which all are chosen in this step [m] */
  size_t pair_count;       /* of those chosen */
  size_t barrier_count;    /* of what keeps some on their sides for the rest of the step */
  sw_meet *touches, *last; /* of this iterate and of the one before, in the order of pairs */
  size_t touch_count, touch_capacity, last_count, last_capacity;
  void *grid; /* work of the search for what is near */
  size_t grid_capacity;
  sw_spots spots; /* work of the refinement */
  sw_hit *hits;   /* at the end of stages of this trial */
  size_t hit_count, hit_capacity;
  size_t struck;                /* places that struck in this step */
  sw_met *memory, *next_memory; /* in the order of sw_ends_order */
  size_t memory_count, memory_capacity, next_count, next_capacity;
};

/* Begin an empty one with the bodies' rules; SW_ENOMEM leaves it to be freed. */
sw_status sw_mutual_start(sw_mutual *mutual, const sw_finder *finder, const sw_pair_rule *rules,
                          size_t bodies);
/* 1: by some rule the body touches anything. */
int sw_mutual_takes_part(const sw_mutual *mutual, size_t body);
static inline const sw_pair_rule *sw_mutual_rule(const sw_mutual *m, const uint32_t body[2]) {
  return &m->rules[m->bodies * body[0] + body[1]];
}
/* Choose anew what may touch in the step. */
sw_status sw_mutual_choose(sw_mutual *mutual, sw_system *system);

/* Order of what may touch: below 0 when p comes first. */
int sw_ends_order(const sw_ends *p, const sw_ends *q);
/* 1: all nodes are held. */
int sw_ends_held(const sw_system *system, const sw_ends *e);
/* The fastest that nodes of both go against each other [m/s]. */
double sw_ends_speed(const sw_system *system, const sw_ends *e);

/* A new touch, all zero, that is not in the list yet; or NULL: there is no room. */
sw_meet *sw_meet_new(sw_mutual *mutual);
/* It is in the list, with all that its place tells; gap and normal at positions y. met, last: what
 * it was at the step before and in the iterate before, or NULL. */
void sw_meet_add(sw_mutual *mutual, const sw_system *system, const double *y, sw_meet *t,
                 double gap, sw_vec normal, const sw_met *met, const sw_meet *last);
/* Axes that have got through each other within the iteration are told by the remembered normal,
 * which turns theirs and the distance round. */
void sw_meet_side(const sw_met *m, double reach, sw_vec *normal, double *distance);
/* Places nearer than this share of the radii's sum are in the list of touches, so that what begins
 * to touch finds its state of the iterate before [-]. */
#define SW_LISTED_GAP 0.25

/* Add a touch's force on the first thing, and its opposite on the second one, at positions y; K
 * (upper half) is its stiffness, NULL = no stiffness wanted. */
sw_status sw_meet_push(sw_system *system, const sw_meet *touch, const double *y, sw_vec force,
                       const double *K);
/* The same of a force on one body alone, at a place of it. */
void sw_meet_push_one(sw_body *body, const sw_mean *at, sw_vec force, const double *K);

/* Nearest points of two segments: places along them, distance returned [m]. */
double sw_segments_nearest(sw_vec a0, sw_vec a1, sw_vec b0, sw_vec b1, double at[2]);

/* How fast a place is passed through in a step of h, beyond just being reached [m/s]. */
double sw_meet_excess(const sw_system *system, const sw_bow bow[2], double reach, sw_vec normal,
                      double h);
/* The second derivative of half the squared distance by a place along a wire [m2]: of its slope
 * squared, its bend along the distance, and how firmly it keeps to the middle of its edge [m2],
 * [m2], [-]. */
double sw_meet_rise(double along2, double bends, double firm);

#endif
