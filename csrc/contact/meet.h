/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of bodies with each other, inside: a touch, its memory, and the functions of a finder of
 * touches. */
#ifndef SW_CONTACT_MEET_H
#define SW_CONTACT_MEET_H

#include <stdint.h>

#include "contact/bow.h"
#include "contact/law.h"
#include "contact/mutual.h"
#include "contact/spot.h"
#include "contact/way.h"

/* Two things that may touch. Each is a segment or edge from node to end, or a point with end =
 * node. In the system's arrays. */
typedef struct sw_ends {
  uint32_t node[2], end[2], body[2];
} sw_ends;

/* Crossing wires touch at their nearest places, and so do particles. Wires along each other touch
 * at the nodes of both, at the places nearest to these. */
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
  int flies;       /* 1: what overlaps here may have flown into each other in the prediction */
  int turns;       /* 1: its force turns with its normal in the linearisation */
  int far;         /* 1: too far from its last place for a known force */
  int barred;      /* kept on its side by a barrier */
  int emerges;     /* 1: placed in each other, and still coming out */
  int known;       /* 1: it pressed at the step's start */
  double reach;    /* sum of the radii [m] */
  double usual;    /* stiffness of a new touch [N/m] */
  double stiffer;  /* its stiffness from the next iterate on [N/m] */
  double aslant;   /* distance lost by the fixed normal of a barrier [m] */
  double forgiven; /* part of the true depth that this step leaves alone [m] */
  double let_out;  /* unexplained part of the true depth that this step ends [m] */
  double steady;   /* steady normal force at the step's start [N] */
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

/* A touch that pressed at the end of a stage and may have struck. */
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
  /* The last search is not valid any more: positions changed by hand. NULL: searches are
   * independent. */
  void (*forget)(sw_mutual *mutual);
  /* Choose those that may touch in the step. */
  sw_status (*choose)(sw_mutual *mutual, sw_system *system);
  /* Find this iterate's touches at positions y. */
  sw_status (*find)(sw_mutual *mutual, const sw_system *system, const double *y);
  /* Choose more pairs if a step to x1 met others: 1 = redo the step, -1 = out of memory. */
  int (*widen)(sw_mutual *mutual, sw_system *system, const double *x1, double h);
  /* 1 = some would pass each other; barriers keep them on their sides from now on. -1 = some pass
   * in spite of barriers: take a smaller step. NULL: touches prevent that. */
  int (*cross)(sw_mutual *mutual, const sw_system *system, const double *x1);
  /* 1 = a step to x1 makes some deeper than allowed. */
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
  int updates, solves;     /* of the stage so far; solves whose update is not made count too [-] */
  int soft;                /* the touches' springs are softer in this solve, by so many powers */
  int calm;                /* 1: the last update moved no touch far that presses */
  double *base;            /* (bodies) stiffness for the forces of each [N/m] */
  double *largest;         /* (bodies) largest normal force that friction uses [N] */
  sw_rubbing *rubbing;     /* (bodies) of each one's touches, after an update */
  double rate2;            /* stiffness per mass [1/s2] */
  double fall;             /* fall by gravity in the step, with reserve [m] */
  double least_reserve;    /* gap up to which all pairs are chosen in this step [m] */
  size_t pair_count;       /* of those chosen */
  size_t barrier_count;    /* barriers, for the rest of the step */
  sw_meet *touches, *last; /* of this iterate and of the one before, in the order of pairs */
  size_t touch_count, touch_capacity, last_count, last_capacity;
  void *grid; /* work of the search for what is near */
  size_t grid_capacity;
  sw_spots spots; /* work of the refinement */
  sw_ways ways;   /* the same */
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

/* Order of pairs: below 0 if p comes first. */
int sw_ends_order(const sw_ends *p, const sw_ends *q);
/* 1: all nodes are held. */
int sw_ends_held(const sw_system *system, const sw_ends *e);
/* The largest relative speed of nodes of both [m/s]. */
double sw_ends_speed(const sw_system *system, const sw_ends *e);

/* A new touch, all zero, not in the list yet; NULL: out of memory. */
sw_meet *sw_meet_new(sw_mutual *mutual);
/* Put it into the list, with everything that follows from its place; gap and normal at positions y.
 * met: memory of the last step, last: the iterate before, or NULL. */
void sw_meet_add(sw_mutual *mutual, const sw_system *system, const double *y, sw_meet *t,
                 double gap, sw_vec normal, const sw_met *met, const sw_meet *last);
/* The touches of an iterate are found: the first solves may be with softer springs. */
void sw_mutual_soften(sw_mutual *mutual);
/* If axes passed each other within the iteration, the remembered normal tells: it turns the normal
 * and the sign of the distance. */
void sw_meet_side(const sw_met *m, double reach, sw_vec *normal, double *distance);
/* Places with a gap below this share of the sum of radii are listed, so that a new touch finds its
 * state of the iterate before [-]. */
#define SW_LISTED_GAP 0.25

/* Add a touch's force to the first body and its opposite to the second one, at positions y; K
 * (upper half): stiffness, NULL = not wanted. */
sw_status sw_meet_push(sw_system *system, const sw_meet *touch, const double *y, sw_vec force,
                       const double *K);
/* The same of a force on one body at a place. */
void sw_meet_push_one(sw_body *body, const sw_mean *at, sw_vec force, const double *K);

/* Nearest points of two segments: places along them, distance returned [m]. */
double sw_segments_nearest(sw_vec a0, sw_vec a1, sw_vec b0, sw_vec b1, double at[2]);

/* Closing speed of a place in a step of h, beyond the speed that just reaches contact [m/s]. */
double sw_meet_excess(const sw_system *system, const sw_bow bow[2], double reach, sw_vec normal,
                      double h);
/* The second derivative of half the squared distance by the place along a wire [m2]: from its slope
 * squared [m2], its bend along the distance [m2] and its firmness [-]. */
double sw_meet_rise(double along2, double bends, double firm);

#endif
