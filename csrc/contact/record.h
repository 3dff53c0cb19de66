/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records of contact with obstacles: candidates, touches, and their memory between iterates and
 * between steps. Only for the files of this folder. */
#ifndef SW_CONTACT_RECORD_H
#define SW_CONTACT_RECORD_H

#include <stdint.h>

#include "contact/contact.h"
#include "touch/law.h"
#include "touch/mean.h"

/* A candidate: a node, or the inside of a segment that starts there, and an obstacle that it may
 * touch in this step. */
typedef struct sw_candidate {
  int obstacle;
  int segment;          /* number of the segment at its node, from 1; 0: the node itself */
  uint32_t node, other; /* in the system's arrays; the segment's other end, or the node */
  uint32_t body;
  uint32_t memory, memory_end; /* its range of the memory */
  uint32_t last, last_end;     /* its range of the previous iterate's touches */
  uint8_t samples;  /* number of touches, evenly spaced on the segment; 0: at the nearest places */
  bool given : 1;   /* 1: the stiffness is fixed, at any depth */
  bool smooth : 1;  /* 1: the wire touches with its smooth curve there, not with its chords */
  bool round : 1;   /* 1: with its curve at a thin round obstacle, elsewhere with chords */
  bool arcs : 1;    /* 1: with its arc at a round side, see contact/arc.h */
  bool drawn : 1;   /* 1: the wire is held on both sides of it, and may be drawn taut */
  double radius;    /* of the wire there [m] */
  double skin;      /* distance of the surface from the node [m] */
  double mass;      /* [kg] */
  double usual;     /* stiffness of a new touch [N/m] */
  double least;     /* smallest stiffness of a touch that goes on; 0: any [N/m] */
  double squeezing; /* from this force on the touch cannot come out; 0: no such force [N] */
  double firm; /* at a round obstacle: how firmly a touch stays in the middle of its edge [-] */
  double firm_beside[2]; /* firmness on the previous and the next edge [-] */
  double lone;           /* lean of a touch, from 0 (the wire goes round) to 1 (straight) [-] */
} sw_candidate;

/* Values of `feature` that are no part of a shape: a touch kept by a barrier, and a touch of a
 * wire's curve with a round obstacle [-]. */
enum { SW_BEHIND_BARRIER = -1, SW_ON_CURVE = -2 };

/* One place where a wire's surface is near an obstacle. Members that are used together lie in the
 * same cache lines, the most used ones first (sw_touch_fetch). */
typedef struct sw_touch {
  sw_mean spot;   /* its place as a mean of nodes */
  double usual;   /* stiffness of a new touch here [N/m] */
  double stiffer; /* full stiffness from the next iterate on [N/m] */
  double share;   /* share of that stiffness; below 1 near a place on the next edge [-] */
  int obstacle, segment;
  uint32_t node, body;
  uint32_t candidate; /* index of its candidate */
  uint16_t stage;     /* stage in which it was found, its last bits */
  uint8_t sharp;      /* on a smooth curve: what it touches (sw_sharp) */
  bool known : 1;     /* 1: it pressed at the step's start */
  bool held : 1;      /* 1: both ends are held, so there is no force */
  bool edited : 1;    /* 1: its line got other edges, sw_kept.edited */
  bool squeezed : 1;  /* 1: stiffened from step to step, not within a step */
  double friction;    /* coefficient in this step: kinetic if it slid before [-] */
  sw_press press;     /* its normal is the obstacle's outward normal in world coordinates */
  double forgiven;    /* part of the true depth that this step does not correct [m] */
  double let_out;     /* unexplained part of the true depth that this step removes [m] */
  double left;        /* rest of `forgiven` after the touch was stiffened [m] */
  double hardened;    /* energy gained by a higher stiffness [J] */
  sw_vec acts;        /* where the force acts: the axis, or a rolling surface, world [m] */
  sw_vec edge;        /* direction of the edge touched [-]; of a rolling wire that lies on a round
                         side sw_contact_arc_lies [m]; in the obstacle's coordinates */
  double steady;      /* steady normal force [N] */
  double at;       /* place along the segment; on a smooth curve up to half an edge beyond it [-] */
  sw_vec point;    /* on the obstacle, world [m] */
  sw_vec local;    /* the same in the obstacle's coordinates [m] */
  double rise;     /* distance of the wire's arc outside the curve, part of the gap [m] */
  double fallen;   /* decrease of `rise` since the step's start; 0: no decrease [m] */
  sw_vec seen;     /* the wire's position at this evaluation, in the obstacle's coordinates [m] */
  sw_vec edge_now; /* of a rolling wire: edge in world coordinates at this evaluation [m] */
  double slid;     /* sliding path up to the step's start, since the touch began to press [m] */
  int feature;
  uint32_t other; /* the segment's other end, or the node again */
} sw_touch;
_Static_assert(sizeof(sw_touch) == 640, "whole cache lines");

/* Fetches the first cache lines of a touch that a loop over a list needs soon: long lists are not
 * in the cache. SW_FETCH_PRESS: for the equations of its press; SW_FETCH_FORCE: also for its force
 * and the moment of that. */
enum { SW_LINE = 64, SW_FETCH_AHEAD = 6 }; /* cache line [B]; items ahead of the loop [-] */
enum { SW_FETCH_GAP = 3, SW_FETCH_PRESS = 7, SW_FETCH_FORCE = 8, SW_FETCH_ALL = 10 };
static inline void sw_touch_fetch(const sw_touch *t, int lines) {
  const uintptr_t at = (uintptr_t)t + SW_FETCH_AHEAD * sizeof *t; /* may be beyond the list */
  for (int k = 0; k < lines; k++) __builtin_prefetch((const void *)(at + (uintptr_t)k * SW_LINE));
}

/* Penetration of the accepted state at the touch, negative outside [m]. */
static inline double sw_touch_depth(const sw_touch *t) { return t->forgiven - t->press.gap_after; }
/* Moment of a force of the wire on the obstacle at the touch. Where a rolling wire lies on a round
 * side, friction across it acts nearer to the surface than friction along it [N m]. */
sw_vec sw_touch_moment(const sw_touch *touch, sw_vec about, sw_vec force);
/* Arc length of a touch's place, of a line from its start [m]. */
double sw_touch_arc(const sw_system *system, const sw_touch *touch);
/* 1 if the touch is softer in this iterate than it will be in the next. */
static inline int sw_touch_is_softer(const sw_touch *t) {
  return t->press.k < t->share * t->stiffer;
}

/* A touch that pressed at the end of a stage and may have struck: only the data that impacts need.
 * A sw_touch is large, and many nodes may land in one step. */
typedef struct sw_pressed {
  uint32_t node, other, body;
  int obstacle, segment;
  sw_sharp sharp;
  double at;
  sw_mean spot;
  sw_vec local, normal;
  double let_out, rise;
} sw_pressed;

/* Memory of a touch between steps, in the obstacle's coordinates. */
typedef struct sw_memory {
  int obstacle, segment; /* obstacle: the owner's number */
  uint32_t node;
  int feature;
  double at;
  sw_vec normal, point; /* side of the wire: local [-], [m] */
  sw_kept kept;         /* its vectors are local too */
  sw_vec seen;          /* the wire's position at that time, local [m] */
  double rise;          /* distance of its arc outside its chord at that time [m] */
  double slid;          /* sliding path since the touch began to press [m] */
} sw_memory;

/* A crossing found by the swept test. It keeps the place on one side of a plane for the rest of the
 * step. */
typedef struct sw_barrier {
  int obstacle, segment;
  size_t node, other;
  double at;
  sw_vec normal, point; /* local [-], [m] */
  uint32_t before;      /* the previous barrier at its node: number + 1, or 0 */
} sw_barrier;

/* A touch whose impact was treated in this step. */
typedef struct sw_impact {
  int obstacle, segment;
  size_t node;
  size_t first; /* the first node of its body */
  double at;
  sw_vec kick;     /* impulse on the obstacle [N s] */
  uint32_t before; /* the previous impact at its node: number + 1, or 0 */
  sw_vec normal;   /* of the touch, in world axes [-] */
} sw_impact;

/* When a touch would strike. */
typedef struct sw_turn {
  double meets, closes; /* time after the step's start [s]; closing speed of the gap [m/s] */
  size_t node;
  int obstacle;
  uint32_t touch; /* number in the list `pressed` */
} sw_turn;

/* A touch that was part of the last matrix. */
typedef struct sw_mark {
  size_t candidate;
  double at, k;  /* [-], [N/m] */
  sw_vec normal; /* [-] */
} sw_mark;

/* Statics: where the search for the touches' states continues. */
typedef struct sw_ahead {
  sw_vec shift; /* shift of the touch from the wires' positions [m] */
  sw_vec force; /* force on the wire there as used by the solves [N] */
} sw_ahead;

/* A touch's pressing force on its obstacle at the end of a step's first stage [N]. */
typedef struct sw_pressing {
  size_t body;
  int obstacle;
  sw_vec force;
} sw_pressing;

/* Weights of forces in a stage's impulse: at the step's start, at the end of the first stage, and
 * at the end of a later stage [s]. */
typedef struct sw_weights {
  double start, first, later;
} sw_weights;

/* Forces of single wires, from which their blows are found if several touch an obstacle. */
typedef struct sw_singles {
  sw_pressing *first; /* (count) in the order of wires */
  size_t count, capacity;
  sw_weights stage[SW_BOOK_STAGES];
} sw_singles;

/* The wires that strike an obstacle in a trial step. If there are none, all its wires count. */
typedef struct sw_strikers {
  size_t count;                /* number of striking wires */
  double usual;                /* sum of the usual forces of the striking wires [N] */
  double all;                  /* the same of all its wires, during the look at them [N] */
  sw_vec rest_start, rest_end; /* loads of the others at the step's start and end [N] */
  sw_vec from, to, first;      /* the same of the wire looked at, and after the first stage [N] */
  sw_vec kicks;                /* its impulse by impacts at the step's start [N s] */
  size_t looked;               /* number of that wire + 1, or 0 */
} sw_strikers;

/* Loads of an obstacle in a step. */
typedef struct sw_contact_loads {
  sw_contact_past past;
  sw_contact_load stage[SW_BOOK_STAGES]; /* impulse from the step's start, without blows [N s] */
  sw_contact_load blows;   /* impulse of impacts that changed the starting velocities [N s] */
  sw_contact_load trial;   /* load at the end of a trial [N] */
  sw_contact_load resting; /* of the wires that wait (contact/wait.c) [N], [N m] */
  sw_strikers strikers;    /* of the last trial, see sw_contact_find_strikers */
  int busy;                /* 1: in the list `busy` of loaded obstacles */
} sw_contact_loads;

/* Data of a stage that is solved in parts; here of the current part. */
typedef struct sw_contact_parts {
  int on, begun;  /* on = 1: there are parts; begun = 1: the current part has been looked at */
  int group;      /* 1: the current part is that of the coupled bodies, the last one */
  size_t ranges;  /* number of ranges of its candidates: one, or one for each coupled body */
  size_t next;    /* the first candidate of later bodies, unless this is the last part */
  size_t touch;   /* its first touch */
  size_t before;  /* number of touches of the previous stage, of all parts */
  size_t matched; /* number of those that are matched, up to the end of this part */
} sw_contact_parts;

/* Candidates from first to end (exclusive). */
typedef struct sw_range {
  size_t first, end;
} sw_range;

#endif
