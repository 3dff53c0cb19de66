/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Internal types and functions of contact of bodies with each other: a touch, its memory, and the
 * functions of a finder of touches. */
#ifndef SW_MUTUAL_MEET_H
#define SW_MUTUAL_MEET_H

#include <stdint.h>

#include "mutual/mutual.h"
#include "touch/bow.h"
#include "touch/drawn.h"
#include "touch/law.h"
#include "touch/spot.h"
#include "touch/tally.h"
#include "touch/way.h"

/* Two things that may touch. Each is a segment or edge from node to end, or a point with end =
 * node. Numbers are those of the system's arrays. */
typedef struct sw_ends {
  uint32_t node[2], end[2], body[2];
} sw_ends;

/* Where two things touch. Crossing wires touch at their nearest places, and so do particles. Wires
 * along each other touch at the nodes of both: each node against the nearest place of the other
 * wire. */
typedef enum sw_meet_kind { SW_CROSSING, SW_NODE_OF_ONE, SW_NODE_OF_TWO } sw_meet_kind;

typedef struct sw_meet {
  sw_ends of;
  uint32_t pair; /* number in the finder's list of pairs that may touch in the step */
  sw_meet_kind kind;
  size_t stage;    /* stage in which the touch was found */
  double at[2];    /* places along both, from node to end [-] */
  sw_bow bow[2];   /* the same places as means of nodes */
  int slides[2];   /* 1: the place follows the nearest points */
  double firm[2];  /* how firmly a sliding place stays in the middle of each segment [-] */
  sw_vec lever[2]; /* tangent of each wire over its edge, times the radius: how far the turn of the
                    * wire moves its surface along it [-] */
  sw_vec eases;    /* direction in which a shift rolls and does not rub, or zero [-] */
  int flies;       /* 1: an overlap here may come from flight of the wires in the prediction */
  int turns;       /* 1: the linearisation includes the turn of its normal */
  int far;         /* 1: too far from its last place for a known force */
  int barred;      /* 1: kept on its side by a barrier */
  int emerges;     /* 1: the wires were placed in each other and still come out */
  int known;       /* 1: it pressed at the step's start */
  double reach;    /* sum of the radii [m] */
  double deepest;  /* allowed depth within a step [m] */
  double usual;    /* stiffness of a new touch [N/m] */
  double stiffer;  /* stiffness from the next iterate on [N/m] */
  double aslant;   /* true distance minus the distance along the fixed normal of a barrier [m] */
  double forgiven; /* part of the true depth that this step does not correct [m] */
  double let_out;  /* unexplained part of the true depth that this step removes [m] */
  double left;     /* rest of `forgiven` after the touch was stiffened [m] */
  int squeezed;    /* 1: stiffened from step to step, not within a step */
  double steady;   /* steady normal force at the step's start [N] */
  sw_vec square;   /* its normal without the lean [-] */
  sw_press press;  /* its normal points towards the first thing */
} sw_meet;

/* Memory of a touch between steps. */
typedef struct sw_met {
  sw_ends of;
  sw_meet_kind kind;
  double at[2];
  sw_kept kept;
  sw_vec normal; /* [-] */
  int emerges;
  int smooth; /* 1: smooth curves met there */
} sw_met;

/* 1 if two wires that a released join kept together touch end on. Ends have round caps here, which
 * overlap there, but a cable that is cut has none: they do not push each other apart. */
int sw_meet_abuts(const sw_system *system, const sw_meet *touch);
/* Makes the memory of a touch at a step's end. */
sw_met sw_meet_remember(const sw_system *system, const sw_meet *touch);
/* Depth below which its stiffness is higher than needed [m]. */
double sw_meet_depth(const sw_meet *touch);

/* A touch that pressed at the end of a stage and may have struck. */
typedef struct sw_hit {
  sw_bow bow[2];
  sw_vec normal;
  double reach; /* [m] */
} sw_hit;

/* A finder of the places where things touch. */
typedef struct sw_finder {
  const char *name, *too_many; /* for messages */
  sw_status (*make)(const sw_system *system, const sw_pair_rule *rules, sw_mutual **out);
  void (*free)(sw_mutual *mutual); /* frees the finder's own data */
  /* Invalidates the last search, because positions were changed by hand. NULL: searches are
   * independent. */
  void (*forget)(sw_mutual *mutual);
  /* Chooses the pairs that may touch in the step. */
  sw_status (*choose)(sw_mutual *mutual, sw_system *system);
  /* Wakes the bodies that may touch one that does not wait. NULL: none waits. */
  sw_status (*wake)(sw_mutual *mutual, sw_system *system);
  /* Finds this iterate's touches at positions y. */
  sw_status (*find)(sw_mutual *mutual, const sw_system *system, const double *y);
  /* Chooses more pairs if a step to x1 met others: 1 = repeat the step, -1 = out of memory. */
  int (*widen)(sw_mutual *mutual, sw_system *system, const double *x1, double h);
  /* 1: some would pass each other; barriers keep them on their sides from now on. -1: some pass in
   * spite of barriers: take a smaller step. NULL: touches prevent passing. */
  int (*cross)(sw_mutual *mutual, const sw_system *system, const double *x1);
  /* 1 if a step to x1 makes touches deeper than allowed. */
  int (*cuts)(const sw_mutual *mutual, const sw_system *system, const double *x1);
  /* Adds to the memory of a touch at a step's end. NULL: there is nothing to add. */
  void (*note)(const sw_mutual *mutual, const sw_system *system, const sw_meet *touch, sw_met *out);
} sw_finder;

/* Finds how much tension the depth of touches takes from wires (mutual/relief.h). */
void sw_mutual_find_taken(sw_mutual *mutual, const sw_system *system);

/* Touches between bodies that wait (mutual/wait.c). */
typedef struct sw_still_meets {
  sw_meet *list, *room; /* in the order of sw_ends_order; room for the next list */
  size_t count, capacity, room_capacity;
  unsigned char *kept; /* (bodies) 1: the body waits; its touches with such are in the list */
  int any;             /* 1: some body waits */
  int accepted;        /* 1: the other touches are those of the accepted state */
  sw_press_sums sums;  /* of the list, which stays as it is for many steps */
} sw_still_meets;

struct sw_mutual {
  const sw_finder *finder;
  sw_pair_rule *rules; /* (bodies x bodies) */
  size_t bodies;
  sw_contact_regime regime;
  double h, nominal;   /* [s] */
  int looks;           /* 1: forces of a state in motion are looked at; nothing moves */
  size_t stage;        /* number of the stage; it grows from step to step */
  double first;        /* share of the step's first stage in the starting state of this stage [-] */
  int updates, solves; /* of the stage so far; also solves whose update is not made [-] */
  int soft;        /* power of SOFTER by which the touches' springs are softer in this solve [-] */
  int more_soft;   /* such solves of the stage beyond the usual number [-] */
  double widest;   /* largest shift of a pressing touch in the last update, over the radii [-] */
  int calm;        /* 1: the last update moved no pressing touch far */
  sw_drawn *drawn; /* (bodies) their stretches between holds */
  double *base;    /* (bodies) stiffness for each body's forces [N/m] */
  double *largest; /* (bodies) largest normal force that friction uses [N] */
  double *turns;   /* (edges) what sw_system_turns gives at this evaluation [rad] */
  size_t turns_capacity;
  char *turned; /* (bodies) 1: the body's turns are there; 2: it has none; 0: not asked for */
  sw_rubbing *rubbing;     /* (bodies) friction of each body's touches, after an update */
  double rate2;            /* stiffness per mass [1/s2] */
  double fall;             /* fall by gravity in the step, with a reserve [m] */
  double least_reserve;    /* gap up to which all pairs are chosen in this step [m] */
  size_t pair_count;       /* pairs that were chosen */
  size_t barrier_count;    /* barriers for the rest of the step */
  sw_meet *touches, *last; /* of this iterate and of the previous one, in the order of pairs */
  size_t touch_count, touch_capacity, last_count, last_capacity;
  sw_still_meets still;
  void *grid; /* memory for the search for near things */
  size_t grid_capacity;
  sw_spots spots; /* memory for the refinement */
  sw_ways ways;   /* memory for the refinement */
  sw_hit *hits;   /* possible strikes at the ends of this trial's stages */
  size_t hit_count, hit_capacity;
  size_t struck;                /* places that struck in this step [-] */
  sw_met *memory, *next_memory; /* in the order of sw_ends_order */
  size_t memory_count, memory_capacity, next_count, next_capacity;
};

/* Begins an empty contact with the bodies' rules. On SW_ENOMEM the caller must still free it. */
sw_status sw_mutual_start(sw_mutual *mutual, const sw_finder *finder, const sw_pair_rule *rules,
                          size_t bodies);
/* 1: some rule lets the body touch something. */
int sw_mutual_takes_part(const sw_mutual *mutual, size_t body);
static inline const sw_pair_rule *sw_mutual_rule(const sw_mutual *m, const uint32_t body[2]) {
  return &m->rules[m->bodies * body[0] + body[1]];
}
/* Call after the waiting bodies of a step are known: puts touches between them aside. SW_ENOMEM. */
sw_status sw_mutual_set_aside(sw_mutual *mutual, const sw_system *system);
void sw_mutual_forget_still(sw_mutual *mutual);    /* drops them */
sw_status sw_mutual_carry_over(sw_mutual *mutual); /* their memory, when a step is accepted */
void sw_meets_free(sw_still_meets *still);
/* Chooses again which pairs may touch in the step. */
sw_status sw_mutual_choose(sw_mutual *mutual, sw_system *system);

/* Order of pairs: negative if p comes first. */
int sw_ends_order(const sw_ends *p, const sw_ends *q);
/* 1: all nodes are held. */
int sw_ends_held(const sw_system *system, const sw_ends *e);
/* Largest relative speed between nodes of both things [m/s]. */
double sw_ends_speed(const sw_system *system, const sw_ends *e);

/* 1: friction acts at the wires' surfaces. */
static inline int sw_meet_turns(const sw_meet *t) {
  return sw_norm2(t->lever[0]) > 0 || sw_norm2(t->lever[1]) > 0;
}
/* A shift without the part by which the wires roll. */
static inline sw_vec sw_meet_eased(const sw_meet *t, sw_vec v) {
  return sw_madd(v, t->eases, -sw_dot(t->eases, v));
}
/* Velocity or shift of the first wire's surface relative to the second one, at velocities or shifts
 * v of the nodes: u + sum lever (n . dx), where u is that of the axes and dx that of the edges.
 * Along the normal it is that of the axes. */
sw_vec sw_meet_passes(const sw_meet *touch, const double *v);

/* Begins friction of a touch, from its memory or from the previous iterate (NULL: none), at
 * positions y, when everything else of it is known. */
void sw_meet_begin_friction(sw_mutual *mutual, const sw_system *system, const double *y, sw_meet *t,
                            const sw_met *met, const sw_meet *last);

/* Returns a new touch, all zero, not in the list yet; NULL: out of memory. */
sw_meet *sw_meet_new(sw_mutual *mutual);
/* Puts the touch into the list and sets everything that follows from its place. gap and normal are
 * those at positions y. met: memory of the last step, last: the touch in the previous iterate, or
 * NULL. */
void sw_meet_add(sw_mutual *mutual, const sw_system *system, const double *y, sw_meet *t,
                 double gap, sw_vec normal, const sw_met *met, const sw_meet *last);
/* Softens springs in the first solves of a stage, when the touches of an iterate are found. */
void sw_mutual_soften(sw_mutual *mutual);
/* Corrects the side: if the remembered normal shows that axes passed each other within the
 * iteration, reverses the normal and the sign of the distance. */
void sw_meet_side(const sw_met *m, double reach, sw_vec *normal, double *distance);
/* Places with a gap below this share of the sum of radii are listed, so that a new touch finds its
 * state in the previous iterate [-]. */
#define SW_LISTED_GAP 0.25

/* Adds a touch's force to the first body and its opposite to the second one, at positions y. K
 * (upper half): stiffness, NULL = not wanted. */
sw_status sw_meet_push(sw_system *system, const sw_meet *touch, const double *y, sw_vec force,
                       const double *K);

/* Finds the nearest points of two segments as places along them. Returns their distance [m]. */
double sw_segments_nearest(sw_vec a0, sw_vec a1, sw_vec b0, sw_vec b1, double at[2]);

/* Closing speed of a place in a step of h, minus the speed that just reaches contact [m/s]. */
double sw_meet_excess(const sw_system *system, const sw_bow bow[2], double reach, sw_vec normal,
                      double h);
/* Second derivative of d^2/2 by the place along a wire, d the distance [m2]. along2: square of the
 * wire's slope there [m2]; bends: its bend along d [m2]; firm: its firmness [-]. */
double sw_meet_rise(double along2, double bends, double firm);

#endif
