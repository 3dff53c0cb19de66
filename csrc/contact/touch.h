/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of wires with obstacles, for the files of this room. Candidate: a node or segment and an
 * obstacle that may touch in the step. Touch: a place of it where an iterate lets them press. */
#ifndef SW_CONTACT_TOUCH_H
#define SW_CONTACT_TOUCH_H

#include "contact/broad.h"
#include "contact/contact.h"
#include "contact/record.h"

struct sw_contact {
  sw_contact_obstacle *obstacles;
  sw_contact_loads *loads; /* (count) impulses in the step; zero but for those in busy */
  int *busy;               /* (busy_count) obstacles near wires in this step, or pressed before */
  size_t busy_count;
  int informed; /* 1: the scene has told what obstacles remember and which of them may move */
  sw_broad broad;
  int last_stage; /* number of the last stage whose loads were booked in this trial */
  size_t count;
  sw_contact_place place; /* places an obstacle at a time, with user */
  void *user;
  sw_contact_at *start, *now; /* (count) places at the step's start and at the stage */
  int *flat;                  /* (count) 1: a half space, no segment contacts */
  int *straight;              /* (count) 1: its faces meet at right angles */
  int *pads;                  /* (pad_count) numbers of the pads of grippers */
  size_t pad_count;
  int *pressing; /* (count) 1: a pad that pressed on something at the step's start */
  int *sharp;    /* (count) 1: it has faces, edges and corners */
  double *round; /* (count) radius of its round side; 0: it has none [m] */
  int *wound;    /* (count) number + 1 of the last body that goes round it in this step */
  int *dense;    /* (count) 1: particles of the body at hand lie close to each other */
  double *sunk;  /* (3 nodes) shift of a node by which contact finds it deeper; NULL: none [m] */
  size_t sunk_capacity;
  sw_ahead *ahead; /* (2 ahead_count) statics: states that the search has for touches, then room */
  size_t ahead_count, ahead_capacity; /* 0: there is no search */
  int softer;    /* stage of the search, in which touches are softened; 0: no more [-] */
  int passes;    /* of touches looking for their states at one place [-] */
  double *reach; /* (nodes) widest gap to an obstacle at rest that may close in the step [m] */
  size_t reach_capacity;
  /* candidates and touches */
  double *spaced; /* (count) largest distance of samples of the body at hand; 0: no samples [m] */
  sw_bounds *bounds; /* (count) at the step's start, world axes */
  sw_candidate *candidates;
  size_t candidate_count, candidate_capacity;
  sw_touch *touches, *last; /* of this iterate and of the one before */
  size_t touch_count, touch_capacity, last_count, last_capacity;
  sw_pressed *pressed; /* touches with a force at the end of a stage of this trial */
  size_t pressed_count, pressed_capacity, pressed_before; /* the last: of earlier stages */
  sw_turn *turns;                                         /* (pressed_count) of a review */
  size_t turn_capacity;
  sw_memory *memory, *next_memory; /* of touches, from step to step */
  size_t memory_count, memory_capacity, next_count, next_capacity;
  /* impacts and barriers */
  uint32_t *impact_at, *barrier_at; /* (places) number + 1 of a node's last one, or 0 */
  size_t places, place_capacity;
  sw_barrier *barriers;
  size_t barrier_count, barrier_capacity;
  sw_impact *impacts;
  size_t impact_count, impact_capacity;
  sw_mark *marks; /* touches of the last iterate, to tell whether another one would change any */
  size_t mark_count, mark_capacity;
  sw_contact_parts parts; /* bodies that are solved by themselves */
  double *room;           /* of an iterate's refinement: solutions of a wire's equations */
  size_t room_capacity;
  int unmarked;      /* 1: some touch slid, or there was no room: the marks tell nothing */
  int looked;        /* 1: touches are those of the iterate to be evaluated next */
  size_t stage;      /* number of the stage; it grows from step to step */
  double first;      /* share of the step's first stage in what this one begins from [-] */
  double time, h;    /* of the step [s] */
  double stage_time; /* that obstacles were last placed for [s] */
  double nominal;    /* the run's full step [s] */
  double asked;      /* the part of it that was first tried, before any was refused [s] */
  sw_contact_regime regime;
  int plastic;     /* 1: impacts of this step do not rebound */
  int hasty;       /* 1: this trial ends before friction of a wire that strikes is settled */
  int careful;     /* 1: no trial of this step does that */
  double soonest;  /* time after the step's start of the first rebound that is not at it [s] */
  double least;    /* rebounds sooner than this after the start are at the start [s] */
  double struck;   /* work of moving obstacles in the step's impacts [J] */
  int fresh;       /* SW_CONTACT_FRESH, or SW_CONTACT_EMERGING, or 0 */
  int updates;     /* of touches in the stage so far [-] */
  int made;        /* updates that positions took too [-] */
  double widening; /* of the reserve for flight, when nodes went further than it [-] */
};

/* Force scale of a wire's touches: much smaller forces do not matter [N]. Touches are in the order
 * of wires: *end is the first of the next wire. */
double sw_contact_scale(const sw_contact *c, size_t first, size_t *end);

/* Way that a node of velocity v may go in the step unnoticed; and the least one [m]. */
#define SW_FLIGHT_LEAST 1e-4
double sw_flight_reserve(const sw_contact *c, const sw_system *s, sw_vec v);

/* An impact at the step's start gave an obstacle this impulse at a point [m], [N s]. A step begins
 * without any. The trial was accepted: what obstacles remember. */
void sw_contact_add_blow(sw_contact *c, int obstacle, sw_vec point, sw_vec impulse);
void sw_contact_forget_blows(sw_contact *c);
void sw_contact_conclude(sw_contact *c);
/* Wires may press on the obstacle in this step. */
void sw_contact_expect(sw_contact *c, int obstacle);

/* A step of a system with so many nodes begins without impacts and barriers. SW_ENOMEM. */
sw_status sw_contact_calm(sw_contact *c, size_t nodes);

sw_pressed sw_contact_pressed(const sw_touch *t);
/* Change the velocities at the step's start so that the touch is reached, not passed. Returns 1
 * when something was changed. */
int sw_contact_strike(sw_contact *c, sw_system *s, const sw_touch *t, double h);
/* The same of all that pressed in the trial, in the order in which they meet their obstacles. dull:
 * the step does not bounce. */
int sw_contact_strike_all(sw_contact *c, sw_system *s, double h, int dull);

/* Will a touch from first to end strike with its present force? Only of obstacles without
 * restitution. */
int sw_contact_will_strike(const sw_contact *c, sw_system *s, size_t first, size_t end);

/* Raise barriers where wires cross obstacles on their way to x1. h: of the step, 0 in statics,
 * where there are no speeds to change. Returns 1 when there are new ones. */
int sw_contact_cross(sw_contact *c, sw_system *s, const double *x1, double h);

/* The barrier that was raised first of those for the node or segment, or NULL. */
const sw_barrier *sw_contact_barrier(const sw_contact *c, int obstacle, size_t node, int segment);

/* How far nodes are sunk, with the system where it is. SW_ENOMEM. */
sw_status sw_contact_sink(sw_contact *c, const sw_system *s);

/* Fill the list of candidates for the step. */
sw_status sw_contact_find_candidates(sw_contact *c, sw_system *s, sw_error *err);

/* An iterate looks at its candidates. */
typedef struct sw_glance {
  size_t next, end;   /* what is left of them */
  size_t match, last; /* the first candidate without its touches of the iterate before, and the
                         first of these touches that is left */
} sw_glance;

/* An iterate begins: touches become those of the one before. SW_ENOMEM. */
sw_status sw_contact_turn_over(sw_contact *c, sw_glance *at);
/* Candidates up to the next one, and on the segment beside, find theirs. */
void sw_contact_match(const sw_contact *c, sw_glance *at);

/* The memory of the candidate's touch nearest to this place, or NULL. */
const sw_memory *sw_contact_remembered(const sw_contact *c, const sw_candidate *k, double at);
/* The obstacle with the owner's number, or count. */
size_t sw_contact_index(const sw_contact *c, int id);
/* A place along a candidate as a mean of nodes. */
sw_mean sw_contact_spot(const sw_system *s, const sw_candidate *k, double at);

struct sw_place;
/* SW_ENOMEM. */
sw_status sw_contact_add_touch(sw_contact *c, const sw_system *s, const sw_candidate *k,
                               const double *y, const struct sw_place *place);
/* Find touches of some more candidates at positions y. *found: number of touches whose place in the
 * list is final. SW_ENOMEM. */
sw_status sw_contact_look_on(sw_contact *c, const sw_system *s, const double *y, sw_glance *at,
                             size_t *found, sw_error *err);
/* Depth of the touch's place at the step's start, below 0 outside [m]. */
double sw_contact_depth_before(const sw_contact *c, const sw_system *s, const sw_touch *t);

/* After an update by shift [m] to positions y, does the touch keep the place and normal of its
 * equations? scale: smaller forces do not matter [N]. */
int sw_contact_stays(const sw_contact *c, const sw_system *s, const sw_touch *t, const double *y,
                     double shift, double scale);

/* After a static solve: release touches at the ends of rows where the wire lifts off. */
void sw_contact_peel(sw_contact *c, const sw_system *s);

/* After a static solve whose update is not made: states of the touches at the best place on its
 * way. 0: out of memory. */
int sw_contact_search(sw_contact *c, const sw_system *s, const double *delta);

/* Number of touches that pull, or do not press where they should. */
size_t sw_contact_wrong(const sw_contact *c);
/* The stiffness k of a touch in the search. */
double sw_contact_softer(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                         double stiffness);

/* Depth on the segment beside a held node that no force takes away. One held beyond an edge is
 * below the faces that end there, but in none [m]. */
double sw_contact_imposed(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                          const sw_touch *t, const double *y);
/* Is it pinched between its obstacle and another one? */
int sw_contact_is_pinched(const sw_contact *c, const sw_touch *t);

/* 1: the candidate's node, or both ends of its segment, are held. */
int sw_contact_is_held(const sw_system *s, const sw_candidate *k);

/* How turns of edges shift a wire's surface at a touch. */
typedef struct sw_levers {
  size_t count, edge; /* 0 unless the wire rolls, to 2; the first of them, in its body */
  sw_vec arm[2];      /* shift per turn [m] */
} sw_levers;

/* Of a touch at a node or on a segment that begins there, with the last evaluation's tangents. */
sw_levers sw_levers_at(const sw_system *s, size_t body, size_t node, int segment, sw_vec normal);
static inline sw_levers sw_touch_levers(const sw_system *s, const sw_touch *t) {
  if (!s->bodies[t->body].roll_block) return (sw_levers){0};
  return sw_levers_at(s, t->body, t->node, t->segment, t->press.normal);
}
/* Shift of the surface by turn[edge stride] [m], or its speed by rates. */
sw_vec sw_levers_shift(const sw_levers *l, const double *turn, size_t stride);
/* The touch's friction and stiffness (upper half of K) on the turns. */
void sw_levers_push(sw_system *s, const sw_touch *t, const double K[6], unsigned want);
/* Change of the axis' velocity by an impulse of at most this size that stops the surface's sliding
 * [m/s]. */
sw_vec sw_levers_brake(const sw_beam *beam, const sw_levers *l, sw_vec slide, double most);
/* Add the change of the edges' rates (edges) by an impulse at the touch [N s]. */
void sw_levers_kick(const sw_plan *p, const sw_levers *l, sw_vec impulse, double *rates);

/* A candidate has at most so many samples; number k of them, along its segment [-]. */
enum { SW_SAMPLES_MOST = 64 };
static inline double sw_sample_at(const sw_candidate *candidate, int k) {
  return ((double)k + 0.5) / (double)candidate->samples;
}

/* The place of a candidate on its segment. */
static inline sw_vec sw_touch_place(const double *x, size_t node, size_t other, double at) {
  return node != other ? sw_lerp(sw_load(x + 3 * node), sw_load(x + 3 * other), at)
                       : sw_load(x + 3 * node);
}

/* Where its surface is skin from, with the system's nodes at x [m]. */
static inline sw_vec sw_contact_where(const sw_contact *c, const double *x, size_t node,
                                      size_t other, double at) {
  const sw_vec p = sw_touch_place(x, node, other, at);
  return c->sunk ? sw_sub(p, sw_touch_place(c->sunk, node, other, at)) : p;
}

static inline sw_vec sw_mean_place(const sw_contact *c, const double *x, const sw_mean *spot) {
  const sw_vec p = sw_mean_of(x, 0, spot);
  return c->sunk ? sw_sub(p, sw_mean_of(c->sunk, 0, spot)) : p;
}

/* Correction of a sunk place's gap. A place sunk along the normal n of its surface meets a face of
 * normal -n at that surface. If the surface is turned against the face the distance stays, so that
 * a flattened section keeps its distance [m]. */
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

#endif
