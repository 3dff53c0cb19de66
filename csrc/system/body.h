/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One body of the system: a wire or an object of particles, the forces on it, and the places of its
 * values in the system's arrays. */
#ifndef SW_SYSTEM_BODY_H
#define SW_SYSTEM_BODY_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "force/force.h"
#include "state/field.h"
#include "state/plan.h"

/* One force acting on one wire. */
typedef struct sw_term {
  const sw_force_class *cls;
  double args[SW_FORCE_ARGS_MAX / sizeof(double)];
  int id;          /* its number for the owner; -1: an inner force of the recipe */
  double *history; /* its part of the system's state, or NULL */
} sw_term;

/* A straight or plane wire that is pushed along its length, see watch/unbent.c. */
typedef struct sw_unbent {
  double growth;    /* logarithm of the growth of a real wire's bend so far; 0: no push [-] */
  double seen;      /* time of the last check [s] */
  double due, push; /* time at which a real wire has left its line; largest push since [N] */
  double at;        /* place of the largest push, as arc length [m] */
  int plane;        /* 1: it was bent in a plane at times */
} sw_unbent;

/* A wire that is bent in a plane, moves, and is pushed along its length, see watch/arched.c. */
typedef struct sw_arched {
  double growth;     /* logarithm of the growth of a straight piece's bend so far [-] */
  double straight;   /* that growth while it was straight, but for 1 [-] */
  double time, seen; /* time for which it has been pushed; time of the last check [s] */
  double need;       /* growth at which its motions are looked at again [-] */
  double push, at;   /* now [N], as arc length [m] */
  sw_vec normal;     /* of the plane */
  int pushed;        /* 1: at the last check */
} sw_arched;

typedef struct sw_body {
  sw_plan *plan;
  size_t first_node, first_edge, first_slice; /* first place in the system's arrays */
  double EA, EA_push; /* axial stiffness in tension and in compression [N] */
  int bears;          /* 1: one of its forces has axial forces too (system/borne.h) */
  double axial_time;  /* axial dashpots: their force is EA times this times the strain rate [s] */
  size_t first_clamp, kept_clamps; /* with dashpots: first place in the system's strains; number */
  double viscosity;                /* dashpots in bending: moment per rate of curvature [N m2 s] */
  sw_term *terms;
  size_t term_count;
  sw_field field;
  void *field_block;
  size_t first_span;    /* place of the plan's spans in the system's twist */
  int has_twist;        /* 1: the wire resists twist and a hold keeps it from turning */
  double *twist_now;    /* (spans) at this evaluation [rad] */
  double *twist_rank;   /* (nodes x 3) slope of the twist, held nodes included [rad/m]; this and
                           twist_solved are work space of the twist's measurement */
  double *twist_solved; /* (nodes x 3) inverse of the matrix times twist_rank */
  double *twist_gain;   /* (spans) torque added by the last update [N m] */
  void *twist_block;
  size_t first_frame;                       /* place of its frames in the system's */
  double *spin_normal[3], *spin_tangent[3]; /* (edges) components at the iterate */
  double *spin_twist; /* (nodes + clamps) twist of the hinges, at the iterate [rad] */
  double *spin_delta; /* (nodes x 4) last update: shifts of nodes, turns of edges [m], [rad] */
  double *spin_rows;  /* (nodes x SW_ROW4_SIZE) */
  void *spin_block;
  double spin_inertia; /* rotary inertia of an edge per length over hbar^2, for a wire that rolls or
                          whose spins do not converge [N] */
  size_t first_roll;   /* a wire that rolls: place of its edges' turns in the system's */
  double *roll_turn;   /* (edges) turn since the state, against the state's frame carried along a
                          great circle [rad] */
  double *roll_from[3]; /* (edges) the state's tangents; NULL for other wires [-] */
  void *roll_block;
  int needs_velocity;       /* some force depends on it */
  int is_explicit;          /* some force has no stiffness */
  int is_kinked;            /* some force has a history: its stiffness may jump in this step */
  size_t held;              /* number of its first held node + 1, or 0; set for each stage */
  struct sw_blocks *blocks; /* matrix of a body whose plan has a web, or NULL */
  size_t *web_slots;        /* places in this matrix for the forces' stiffness */
  unsigned char *web_fixed; /* (particles) 1: held */
  uint32_t *web_pairs;      /* (web_pair_count x 2) pairs in the matrix besides the web's */
  size_t web_pair_count;
  size_t web_couples; /* number of its pairs in the matrix of the bridges */
  int web_replanned;  /* 1: its pairs changed after web_couples were listed */
  double *web_room;   /* (particles x 15) work space of a large web's iterative solver, or NULL */
  int web_factored;   /* 1: a factor of this step can precondition iterations */
  int web_slow;       /* 1: such iterations were too slow in this step */
  int bridged;        /* its matrix is part of the bridges' matrix (system/bridge.h) */
  int coupled;        /* in this stage: SW_JOINED, SW_TOUCHING, both, or 0 (system/part.h) */
  struct {            /* work space of watch/together.c */
    double sum, most; /* [N] */
    size_t with;      /* the other body */
  } together;
  double carried; /* fastest turn of an obstacle on which it presses at the step's start; 0: none
                     turns (system/inner.h) [rad/s] */
  int lies_flat;  /* 1: it presses only on surfaces with one normal */
  int waits;      /* 1: it rests and is not solved in this step (system/wait.h) */
  int stops;      /* 1: it came to rest in the step accepted last */
  double watched; /* until then its friction is watched as after a sudden stop of a drive; 0: not
                     watched (step/left.c) [s] */
  int weighed;    /* 1: the next three are known while it waits */
  double gravity, stored, loads; /* its energies, see sw_energies [J] */
  double pushed;                 /* largest push in the checks for buckling so far [N] */
  sw_unbent unbent;
  sw_arched arched;
} sw_body;

/* Axial stiffness of an edge or spring: force over strain [N]. */
static inline double sw_body_axial(const sw_body *b, size_t e) {
  if (!b->plan->web) return b->EA;
  return b->plan->web->link[e].k * b->plan->web->link[e].rest;
}

/* 1 for a line along which waves travel in less than `most` [s]. Below SW_STIFF_TRAVEL a line is
 * stiff [s]. */
#define SW_STIFF_TRAVEL 1e-3
static inline int sw_body_is_stiff(const sw_body *b, double most) {
  const sw_plan *p = b->plan;
  return !p->web && p->length * p->length * p->beam.mass < most * most * b->EA;
}

/* Adds a term to its body's field. */
static inline sw_status sw_term_eval(const sw_term *term, sw_field *field, sw_error *err) {
  field->history = term->history;
  return term->cls->eval(term->args, field, err);
}

/* Writes a term's news after a commit to out; returns 1 if there are any. */
static inline int sw_term_news(const sw_term *term, sw_force_news *out) {
  return term->cls->news && term->history && term->cls->news(term->args, term->history, out);
}

/* Begins an evaluation of the body's terms: clears the field and measures the edges. */
void sw_body_begin(sw_body *body);

/* out = (sum of the terms' stiffness) d; held nodes are treated like all others; both (nodes x
 * 3). */
void sw_body_stiffness_times(sw_body *body, const double *d, double *out);

/* Adds stiffness between nodes i and j (the body's own numbers, i != j) of a body with a web; K has
 * i's rows, row by row [N/m]. Only while the coupling evaluates. Ignores pairs that are not in the
 * matrix. */
void sw_body_couple(sw_body *body, size_t i, size_t j, const double K[9]);

/* Before a step: sets the pairs of the body's own particles (count x 2) that may get stiffness
 * besides the web's. The matrix depends on these only, not on earlier steps. SW_ENOMEM keeps the
 * old pairs. */
sw_status sw_body_plan_pairs(sw_body *body, const uint32_t *pairs, size_t count);

/* --- while the coupling refines a solution ----------------------------------- */

/* In place: turns forces on the body's nodes (nodes x 3), zero where held, into the change of the
 * solution by these forces. */
void sw_body_solve_again(const sw_body *body, double *more);
/* The same for a wire that rolls, with the turns of its edges (nodes x 4). */
void sw_body_solve_rolling_again(const sw_body *body, double *more);
/* Sets the last solution to delta (nodes x 3). */
void sw_body_take_solution(sw_body *body, const double *delta);

#endif
