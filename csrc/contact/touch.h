/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of wires with obstacles: internal data. Candidate: a node or segment and an obstacle that
 * it may touch in the step. Touch: a place of a candidate where they may press in an iterate. */
#ifndef SW_CONTACT_TOUCH_H
#define SW_CONTACT_TOUCH_H

#include "contact/behind.h"
#include "contact/broad.h"
#include "contact/contact.h"
#include "contact/record.h"
#include "contact/wait.h"

struct sw_contact {
  sw_contact_obstacle *obstacles;
  sw_contact_loads *loads; /* (count) impulses in the step; zero except for obstacles in busy */
  int *busy;               /* (busy_count) obstacles near wires in this step, or pressed before */
  size_t busy_count;
  int informed; /* 1: the owner has given the obstacles' loads and told which obstacles may move */
  sw_broad broad;
  int last_stage; /* last stage whose loads were booked in this trial */
  sw_singles singles;
  size_t count, pad_count;
  size_t open_count, slick_count; /* obstacles that are open meshes, or slide more easily than they
                                     stick: without any their looks at all touches are left out */
  sw_contact_place place;         /* places an obstacle at a time, with user */
  void *user;
  sw_contact_at *start, *now; /* (count) positions at the step's start and at the stage */
  sw_quat *before;            /* (count) rotations of those that move at the previous stage [-] */
  int *flat;                  /* (count) 1: a half space, without contacts of segments */
  int *straight;              /* (count) 1: its faces meet at right angles */
  int *pads;                  /* (pad_count) numbers of the pads of grippers */
  int *pressing;              /* (count) 1: a pad that pressed on something at the step's start */
  int *sharp;                 /* (count) 1: it has faces, edges and corners */
  double *round, *facet, *facet_radius; /* (count) radius of its round side, sw_shape_facet [m] */
  int *wound;   /* (count) last body that goes round it in this step: number + 1, or 0 */
  int *curved;  /* (count) the same of one that presses with its curve, or taut, on facets */
  int *dense;   /* (count) 1: particles of the current body lie close to each other */
  double *sunk; /* (3 nodes) shift of each node's place for contact; NULL: no node is shifted [m] */
  sw_ahead *ahead; /* (2 ahead_count) statics: states of the touches in the search, work space */
  size_t sunk_capacity, ahead_count, ahead_capacity; /* ahead_count = 0: no search */
  int softer;    /* softening stage of the search; 0: touches have their full stiffness [-] */
  int passes;    /* solves at one place in the search for the touches' states [-] */
  double *reach; /* (nodes) widest gap to a resting obstacle that may close in the step [m] */
  size_t reach_capacity;
  /* candidates and touches */
  double *spaced; /* (count) largest distance of samples of the current body; 0: no samples [m] */
  sw_bounds *bounds; /* (count) boxes at the step's start, in world axes */
  sw_candidate *candidates;
  size_t candidate_count, candidate_capacity;
  sw_touch *touches, *last; /* of this iterate and of the previous one */
  size_t touch_count, touch_capacity, last_count, last_capacity;
  sw_still still;      /* those of bodies that wait */
  sw_pressed *pressed; /* touches that had a force at the end of a stage of this trial */
  size_t pressed_count, pressed_capacity, pressed_before; /* the last: those of earlier stages */
  sw_turn *turns;         /* (pressed_count) order of impacts in a review */
  unsigned char *strikes; /* (bodies) work space for that */
  size_t turn_capacity, strikes_capacity;
  sw_memory *memory, *next_memory; /* memory of touches from step to step */
  size_t memory_count, memory_capacity, next_count, next_capacity;
  double *lost; /* (places) at a body's first node: energy lost by its impacts in this step [J] */
  uint32_t *impact_at, *barrier_at; /* (places) a node's last impact or barrier: number + 1, or 0 */
  size_t places, place_capacity;
  sw_behind behind; /* a wire at the back of a sheet in this step */
  sw_barrier *barriers;
  size_t barrier_count, barrier_capacity;
  sw_impact *impacts;
  size_t impact_count, impact_capacity;
  sw_mark *marks; /* touches of the last matrix, to decide whether it is still valid */
  size_t mark_count, mark_capacity;
  sw_contact_parts parts; /* bodies that are solved separately */
  sw_range *ranges;       /* (parts.ranges) candidates of the current part */
  double *room;           /* work space of refinement: solutions of a wire's equations */
  size_t range_capacity, room_capacity;
  int unmarked, looked; /* 1: the marks are not valid; 1: the next evaluation's touches are found */
  size_t stage;         /* number of the stage; it grows from step to step */
  double first; /* share of the step's first stage in the starting state of this stage [-] */
  double time, h, stage_time; /* the step's start and size; when obstacles were placed last [s] */
  double nominal;             /* the run's full step [s] */
  int adaptive;               /* 1: steps follow their error */
  double asked;               /* part (substep) that was first tried, before refusals [s] */
  int brakes;                 /* 1: a drive with which wires slide comes to rest soon */
  sw_contact_regime regime;
  int plastic;     /* 1: nothing rebounds in this step */
  int hasty;       /* 1: this trial ends before the friction of a striking wire agrees */
  int careful;     /* 1: no trial of this step may be hasty */
  double soonest;  /* first rebound after the step's start, as time after the start [s] */
  double least;    /* rebounds earlier than this count as at the start [s] */
  double struck;   /* work of moving obstacles in the step's impacts [J] */
  int fresh;       /* SW_CONTACT_FRESH, or SW_CONTACT_EMERGING, or 0 */
  int hardens;     /* 1: some touch of this step may have sw_touch.hardened */
  int falls;       /* 1: some touch of this step may have sw_touch.fallen */
  int updates;     /* of touches in the stage so far [-] */
  int made;        /* updates that were also applied to positions [-] */
  double widening; /* factor on the reserve for flight, raised if nodes exceeded it [-] */
};

/* Force scale of a wire's touches; much smaller forces do not matter [N]. Touches are sorted by
 * wire: *end is the first touch of the next wire. */
double sw_contact_scale(const sw_contact *c, size_t first, size_t *end);

/* Distance that a node of velocity v may move in the step without a new search for candidates, and
 * its smallest value [m]. */
#define SW_FLIGHT_LEAST 1e-4
double sw_flight_reserve(const sw_contact *c, const sw_system *s, sw_vec v);

/* Books an impact at the step's start: its impulse on an obstacle at a point [m], [N s].
 * sw_contact_forget_blows: a step begins without loads. sw_contact_conclude: the trial was
 * accepted; stores the loads for the next step. */
void sw_contact_add_blow(sw_contact *c, int obstacle, sw_vec point, sw_vec impulse);
void sw_contact_forget_blows(sw_contact *c);
void sw_contact_conclude(sw_contact *c, const sw_system *s);
/* Notes that wires may press on the obstacle in this step. */
void sw_contact_expect(sw_contact *c, int obstacle);
/* Clears impacts and barriers at a step's start, for this many nodes. SW_ENOMEM. */
sw_status sw_contact_calm(sw_contact *c, size_t nodes);
sw_pressed sw_contact_pressed(const sw_touch *t);
/* Changes the velocities at the step's start so that the wire reaches the touch but does not pass
 * it. Returns 1 if a velocity changed. */
int sw_contact_strike(sw_contact *c, sw_system *s, const sw_touch *t, double h);
/* The same for all touches that pressed in the trial, in the order of their meetings. dull: 1 if
 * the step does not bounce. */
int sw_contact_strike_all(sw_contact *c, sw_system *s, double h, int dull);
/* 1 if a touch from first to end will strike by its force. Only obstacles without restitution. */
int sw_contact_will_strike(const sw_contact *c, sw_system *s, size_t first, size_t end);

/* Raises barriers where wires cross obstacles on their way to x1. h: the step; 0 in statics, which
 * has no speeds to change. Returns 1 if there are new barriers. */
int sw_contact_cross(sw_contact *c, sw_system *s, const double *x1, double h);

/* Returns the first barrier raised for the node or segment, or NULL. */
const sw_barrier *sw_contact_barrier(const sw_contact *c, int obstacle, size_t node, int segment);

/* Finds the shifts of sunk nodes. SW_ENOMEM. */
sw_status sw_contact_sink(sw_contact *c, const sw_system *s);
/* Fills the list of candidates for the step. */
sw_status sw_contact_find_candidates(sw_contact *c, sw_system *s, sw_error *err);

/* State of an iterate's look at its candidates. */
typedef struct sw_glance {
  size_t next, end;   /* candidates that are left, of this range */
  size_t range;       /* number of the part's range */
  size_t match, last; /* first candidate that is not yet matched with touches of the previous
                         iterate, and first of these touches that is left */
} sw_glance;

/* Begins an iterate: its touches become those of the previous iterate. SW_ENOMEM. */
sw_status sw_contact_turn_over(sw_contact *c, sw_glance *at);
/* Goes on to the part's next range of candidates; 0: there are no more. */
int sw_contact_next_range(const sw_contact *c, sw_glance *at);
/* Matches candidates up to at->next, and of the next segment, with their previous touches. */
void sw_contact_match(const sw_contact *c, sw_glance *at);

void sw_contact_sort_memory(sw_contact *c); /* in the order of candidates */
/* Returns the memory of the candidate's touch nearest to this place, or NULL. The place's feature,
 * else its normal, decides between touches at the same place of the wire. */
const sw_memory *sw_contact_remembered(const sw_contact *c, const sw_candidate *k,
                                       const sw_closest *place);
/* Returns the obstacle with this owner's number, or count. */
size_t sw_contact_index(const sw_contact *c, int id);
int sw_contact_is_faceted(const sw_contact *c, size_t o); /* 1: a round thing, of facets */
/* Returns a place along a candidate as a mean of nodes. */
sw_mean sw_contact_spot(const sw_system *s, const sw_candidate *k, double at);

struct sw_place;
/* Adds a touch of a candidate at a place. SW_ENOMEM. */
sw_status sw_contact_add_touch(sw_contact *c, const sw_system *s, const sw_candidate *k,
                               const double *y, const struct sw_place *place);
/* Finds touches of further candidates at positions y. *found: number of touches with a final
 * position in the list. SW_ENOMEM. */
sw_status sw_contact_look_on(sw_contact *c, const sw_system *s, const double *y, sw_glance *at,
                             size_t *found, sw_error *err);

/* 1 if the touch keeps the place and normal of its equations after an update by shift [m] to
 * positions y. scale: smaller forces do not matter [N]. */
int sw_contact_stays(const sw_contact *c, const sw_system *s, const sw_touch *t, const double *y,
                     double shift, double scale);

/* After a static solve: releases touches at the ends of rows where the wire lifts off. */
void sw_contact_peel(sw_contact *c, const sw_system *s);

/* After a static solve whose update is not made: sets the touches' states to those of the least
 * energy on the path of the update. 0: out of memory, or a wire rolls. */
int sw_contact_search(sw_contact *c, const sw_system *s, const double *delta);

/* Number of touches that pull, or that should press and do not. */
size_t sw_contact_wrong(const sw_contact *c);
/* Coefficient of a touch: that of sliding if it slid before, or comes sliding (loose.c) [-]. */
double sw_contact_coefficient(const sw_contact *c, const sw_system *s, const sw_memory *m,
                              const sw_touch *t);
/* Returns the softened stiffness of a touch in the search [N/m]. */
double sw_contact_softer(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                         double stiffness);

/* Marks the bodies that press on an obstacle that turns at the step's start. sw_contact_carried:
 * place to which the touch's obstacle has carried a point since then, by the stage's rule [m]. */
void sw_contact_find_carried(const sw_contact *c, sw_system *s);
sw_vec sw_contact_carried(const sw_contact *c, const sw_system *s, const sw_touch *t, sw_vec from);

/* 1 if the wire is pinched between the touch's obstacle and another one, or two of its flanks. */
int sw_contact_is_pinched(const sw_contact *c, const sw_touch *t);

/* 1 if the candidate's node, or both ends of its segment, are held. */
int sw_contact_is_held(const sw_system *s, const sw_candidate *k);

/* Most samples of a candidate; place of sample number k along its segment [-]. */
enum { SW_SAMPLES_MOST = 128 };
static inline double sw_sample_at(const sw_candidate *candidate, int k) {
  return ((double)k + 0.5) / (double)candidate->samples;
}

/* Returns the position of a place on a segment, or of a node. */
static inline sw_vec sw_touch_place(const double *x, size_t node, size_t other, double at) {
  return node != other ? sw_lerp(sw_load(x + 3 * node), sw_load(x + 3 * other), at)
                       : sw_load(x + 3 * node);
}

/* Position from which the surface has the distance `skin`, with the system's nodes at x [m]. */
static inline sw_vec sw_contact_where(const sw_contact *c, const double *x, size_t node,
                                      size_t other, double at) {
  const sw_vec p = sw_touch_place(x, node, other, at);
  return c->sunk ? sw_sub(p, sw_touch_place(c->sunk, node, other, at)) : p;
}

static inline sw_vec sw_mean_place(const sw_contact *c, const double *x, const sw_mean *spot) {
  const sw_vec p = sw_mean_of(x, 0, spot);
  return c->sunk ? sw_sub(p, sw_mean_of(c->sunk, 0, spot)) : p;
}

/* Correction of the gap of a sunk place [m]. A place sunk along the normal n of its surface touches
 * a face of normal -n at that surface. If the surface is oblique to the face, the sinking counts
 * fully, so that a flattened section keeps its distance. */
static inline double sw_contact_aslant(const sw_contact *c, size_t node, size_t other, double at,
                                       sw_vec normal) {
  if (!c->sunk) return 0;
  const sw_vec a = sw_load(c->sunk + 3 * node), b = sw_load(c->sunk + 3 * other);
  const double whole = sw_norm(a) + at * (sw_norm(b) - sw_norm(a));
  return whole + sw_dot(normal, node != other ? sw_lerp(a, b, at) : a);
}

/* Velocity of the obstacle's material at world point p [m/s]. */
static inline sw_vec sw_obstacle_velocity(const sw_contact_at *o, sw_vec p) {
  return sw_add(o->v, sw_cross(o->omega, sw_sub(p, o->pose.p)));
}

/* The same at the step's start, where the touch's part of the wire was then. Where it is now there
 * was another part of a turning obstacle: its velocity differs by that of the turn, over the wire's
 * way. Of a wire that rolls: what its surface moves against, see surface.h [m/s]. */
sw_vec sw_obstacle_velocity_before(const sw_contact *c, const sw_system *s, const sw_touch *t);

#endif
